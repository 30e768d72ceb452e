"""Posters and certificates: what is in the files, for everybody, in every language, with the longest names."""

import io
import re
import weakref
from pathlib import Path

import pygame
import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Entrant, EventSpec, Format
from pigaming_app.scenes.events.paper import poster as posters
from pigaming_app.scenes.events.paper.certificates import certificates, print_certificates
from pigaming_app.scenes.events.paper.poster import poster, print_poster
from pigaming_app.scenes.events.paper.sheet import MARGIN, SIZE, H, PaperSheet, PrintJob, W, encoded
from pigaming_app.scenes.events.podium_page import EventPodiumPage
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.events import Button
from tests.cases import one_in
from tests.events.examples import by_chance, ranked
from tests.scenes.arcade import Arcade
from tests.scenes.events.drawn import an_event, played, running

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")

NAMES = ("Jürgen Öztürk", "W" * 24, "Íñigo Núñez", "João d’Ávila", "Zoë", "=1+1;(x)")


def finish(job: PrintJob) -> None:
    while not job.work():
        pygame.time.wait(1)


def an_ended_event(form: Format = Format.ROUND_ROBIN, names: tuple[str, ...] = NAMES) -> Event:
    event = Event(EventSpec("Sommerfest", form, ("pitanks",), tuple(Entrant(name, "", "5a") for name in names)))
    outcome = by_chance(5, ties=False)
    while not event.over:
        event = event.record(outcome(event.open[0]))
    return event


def pages_of(pdf: bytes) -> list[tuple[bytes, list[str]]]:
    """Picture and text of each page of a PDF, by its table of objects, as a reader finds them."""
    start = int(re.findall(rb"startxref\n(\d+)", pdf)[-1])
    rows = re.findall(rb"(\d{10}) \d{5} [nf] \n", pdf[start:])
    objects: list[bytes] = [b""]
    for number, row in enumerate(rows[1:], 1):
        at = int(row)
        assert pdf[at:].startswith(b"%d 0 obj\n" % number)
        length = re.match(rb"\d+ 0 obj\n<<[^\n]*?/Length (\d+)>>\nstream\n", pdf[at:])
        end = at + length.end() + int(length[1]) if length else pdf.index(b"endobj", at)
        assert not length or pdf[end:].startswith(b"\nendstream")
        objects.append(pdf[at:end])
    pages = [int(kid) for kid in re.findall(rb"(\d+) 0 R", re.search(rb"/Kids\[(.*?)\]", objects[2])[1])]  # type: ignore[index]
    assert b"/Count %d/" % len(pages) in objects[2]
    found = []
    for page in pages:
        text, picture = (re.search(key + rb" (\d+) 0 R", objects[page]) for key in (rb"/Contents", rb"/Im"))
        assert text
        assert picture
        lines = [
            bytes.fromhex(line.decode()).decode("cp1252") for line in re.findall(rb"<(\w*)> Tj", objects[int(text[1])])
        ]
        found.append((objects[int(picture[1])].split(b"stream\n", 1)[1], lines))
    return found


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_certificate_for_everybody(language: str) -> None:
    pytest.importorskip("PIL")
    from PIL import Image

    event, words = an_ended_event(), Words(language)
    (pdf,) = encoded(certificates(event, words), [Path("a.pdf")]).values()
    pages = pages_of(pdf)
    assert len(pages) == len(NAMES)
    for (picture, lines), row in zip(pages, event.standings, strict=True):
        assert lines[:3] == [words("events.certificate"), row.entrant, "5a"]
        assert "Sommerfest" in lines
        key = f"place_{row.place}" if row.place <= 3 else "took_part"
        assert words(f"events.{key}") in lines
        assert not any("{" in line or "…" in line for line in lines)
        image = Image.open(io.BytesIO(picture)).convert("L")
        assert image.size == SIZE
        edge = MARGIN // 2
        for box in ((0, 0, W, edge), (0, H - edge, W, H), (0, 0, edge, H), (W - edge, 0, W, H)):
            assert not any(image.crop(box).histogram()[:240]), "nothing is drawn beyond the frame"
        band = image.crop((MARGIN, 1600, W - MARGIN, 1900))  # the name
        left, _, right, _ = band.point(lambda light: 255 * (light < 128)).getbbox() or (0, 0, 0, 0)
        assert 60 < left < right < band.width - 60
        assert abs(left + right - band.width) < 60, "in the middle"


def test_only_the_first_ones_on_demand_and_equal_places_alike() -> None:
    event = an_event(count=4)
    event = event.record(ranked(event.open[0], *event.open[0].entrants))
    sheets = [sheet for sheet in certificates(event, Words("en"), 1) if sheet]
    assert [sheet.lines[1][0] for sheet in sheets] == [
        row.entrant for row in event.standings if row.place == 1 and row.played
    ]
    everybody = [sheet for sheet in certificates(event, Words("en")) if sheet]
    assert len(everybody) == sum(row.played > 0 for row in event.standings) == 2


def test_the_best_try_stands_on_the_certificate() -> None:
    event = played(an_event(Format.TIME_TRIAL, 3))
    sheets = [sheet for sheet in certificates(event, Words("de")) if sheet]
    assert any(line[0].startswith("Bestes: 9") for line in sheets[0].lines)


def test_sixty_four_certificates_keep_few_sheets_in_memory() -> None:
    """Each sheet is 26 MB: the next one is drawn once the one before has been taken."""
    event, alive = an_event(count=64), []
    event = played(event, 40)
    for sheet in certificates(event, Words("en")):
        if sheet:
            alive.append(weakref.ref(sheet))
            del sheet
            assert sum(one() is not None for one in alive) <= 2
    assert len(alive) == sum(row.played > 0 for row in event.standings)


def test_a_button_of_the_podium_prints_them(arcade: Arcade) -> None:
    pytest.importorskip("PIL")
    run = running(played(an_event(Format.ROUND_ROBIN, 4)))
    page = arcade.open(EventPodiumPage(arcade.context, run))
    arcade.wait(page.lockout + 0.1)
    arcade.press(Button.Y)
    assert page.message == arcade.context.words("events.printing")
    while page.printing:
        arcade.frame()
        pygame.time.wait(5)
    target = run.path.with_name("event-certificates.pdf")
    assert page.message == arcade.context.words("events.poster", name=target.name)
    assert len(pages_of(target.read_bytes())) == 4


@pytest.mark.parametrize(
    ("form", "count", "pages"),
    [(Format.SWISS, 16, 1), (Format.KNOCKOUT, 8, 3), (Format.GROUPS, 23, 3), (Format.HIGH_SCORE, 5, 1)],
)
def test_a_poster_is_a_picture_and_a_pdf(arcade: Arcade, form: Format, count: int, pages: int) -> None:
    pytest.importorskip("PIL")
    run = running(played(an_event(form, count)))
    finish(job := print_poster(run.event, run.path, Words("pt")))
    assert job.saved
    assert job.name == "event.png, event.pdf"
    assert pygame.image.load(run.path.with_suffix(".png")).get_size() == SIZE
    found = pages_of(run.path.with_suffix(".pdf").read_bytes())
    assert len(found) == pages
    assert {row.entrant for row in run.event.standings} <= {*found[0][1]}
    assert (run.path.with_name("event-2.png").exists()) == (pages == 3)


def test_without_pillow_a_poster_is_a_picture_only(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(posters, "can_pdf", lambda: False)
    run = running(played(an_event(count=3)))
    finish(job := print_poster(run.event, run.path, Words("en")))
    assert job.saved
    assert job.name == "event.png"
    assert run.path.with_suffix(".png").is_file()
    assert not run.path.with_suffix(".pdf").exists()


def test_a_disk_that_is_full_is_told(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    run = running(played(an_event(count=3)))
    job = print_certificates(run.event, run.path / "nowhere" / "cup.json", Words("en"))
    finish(job)
    assert not job.saved


@pytest.mark.parametrize("language", one_in(2, LANGUAGES))
def test_a_poster_has_every_name_once_in_the_table(language: str) -> None:
    first = next(sheet for sheet in poster(an_ended_event(), Words(language)) if sheet)
    lines = [line for line, *_ in first.lines]
    assert all(lines.count(name) >= 1 for name in NAMES)


def test_accents_do_not_move_a_line() -> None:
    """The base line of Í is that of I."""
    rows = []
    for text in ("IIII", "ÍÍÍÍ"):
        sheet = PaperSheet()
        sheet.write(text, 200, (200, 400), (0, 0, 0))
        mask = pygame.mask.from_threshold(sheet.picture, (0, 0, 0), (100, 100, 100, 255))
        rows.append(max(rect.bottom for rect in mask.get_bounding_rects()))
    assert rows[0] == rows[1]
