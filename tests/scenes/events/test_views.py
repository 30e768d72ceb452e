"""Tables and brackets of every size: everybody is on a page, nothing lies outside."""

from collections import Counter, defaultdict
from itertools import pairwise

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Format
from pigaming_app.scenes.events import bracket_view, table_view
from pigaming_app.scenes.events.bracket_view import BOTTOM, COLUMNS, LATER, TOP, placed
from pigaming_app.scenes.events.overview import overview
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.ui.i18n import Words
from tests.events.examples import by_chance, new_event, ranked
from tests.events.examples import played as all_played
from tests.scenes.arcade import Arcade
from tests.scenes.events.drawn import an_event, played, running
from tests.scenes.measuring import faults, measuring

SIZES = (3, 8, 16, 33, 64)


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


def shown_matches(event: Event) -> Counter[tuple[str, int]]:
    """Matches on the pages of the bracket, by stage and round."""
    pages = overview(Words("en"), event).bracket
    return Counter((box.stage, box.round) for page in pages for column in page for box in column.boxes)


@pytest.mark.parametrize(("count", "seats"), [(3, 2), (5, 2), (8, 2), (16, 2), (33, 2), (64, 2), (9, 3), (27, 4)])
def test_the_bracket_shows_every_round_before_the_first_match(count: int, seats: int) -> None:
    """As many matches in each round as are then played, whoever wins; the second final may not be needed."""
    event = new_event(Format.KNOCKOUT, count, seats=seats)
    before = shown_matches(event)
    event = all_played(event, by_chance(count))
    after = Counter((fixture.stage, fixture.round) for fixture in event.fixtures)
    assert {*before} - {*after} <= {("final", event.round), ("final", event.round + 1)}
    assert all(before[key] == number for key, number in after.items())
    assert shown_matches(event) == after


@pytest.mark.parametrize(("count", "seats"), [(4, 2), (8, 2), (13, 2), (16, 4)])
def test_each_side_of_the_bracket_counts_its_own_rounds(count: int, seats: int) -> None:
    """1, 2, 3 … without a gap, although the winners pause while the losers play."""
    shown = overview(Words("en"), new_event(Format.KNOCKOUT, count, seats=seats))
    heads = list(dict.fromkeys(head for number in range(len(shown.bracket)) for head in shown.stages(number)))
    for side in ("Winners", "Second chance"):
        rounds = [head for head in heads if head.startswith(side)]
        assert rounds == [f"{side} {number}" for number in range(1, len(rounds) + 1)]
    assert [head for head in heads if not head[-1].isdigit()] == ["Grand final"]


def test_a_row_of_two_columns_has_room_for_sixteen_letters(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    row = table_view.TableRow(12, "Maximilian v. Hohenstein", ("0,3", "1"))
    with measuring(monkeypatch) as screen:
        table_view.draw_table(screen, [row] * 12, ("Points", "Wins"), 0, 9.0)
    assert [mark.text for mark in screen.texts if mark.text.startswith("Maximilian v. Ho")]
    assert faults(screen) == []


def test_names_are_known_as_soon_as_the_matches_before_are_decided() -> None:
    """Worked by hand for eight of whom the better seed wins: 1 – 8, 4 – 5, 2 – 7, 3 – 6, then 1 – 4."""
    event = new_event(Format.KNOCKOUT, 8)
    for fixture in event.open[:2]:
        event = event.record(ranked(fixture, *sorted(fixture.entrants)))
    boxes = [box for page in overview(Words("en"), event).bracket for column in page for box in column.boxes]
    names = defaultdict[tuple[str, int], list[tuple[str, ...]]](list)
    for box in boxes:
        names[box.stage, box.round].append(tuple(sorted(box.names)))
    assert names["winners", 2] == [("P1", "P4"), ("", "")]
    assert names["losers", 2] == names["losers", 3] == [("", "")] * 2
    assert [box.state for box in boxes].count(LATER) == len(boxes) - 4
    assert [(box.stage, bool(box.note)) for box in boxes if box.stage == "final"] == [("final", False), ("final", True)]


def test_a_bracket_is_set_in_large_type(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    """Names of 24 wide letters: capitals of 28 px, in type of 40 px, and none outside of its box."""
    run = running(played(an_event(Format.KNOCKOUT, 8, wide=True), 6))
    with measuring(monkeypatch) as screen:
        page = TablePage(arcade.context, run)
        for page.page in range(2):
            screen.marks.clear()
            page.draw(screen)
            names = [mark for mark in screen.texts if mark.text.startswith("W") and "…" in mark.text]
            assert len(names) == (14 if page.page == 0 else 4)
            assert all(mark.box[3] - mark.box[1] >= 27 for mark in names)
            assert faults(screen) == []


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
