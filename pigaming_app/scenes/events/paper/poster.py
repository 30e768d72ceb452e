"""The poster of an event: podium and table; of a knock-out also its bracket, of groups their tables."""

from collections.abc import Collection, Iterator, Sequence
from datetime import date
from itertools import groupby
from pathlib import Path

import pygame

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Fixture, Standing
from pigaming_app.scenes.events.overview import TEAM_FIGURES, figure_of
from pigaming_app.scenes.events.paper.sheet import (
    INK,
    MARGIN,
    MEDALS,
    PDF,
    RULE,
    SOFT,
    H,
    PaperSheet,
    PrintJob,
    W,
    can_pdf,
)
from pigaming_app.scenes.events.running import stage_name
from pigaming_app.scenes.flow.match_words import game_title
from pigaming_app.ui.draw import cut_box
from pigaming_app.ui.i18n import Words

TABLE_TOP, FOOT = 1480, H - MARGIN  # px
ROW, NAME = 190.0, 110  # px, of a table with few rows: between two of them, and its type
GROUPS_TOP = 600  # px
BRACKET_TOP, LINE, BESIDE = 660, 116.0, 0.28  # px; height of a name at most, and as a share of its column
SPLIT = 56, 1 / 6  # px between two columns of a bracket at most, and as a share of a column


def print_poster(event: Event, path: Path, words: Words) -> PrintJob:
    """The job that saves the poster beside the file of an event: NAME.png, and NAME.pdf if that is possible."""
    targets = [path.with_suffix(".png"), *([path.with_suffix(PDF)] if can_pdf() else [])]
    return PrintJob(poster(event, words), targets)


def poster(event: Event, words: Words) -> Iterator[PaperSheet | None]:
    """Draw the poster, a part at each step, which is a sheet that is complete, or None. Needs no display."""
    pygame.font.init()
    page = PaperSheet()
    yield None
    _head(page, event, words)
    yield None
    for i, medal in enumerate(event.standings[:3]):
        _medal(page, medal, i)
        yield None
    yield from _table(page, event, words)
    yield page
    if event.part_standings:
        page = PaperSheet()
        _head(page, event, words, words("events.groups_side"))
        yield from _groups(page, event, words)
        yield page
    for side, stages in event.progress.kind.sides.items():
        if fixtures := [fixture for stage in stages for fixture in event.fixtures if fixture.stage == stage]:
            page = PaperSheet()
            yield None
            _head(page, event, words, words(f"events.{side}"))
            yield from _bracket(page, event, words, fixtures)
            yield page


def _head(page: PaperSheet, event: Event, words: Words, part: str = "") -> None:
    """Title, format, games and date. `part`: name of the part of the event on this page, if it is not all of it."""
    spec = event.spec
    page.write(spec.title, 190, (MARGIN, 260), INK, room=W - 2 * MARGIN)
    form = words(f"events.{spec.format.value}")
    line = "  ·  ".join((form, *([part] if part else []), *(game_title(words, game) for game in spec.games)))
    page.write(line, 64, (MARGIN, 430), SOFT, room=W - 2 * MARGIN - 420)
    page.write(words.day(date.today()), 64, (W - MARGIN, 430), SOFT, "r")
    pygame.draw.line(page.picture, INK, (MARGIN, 500), (W - MARGIN, 500), 8)
    page.write("PiGaming", 52, (W / 2, H - 80), SOFT, "c")


def _medal(page: PaperSheet, row: Standing, index: int) -> None:
    """A step of the podium, with the name above."""
    x = W / 2 + (0, -1, 1)[index] * 700
    high, foot = (560, 420, 320)[index], 1290
    color = MEDALS[min(row.place, 3) - 1]
    box = cut_box(x - 320, foot - high, 640, high, 40)
    pygame.draw.polygon(page.picture, color, box, 14)
    page.write(str(row.place), 260 if index == 0 else 200, (x, foot - high / 2), color, "c")
    page.write(row.entrant, 170, (x, foot - high - 110), INK, "c", 620)


def _table(page: PaperSheet, event: Event, words: Words) -> Iterator[None]:
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
        page.write(words(f"events.{figure}"), 44, at, SOFT, "r")
    for i, row in enumerate(rows):
        x, y = MARGIN + (i // each) * (wide + gap), TABLE_TOP + (i % each + 0.5) * pitch
        page.write(str(row.place), size, (x + 1.6 * size, y), SOFT, "r")
        page.write(row.entrant, size, (x + 2.2 * size, y), INK, room=wide - 5.6 * size)
        page.write(figure_of(words, row, figure), size, (x + wide, y), INK, "r")
        pygame.draw.line(page.picture, RULE, (x, y + pitch / 2), (x + wide, y + pitch / 2), 3)
        yield None


def _groups(page: PaperSheet, event: Event, words: Words) -> Iterator[None]:
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
        page.write(f"{words('events.group')} {name}", round(size * 1.1), (x, y + 40), INK)
        page.write(words("events.points"), 44, (x + wide, y + 40), SOFT, "r")
        pygame.draw.line(page.picture, INK, (x, y + 100), (x + wide, y + 100), 4)
        for k, row in enumerate(rows):
            middle = y + 110 + (k + 0.5) * pitch
            page.write(str(row.place), size, (x + 1.2 * size, middle), SOFT, "r")
            page.write(row.entrant, size, (x + 1.8 * size, middle), INK, room=wide - 4 * size)
            page.write(figure_of(words, row, TEAM_FIGURES[0]), size, (x + wide, middle), INK, "r")
            pygame.draw.line(page.picture, RULE, (x, middle + pitch / 2), (x + wide, middle + pitch / 2), 3)
        yield None


def _bracket(page: PaperSheet, event: Event, words: Words, matches: Sequence[Fixture]) -> Iterator[None]:
    """A column for each round of these matches, the final last; lines follow those who go on to the next column."""
    rounds = [list(found) for _, found in groupby(matches, key=lambda one: (one.stage, one.round))]
    drawn = [(one.stage, one.round) for one in matches]
    split = round(min(SPLIT[0], SPLIT[1] * (W - 2 * MARGIN) / max(1, len(rounds))))
    wide = (W - 2 * MARGIN + split) / max(1, len(rounds))
    before: list[tuple[pygame.Rect, frozenset[str]]] = []  # boxes of the column before, and who goes on
    for i, fixtures in enumerate(rounds):
        x = MARGIN + wide * i
        head = stage_name(words, fixtures[0].stage, fixtures[0].round, drawn)
        page.write(head, 44, (x, 580), SOFT, room=wide - split)
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
            yield None
        before = now


def _link(page: PaperSheet, one: pygame.Rect, other: pygame.Rect, split: int) -> None:
    """A line from a match to the one that follows, `split` px between their columns."""
    middle = other.left - split // 2
    path = [(one.right, one.centery), (middle, one.centery), (middle, other.centery), (other.left, other.centery)]
    pygame.draw.lines(page.picture, RULE, False, path, 4)


def _match(page: PaperSheet, fixture: Fixture, best: Collection[str], box: pygame.Rect, line: float) -> None:
    """A match, each name `line` px high; who goes on is in dark ink, with a tick."""
    pygame.draw.rect(page.picture, RULE, box, 4, 10)
    for i, name in enumerate(fixture.entrants):
        y = box.y + 4 + line * (i + 0.5)
        if name in best:
            tick = [(box.x + 14 + line * a, y + line * b) for a, b in ((0.0, 0.05), (0.14, 0.2), (0.4, -0.2))]
            pygame.draw.lines(page.picture, MEDALS[0], False, tick, max(3, round(line / 9)))
        at = box.x + 24 + line * 0.5, y
        page.write(name, round(line * 0.7), at, INK if name in best else SOFT, room=box.right - 12 - at[0])
