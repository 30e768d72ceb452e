"""The bracket of an event: the matches of each round as boxes in columns, on as many pages as needed."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise

import pygame

from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, LINE, MIST, STEEL, THIN, Color, cut_box, dim, icon
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import LEFT, Layer, LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_text, text

COLUMNS = 4
W, GAP = 396, 48  # px: width of a box, from box to box
HEADS_Y, TOP, BOTTOM = 222, 258, 930  # px
LINE_H, PAD, APART = 56, 6, 14  # px: a line of names, above and below them, between two boxes
PLAYED, OPEN, NEXT = "played", "open", "next"  # states of a match


@dataclass(frozen=True)
class Box:
    """One match. `names`: of its entrants, `through`: which of them came first, or advance; `state`: see PLAYED."""

    number: int
    stage: str
    round: int
    names: tuple[str, ...]
    through: tuple[bool, ...]
    state: str

    @property
    def height(self) -> int:
        """px."""
        return 2 * PAD + LINE_H * lines_of(len(self.names))


@dataclass(frozen=True)
class Column:
    """Part of a round, or all of it."""

    stage: str
    round: int
    boxes: tuple[Box, ...]


Page = tuple[Column, ...]
Render = Callable[[tuple[str, ...], tuple[bool, ...], str], LitImage]


def lines_of(names: int) -> int:
    """Lines of a box with so many names: two in each."""
    return max(1, -(-names // 2))


def pages_of(boxes: Sequence[Box]) -> list[Page]:
    """The pages of a bracket. A round begins a new page if it would be torn apart otherwise."""
    pages: list[list[Column]] = [[]]
    for (stage, number), found in groupby(boxes, key=lambda box: (box.stage, box.round)):
        columns = [Column(stage, number, part) for part in _filled(list(found))]
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
        if (before.stage, before.round) != (after.stage, after.round):
            for start, end in _ways(before, after, places):
                way(end[0] - start[0], end[1] - start[1]).draw(screen, dx + start[0], dy + min(start[1], end[1]))
    for i, (column, head) in enumerate(zip(page, heads, strict=True)):
        x = LEFT + i * (W + GAP)
        text(head, BODY, MIST, "body", "l", W).draw(screen, dx + x, dy + HEADS_Y)
        for box in column.boxes:
            render(box.names, box.through, box.state).draw(screen, dx + places[box].x, dy + places[box].y)


def placed(column: Column, index: int) -> Iterator[tuple[Box, pygame.Rect]]:
    """The boxes of a column with their places, centred on the height of the page."""
    needed = sum(box.height for box in column.boxes)
    spare = BOTTOM - TOP - needed
    gap = min(3 * APART, spare / max(1, len(column.boxes)))
    y = TOP + (spare - gap * (len(column.boxes) - 1)) / 2
    for box in column.boxes:
        yield box, pygame.Rect(LEFT + index * (W + GAP), round(y), W, box.height)
        y += box.height + gap


def match_box_steps(names: tuple[str, ...], through: tuple[bool, ...], state: str) -> Steps[LitImage]:
    """A match; top left at (0, 0)."""
    h = 2 * PAD + LINE_H * lines_of(len(names))
    layer = Layer(0, 0, W, h)
    edge = FOCUS if state == NEXT else MIST if state == OPEN else STEEL
    layer.glow.line(cut_box(0, 0, W, h, 12), edge, LINE if state == NEXT else THIN, True)
    half = W / 2
    for i, (name, best) in enumerate(zip(names, through, strict=True)):
        x, y = 22 + half * (i % 2), PAD + LINE_H * (i // 2 + 0.5)
        color: Color = FOCUS if best else dim(MIST, 0.75) if state == PLAYED else ICE
        room = half - 34 - (40 if best else 0)
        if best:
            icon(layer.glow, "check", x + 14, y, 15, FOCUS, 5)
        name, size = fit_text(name, LABEL, room, "hero")
        layer.canvas.text(name, size, x + (40 if best else 0), y, color, "hero")
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


def _filled(boxes: list[Box]) -> Iterator[tuple[Box, ...]]:
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
    before: Column, after: Column, places: dict[Box, pygame.Rect]
) -> Iterator[tuple[tuple[int, int], tuple[int, int]]]:
    """From each match of a knock-out to the next one of those who advance from it: ends of the lines, px."""
    for box in (box for box in before.boxes if box.stage):
        for other in after.boxes:
            if any(best and name in other.names for name, best in zip(box.names, box.through, strict=True)):
                yield places[box].midright, places[other].midleft
