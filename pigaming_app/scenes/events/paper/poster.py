"""The poster of an event, A4 at 300 dpi on white paper: podium and table; of a knock-out also its bracket.

PNG needs nothing else, PDF needs Pillow (the extra `events`).
"""

import logging
from collections.abc import Collection, Iterator, Sequence
from datetime import date
from importlib.util import find_spec
from io import BytesIO
from itertools import groupby
from pathlib import Path
from threading import Thread
from time import perf_counter
from typing import TYPE_CHECKING

import pygame

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Fixture, Standing
from pigaming_app.scenes.events.overview import TEAM_FIGURES, figure_of
from pigaming_app.scenes.events.running import stage_name
from pigaming_app.scenes.flow.match_words import game_title
from pigaming_app.storage.safe_files import NotSaved, write_all_atomic
from pigaming_app.ui.draw import Color, cut_box, font
from pigaming_app.ui.draw.text import fit_text
from pigaming_app.ui.draw.theme import line_image
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.png import png_of

if TYPE_CHECKING:
    from PIL import Image

PDF = ".pdf"
SIZE = W, H = 2480, 3508  # px
DPI = 300
MARGIN = 160  # px
INK, SOFT, RULE, PAPER = (16, 22, 36), (96, 108, 130), (196, 204, 218), (255, 255, 255)
MEDALS: tuple[Color, ...] = ((214, 158, 0), (128, 140, 158), (176, 104, 48))
STEP = 0.006  # s of drawing in a frame
TABLE_TOP, FOOT = 1480, H - MARGIN  # px
ROW, NAME = 190.0, 110  # px, of a table with few rows: between two of them, and its type
GROUPS_TOP = 600  # px
BRACKET_TOP, LINE, BESIDE = 660, 116.0, 0.28  # px; height of a name at most, and as a share of its column
SMALLEST = 26  # px, of type: 6 pt
SPLIT = 56, 1 / 6  # px between two columns of a bracket at most, and as a share of a column

log = logging.getLogger("pigaming")


class PosterJob:
    """Draws the poster in the frame thread, part by part, and encodes and saves it in another one."""

    def __init__(self, event: Event, path: Path, words: Words) -> None:
        self.png, self.pdf = path.with_suffix(".png"), path.with_suffix(".pdf")
        self.saved = False
        self._pages: list[pygame.Surface] = []
        self._steps = draw_pages(event, words, self._pages)
        self._thread: Thread | None = None

    @property
    def name(self) -> str:
        """The names of the files."""
        return f"{self.png.name}, {self.pdf.name}" if can_pdf() else self.png.name

    def work(self) -> bool:
        """Work for some milliseconds; true when the files are saved, or could not be."""
        if self._thread:
            return not self._thread.is_alive()
        end = perf_counter() + STEP
        for _ in self._steps:
            if perf_counter() > end:
                return False
        self._thread = Thread(target=self._save, daemon=True)
        self._thread.start()
        return False

    def _save(self) -> None:
        try:
            write_all_atomic(encoded(self._pages, self.png) | (encoded(self._pages, self.pdf) if can_pdf() else {}))
            self.saved = True
        except NotSaved as reason:
            log.warning("%s", reason)


def can_pdf() -> bool:
    """True if Pillow is installed."""
    return find_spec("PIL") is not None


def drawn(event: Event, words: Words) -> list[pygame.Surface]:
    """All pages. Needs no display."""
    pygame.font.init()
    pages: list[pygame.Surface] = []
    for _ in draw_pages(event, words, pages):
        pass
    return pages


def encoded(pages: Sequence[pygame.Surface], path: Path) -> dict[Path, bytes]:
    """The files of the pages: one PDF if `path` ends so, else a PNG each, NAME.png, NAME-2.png …"""
    if path.suffix.lower() == PDF:
        images = [_image(page) for page in pages]
        packed = BytesIO()
        images[0].save(packed, "PDF", resolution=DPI, save_all=True, append_images=images[1:], quality=92)
        return {path: packed.getvalue()}
    files = [path if i == 0 else path.with_stem(f"{path.stem}-{i + 1}") for i in range(len(pages))]
    return {file: _png(page) for file, page in zip(files, pages, strict=True)}


def _png(page: pygame.Surface) -> bytes:
    if not can_pdf():
        return png_of(page)
    packed = BytesIO()
    _image(page).save(packed, "PNG")  # Pillow, unlike pygame, lets other threads run meanwhile
    return packed.getvalue()


def _image(page: pygame.Surface) -> "Image.Image":
    from PIL import Image

    return Image.frombytes("RGB", page.get_size(), pygame.image.tobytes(page, "RGB"))


def draw_pages(event: Event, words: Words, pages: list[pygame.Surface]) -> Iterator[None]:
    """Draw all pages into a list, a part at each step."""
    pages.append(page := _paper())
    yield
    _head(page, event, words)
    yield
    for i, medal in enumerate(_medals(event)):
        _medal(page, medal, i)
        yield
    yield from _table(page, event, words)
    if event.part_standings:
        pages.append(page := _paper())
        yield
        _head(page, event, words, words("events.groups_side"))
        yield from _groups(page, event, words)
    for side, stages in event.progress.kind.sides.items():
        if fixtures := [fixture for stage in stages for fixture in event.fixtures if fixture.stage == stage]:
            pages.append(page := _paper())
            yield
            _head(page, event, words, words(f"events.{side}"))
            yield from _bracket(page, event, words, fixtures)


def _paper() -> pygame.Surface:
    page = pygame.Surface(SIZE, depth=24)
    page.fill(PAPER)
    return page


def _write(
    page: pygame.Surface, line: str, size: int, at: tuple[float, float], color: Color, align: str = "l", room: float = W
) -> None:
    """A line with its middle at y. `align`: see `text`."""
    line, size = fit_text(line, size, room, "head", min(size, SMALLEST))
    image = line_image(line, "head", size, color)
    x = at[0] - image.get_width() * {"l": 0.0, "c": 0.5, "r": 1.0}[align]
    middle = font("head", size).get_ascent() - 0.35 * size
    page.blit(image, (round(x), round(at[1] - middle)))


def _head(page: pygame.Surface, event: Event, words: Words, part: str = "") -> None:
    """Title, format, games and date. `part`: name of the part of the event on this page, if it is not all of it."""
    spec = event.spec
    _write(page, spec.title, 190, (MARGIN, 260), INK, room=W - 2 * MARGIN)
    form = words(f"events.{spec.format.value}")
    line = "  ·  ".join((form, *([part] if part else []), *(game_title(words, game) for game in spec.games)))
    _write(page, line, 64, (MARGIN, 430), SOFT, room=W - 2 * MARGIN - 420)
    _write(page, words.day(date.today()), 64, (W - MARGIN, 430), SOFT, "r")
    pygame.draw.line(page, INK, (MARGIN, 500), (W - MARGIN, 500), 8)
    _write(page, "PiGaming", 52, (W / 2, H - 80), SOFT, "c")


def _medals(event: Event) -> list[Standing]:
    return list(event.standings[:3])


def _medal(page: pygame.Surface, row: Standing, index: int) -> None:
    """A step of the podium, with the name above."""
    x = W / 2 + (0, -1, 1)[index] * 700
    high, foot = (560, 420, 320)[index], 1290
    color = MEDALS[min(row.place, 3) - 1]
    box = cut_box(x - 320, foot - high, 640, high, 40)
    pygame.draw.polygon(page, color, box, 14)
    _write(page, str(row.place), 260 if index == 0 else 200, (x, foot - high / 2), color, "c")
    _write(page, row.entrant, 170, (x, foot - high - 110), INK, "c", 620)


def _table(page: pygame.Surface, event: Event, words: Words) -> Iterator[None]:
    """All places, in one to three columns."""
    rows, figure = event.standings, event.progress.kind.figures[0]
    columns = 1 if len(rows) <= 16 else 2 if len(rows) <= 40 else 3
    each = -(-len(rows) // columns)
    gap = 80
    wide = (W - 2 * MARGIN - gap * (columns - 1)) / columns
    pitch = min(ROW, (FOOT - TABLE_TOP - 40) / max(1, each))
    size = round(min(NAME, pitch * 0.62))
    for column in range(columns):
        at = MARGIN + column * (wide + gap) + wide, TABLE_TOP - 40
        _write(page, words(f"events.{figure}"), 44, at, SOFT, "r")
    for i, row in enumerate(rows):
        x, y = MARGIN + (i // each) * (wide + gap), TABLE_TOP + (i % each + 0.5) * pitch
        _write(page, str(row.place), size, (x + 1.6 * size, y), SOFT, "r")
        _write(page, row.entrant, size, (x + 2.2 * size, y), INK, room=wide - 5.6 * size)
        _write(page, figure_of(words, row, figure), size, (x + wide, y), INK, "r")
        pygame.draw.line(page, RULE, (x, y + pitch / 2), (x + wide, y + pitch / 2), 3)
        yield


def _groups(page: pygame.Surface, event: Event, words: Words) -> Iterator[None]:
    """The tables of the groups, one to three beside each other."""
    groups = event.part_standings
    columns = 1 if len(groups) == 1 else 2 if len(groups) <= 8 else 3
    lines, most = -(-len(groups) // columns), max(map(len, groups.values()))
    gap, high = 100, (FOOT - GROUPS_TOP) / lines
    wide = (W - 2 * MARGIN - gap * (columns - 1)) / columns
    pitch = min(150.0, (high - 170) / most)
    size = round(min(90, pitch * 0.6))
    for i, (name, rows) in enumerate(groups.items()):
        x, y = MARGIN + (i % columns) * (wide + gap), GROUPS_TOP + (i // columns) * high
        _write(page, f"{words('events.group')} {name}", round(size * 1.1), (x, y + 40), INK)
        _write(page, words("events.points"), 44, (x + wide, y + 40), SOFT, "r")
        pygame.draw.line(page, INK, (x, y + 100), (x + wide, y + 100), 4)
        for k, row in enumerate(rows):
            middle = y + 110 + (k + 0.5) * pitch
            _write(page, str(row.place), size, (x + 1.2 * size, middle), SOFT, "r")
            _write(page, row.entrant, size, (x + 1.8 * size, middle), INK, room=wide - 4 * size)
            _write(page, figure_of(words, row, TEAM_FIGURES[0]), size, (x + wide, middle), INK, "r")
            pygame.draw.line(page, RULE, (x, middle + pitch / 2), (x + wide, middle + pitch / 2), 3)
        yield


def _bracket(page: pygame.Surface, event: Event, words: Words, matches: Sequence[Fixture]) -> Iterator[None]:
    """A column for each round of these matches, the final last; lines follow those who go on to the next column."""
    rounds = [list(found) for _, found in groupby(matches, key=lambda one: (one.stage, one.round))]
    drawn = [(one.stage, one.round) for one in matches]
    split = round(min(SPLIT[0], SPLIT[1] * (W - 2 * MARGIN) / max(1, len(rounds))))
    wide = (W - 2 * MARGIN + split) / max(1, len(rounds))
    before: list[tuple[pygame.Rect, frozenset[str]]] = []  # boxes of the column before, and who goes on
    for i, fixtures in enumerate(rounds):
        x = MARGIN + wide * i
        head = stage_name(words, fixtures[0].stage, fixtures[0].round, drawn)
        _write(page, head, 44, (x, 580), SOFT, room=wide - split)
        pitch = (FOOT - BRACKET_TOP) / len(fixtures)
        now: list[tuple[pygame.Rect, frozenset[str]]] = []
        for k, fixture in enumerate(fixtures):
            best = event.through(fixture)
            line = min(LINE, BESIDE * wide, (pitch - 14) / len(fixture.entrants))
            high = round(line * len(fixture.entrants)) + 8
            middle = BRACKET_TOP + pitch * (k + 0.5)
            box = pygame.Rect(round(x), round(middle - high / 2), round(wide - split), high)
            for other, through in before:
                if through & {*fixture.entrants}:
                    _link(page, other, box, split)
            _match(page, fixture, best, box, line)
            now.append((box, best))
            yield
        before = now


def _link(page: pygame.Surface, one: pygame.Rect, other: pygame.Rect, split: int) -> None:
    """A line from a match to the one that follows, `split` px between their columns."""
    middle = other.left - split // 2
    path = [(one.right, one.centery), (middle, one.centery), (middle, other.centery), (other.left, other.centery)]
    pygame.draw.lines(page, RULE, False, path, 4)


def _match(page: pygame.Surface, fixture: Fixture, best: Collection[str], box: pygame.Rect, line: float) -> None:
    """A match, each name `line` px high; who goes on is in dark ink, with a tick."""
    pygame.draw.rect(page, RULE, box, 4, 10)
    for i, name in enumerate(fixture.entrants):
        y = box.y + 4 + line * (i + 0.5)
        if name in best:
            tick = [(box.x + 14 + line * a, y + line * b) for a, b in ((0.0, 0.05), (0.14, 0.2), (0.4, -0.2))]
            pygame.draw.lines(page, MEDALS[0], False, tick, max(3, round(line / 9)))
        at = box.x + 24 + line * 0.5, y
        _write(page, name, round(line * 0.7), at, INK if name in best else SOFT, room=box.right - 12 - at[0])
