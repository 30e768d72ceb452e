"""The bracket of an event: the matches of each round as boxes in columns, on as many pages as needed."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise

import pygame

from pigaming_app.events.formats.knockout import FINAL
from pigaming_app.scenes.events.names import shortened
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LINE, MIST, STEEL, THIN, Color, cut_box, dim, icon
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import LEFT, Layer, LitImage, text
from pigaming_app.ui.draw.surface_cache import cached

COLUMNS = 4
W, GAP = 396, 48  # px: width of a box, from box to box
HEADS_Y, TOP, BOTTOM = 222, 258, 930  # px
LINE_H, PAD, APART = 46, 6, 9  # px: a name, above and below the names, between two boxes at least
NOTE_UP = 36  # px, from a note to its box
MARK = 30  # px, from the right edge to the sign of those who go on
PLAYED, OPEN, NEXT, LATER = "played", "open", "next", "later"  # states of a match


@dataclass(frozen=True)
class BracketBox:
    """One match. `names`: of its entrants, empty where it is open who they are; `through`: which of them came first, or
    advance; `state`: see PLAYED. Lines lead from a box to those whose `come` has one of its `go`. `note`: stands above.
    """

    number: int
    stage: str
    round: int
    names: tuple[str, ...]
    through: tuple[bool, ...]
    state: str
    go: frozenset[str] = frozenset()
    come: frozenset[str] = frozenset()
    note: str = ""

    @property
    def height(self) -> int:
        """px."""
        return 2 * PAD + LINE_H * len(self.names)


@dataclass(frozen=True)
class Column:
    """Part of a round, or all of it."""

    stage: str
    round: int
    boxes: tuple[BracketBox, ...]
    whole: bool = True


Page = tuple[Column, ...]
Render = Callable[[tuple[str, ...], tuple[bool, ...], str], LitImage]


def pages_of(sides: Sequence[Sequence[BracketBox]]) -> list[Page]:
    """The pages of a bracket, each side on pages of its own. A round begins a new page if it would be torn apart
    otherwise; both finals share a column.
    """
    pages: list[list[Column]] = []
    for side in sides:
        pages.append([])
        for _, found in groupby(side, key=lambda box: (box.stage, box.round if box.stage != FINAL else 0)):
            parts = [*_filled(list(found))]
            columns = [Column(part[0].stage, part[0].round, part, len(parts) == 1) for part in parts]
            if pages[-1] and len(pages[-1]) + len(columns) > COLUMNS:
                pages.append([])
            for column in columns:
                if len(pages[-1]) == COLUMNS:
                    pages.append([])
                pages[-1].append(column)
    return [tuple(page) for page in pages]


def page_with(pages: Sequence[Page], number: int | None) -> int:
    """The page with a match; without one, the last."""
    for i, page in enumerate(pages):
        if any(box.number == number for column in page for box in column.boxes):
            return i
    return len(pages) - 1


def draw_bracket(
    screen: pygame.Surface, page: Page, heads: Sequence[str], dx: int = 0, dy: int = 0, render: Render | None = None
) -> None:
    """Draw a page, moved by (dx, dy) px. `heads`: one for each column; `render`: draws a match; None: `match_box`."""
    render = render or match_box
    places = {box: place for i, column in enumerate(page) for box, place in placed(column, i)}
    for before, after in pairwise(page):
        if before.whole and after.whole:
            for start, end in _ways(before, after, places):
                way(end[0] - start[0], end[1] - start[1]).draw(screen, dx + start[0], dy + min(start[1], end[1]))
    for i, (column, head) in enumerate(zip(page, heads, strict=True)):
        x = LEFT + i * (W + GAP)
        text(head, BODY, MIST, "body", "l", W).draw(screen, dx + x, dy + HEADS_Y)
        for box in column.boxes:
            place = places[box].move(dx, dy)
            render(box.names, box.through, box.state).draw(screen, place.x, place.y)
            if box.note:
                text(box.note, BODY, MIST, "body", "l", W).draw(screen, place.x, place.y - NOTE_UP)


def placed(column: Column, index: int) -> Iterator[tuple[BracketBox, pygame.Rect]]:
    """The boxes of a column with their places: each in the middle of its share of the height."""
    high = [box.height for box in column.boxes]
    spare = (BOTTOM - TOP - sum(high)) / len(high)
    y = TOP + spare / 2
    for box in column.boxes:
        yield box, pygame.Rect(LEFT + index * (W + GAP), round(y), W, box.height)
        y += box.height + spare


def match_box_steps(names: tuple[str, ...], through: tuple[bool, ...], state: str) -> Steps[LitImage]:
    """A match; top left at (0, 0)."""
    h = 2 * PAD + LINE_H * len(names)
    layer = Layer(0, 0, W, h)
    if state == LATER:
        layer.glow.dashes(cut_box(0, 0, W, h, 12), STEEL, THIN, 16, 12)
    else:
        edge = FOCUS if state == NEXT else MIST if state == OPEN else STEEL
        layer.glow.line(cut_box(0, 0, W, h, 12), edge, LINE if state == NEXT else THIN, True)
    for i, (name, best) in enumerate(zip(names, through, strict=True)):
        if not name:
            continue
        y = PAD + LINE_H * (i + 0.5)
        color: Color = FOCUS if best else dim(MIST, 0.75) if state == PLAYED else ICE
        if best:
            icon(layer.glow, "check", W - MARK, y, 15, FOCUS, 5)
        layer.canvas.text(shortened(name, W - 44 - MARK, BODY, "hero"), BODY, 22, y, color, "hero")
    yield
    return (yield from layer.render_steps())


match_box = cached(resumable(match_box_steps))


@cached
def way(w: int, rise: int) -> LitImage:
    """The line from one box to the next: `w` px to the right and `rise` px down; top left at (0, 0)."""
    h = abs(rise)
    layer = Layer(0, 0, w, h)
    start, end = (0, h) if rise < 0 else (0, 0), (w, 0) if rise < 0 else (w, h)
    layer.glow.line([start, (w / 2, start[1]), (w / 2, end[1]), end], dim(MIST, 0.7), THIN)
    return layer.render()


def _filled(boxes: list[BracketBox]) -> Iterator[tuple[BracketBox, ...]]:
    """The boxes of a round in as few columns as possible, about equally filled."""
    room, columns, high = BOTTOM - TOP, 1, 0
    for box in boxes:
        high += box.height + APART
        if high - APART > room:
            columns, high = columns + 1, box.height + APART
    each = -(-len(boxes) // columns)
    for i in range(0, len(boxes), each):
        yield tuple(boxes[i : i + each])


def _ways(
    before: Column, after: Column, places: dict[BracketBox, pygame.Rect]
) -> Iterator[tuple[tuple[int, int], tuple[int, int]]]:
    """From each match to the next one of those who advance from it: ends of the lines, px."""
    for box in before.boxes:
        for other in after.boxes:
            if box.go & other.come:
                yield places[box].midright, places[other].midleft
