"""Tables, brackets and posters of every size: everybody is on a page, nothing lies outside."""

from itertools import pairwise
from pathlib import Path

import pygame
import pytest

from pigaming_app.events.spec import Format
from pigaming_app.scenes.events import bracket_view, poster, table_view
from pigaming_app.scenes.events.bracket_view import BOTTOM, COLUMNS, TOP, placed
from pigaming_app.scenes.events.poster import PosterJob
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from tests.scenes.arcade import Arcade
from tests.scenes.events.drawn import an_event, played, running

SIZES = (3, 8, 16, 33, 64)


@pytest.fixture
def arcade(controls: Controls, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Arcade:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    return Arcade(controls)


@pytest.mark.parametrize("count", [*range(1, 65)])
def test_a_table_has_room_for_everybody(count: int) -> None:
    grid = table_view.grid_of(count)
    assert (table_view.pages_of(count) - 1) * grid.size < count <= table_view.pages_of(count) * grid.size
    assert (table_view.BOTTOM - table_view.TOP) // grid.rows >= 60, "legible at five metres"


@pytest.mark.parametrize("count", SIZES)
@pytest.mark.parametrize("seats", [2, 4])
def test_every_match_is_on_one_page_of_the_bracket_and_inside_of_it(arcade: Arcade, count: int, seats: int) -> None:
    run = running(played(an_event(Format.KNOCKOUT, count, seats)))
    page = TablePage(arcade.context, run)
    boxes = [box.number for columns in page.overview.bracket for column in columns for box in column.boxes]
    assert sorted(boxes) == sorted(fixture.number for fixture in run.event.fixtures)
    for columns in page.overview.bracket:
        assert len(columns) <= COLUMNS
        for i, column in enumerate(columns):
            places = [place for _, place in placed(column, i)]
            assert places[0].top >= TOP
            assert places[-1].bottom <= BOTTOM
            assert all(one.bottom < other.top for one, other in pairwise(places))


def test_those_who_go_on_are_marked_and_lead_to_the_next_match(arcade: Arcade) -> None:
    run = running(played(an_event(Format.KNOCKOUT, 8), 4))
    page = TablePage(arcade.context, run)
    first = [box for columns in page.overview.bracket for column in columns for box in column.boxes if box.round == 1]
    assert [box.through.count(True) for box in first] == [1, 1, 1, 1]
    columns = page.overview.bracket[0]
    places = {box: place for i, column in enumerate(columns) for box, place in placed(column, i)}
    assert len([*bracket_view._ways(columns[0], columns[1], places)]) == 4


def test_no_line_leads_from_round_to_round_where_everybody_goes_on(arcade: Arcade) -> None:
    columns = TablePage(arcade.context, running(played(an_event(Format.SWISS, 8), 6))).overview.bracket[0]
    assert any(any(box.through) for box in columns[0].boxes)
    places = {box: place for i, column in enumerate(columns) for box, place in placed(column, i)}
    assert [*bracket_view._ways(columns[0], columns[1], places)] == []


def test_pages_turn_by_themselves(arcade: Arcade) -> None:
    page = TablePage(arcade.context, running(played(an_event(Format.SWISS, 64), 30)))
    assert page.page == 0
    for _ in range(6):
        page.update(2.0)
    assert page.page == 1


@pytest.mark.parametrize(("form", "count", "pages"), [(Format.SWISS, 16, 1), (Format.KNOCKOUT, 8, 3)])
def test_a_poster_is_a_picture_and_a_pdf(arcade: Arcade, form: Format, count: int, pages: int) -> None:
    pytest.importorskip("PIL")
    run = running(played(an_event(form, count)))
    job = PosterJob(run.event, run.path, Words("pt"))
    while not job.work():
        pygame.time.wait(1)
    assert job.saved
    assert pygame.image.load(run.path.with_suffix(".png")).get_size() == poster.SIZE
    pdf = run.path.with_suffix(".pdf").read_bytes()
    assert pdf.startswith(b"%PDF")
    assert pdf.count(b"/Type /Page\n") == pages or f"/Count {pages}".encode() in pdf
    assert (run.path.with_name("event-2.png").exists()) == (pages == 3)


def test_without_pillow_a_poster_is_a_picture_only(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(poster, "can_pdf", lambda: False)
    run = running(played(an_event(count=3)))
    job = PosterJob(run.event, run.path, Words("en"))
    while not job.work():
        pass
    assert job.saved
    assert job.name == "event.png"
    assert run.path.with_suffix(".png").is_file()
    assert not run.path.with_suffix(".pdf").exists()
