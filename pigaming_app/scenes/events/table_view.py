"""The table of an event: places, names, points, in one to three columns that can be read from five metres."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import pygame

from pigaming_app.ui.draw import BODY, FOCUS, ICE, LINE, MIST, STEEL, THIN, TITLE, cut_box, icon, text_width
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size, fit_text, text
from pigaming_app.ui.draw.surface_cache import cached

HEADS_Y, TOP, BOTTOM = 222, 254, 930  # px
GAP = 24  # px between two columns
WIPE, APART = 0.25, 0.03  # s: of one row, from row to row
CELL = {1: 200, 2: 198, 3: 164}  # px, width of a value, by number of columns
FIGURES = {1: 4, 2: 2, 3: 1}  # values shown, by number of columns
PLACE_W = 96  # px
LOW_ROWS = 6  # of a group whose table takes half the height


@dataclass(frozen=True)
class TableRow:
    """One entrant. `figures`: points first, then the less important values; `mark`: an AI; `leads`: alone first."""

    place: int
    name: str
    figures: tuple[str, ...]
    mark: bool = False
    leads: bool = False


@dataclass(frozen=True)
class GroupTable:
    """The table of a group, with its heading."""

    head: str
    rows: tuple[TableRow, ...]


Render = Callable[[TableRow, int, int, int], LitImage]


@dataclass(frozen=True)
class Grid:
    """How many columns, and rows in each, a table has on one page."""

    columns: int
    rows: int

    @property
    def size(self) -> int:
        """Entrants on a page."""
        return self.columns * self.rows


def grid_of(count: int) -> Grid:
    """The grid for so many entrants: the fewer, the larger; more than 24 take several pages."""
    return Grid(1, max(5, count)) if count <= 8 else Grid(2 if count <= 16 else 3, 8)


def pages_of(count: int) -> int:
    """Pages of a table of so many entrants."""
    return max(1, -(-count // grid_of(count).size))


def draw_table(
    screen: pygame.Surface,
    rows: Sequence[TableRow],
    heads: Sequence[str],
    page: int,
    age: float,
    dx: int = 0,
    dy: int = 0,
    render: Render | None = None,
) -> None:
    """Draw a page of a table, moved by (dx, dy) px. `heads`: of the values; `age`: s since it was opened;
    `render`: draws a row; None: `table_row`.
    """
    render = render or table_row
    grid = grid_of(len(rows))
    pitch = (BOTTOM - TOP) // grid.rows
    wide = (RIGHT - LEFT - GAP * (grid.columns - 1)) // grid.columns
    shown = rows[page * grid.size : (page + 1) * grid.size]
    used = -(-len(shown) // grid.rows)
    for column in range(used):
        _heads(screen, heads, dx + LEFT + column * (wide + GAP), dy + HEADS_Y, wide, grid.columns)
    for i, row in enumerate(shown):
        share = (age - APART * i) / WIPE
        if share > 0.0:
            x, y = LEFT + (i // grid.rows) * (wide + GAP), TOP + (i % grid.rows) * pitch
            whole = render(row, wide, pitch - 10, grid.columns)
            whole.draw(screen, dx + x, dy + y, share=1 - (1 - min(1.0, share)) ** 2)


def group_grid(groups: Sequence[GroupTable]) -> tuple[int, int]:
    """Tables beside each other and below each other on a page."""
    most = max((len(group.rows) for group in groups), default=0)
    return (1 if len(groups) == 1 else 2), (2 if len(groups) > 2 and most <= LOW_ROWS else 1)


def group_pages(groups: Sequence[GroupTable]) -> int:
    """Pages of the tables of groups."""
    across, down = group_grid(groups)
    return -(-len(groups) // (across * down))


def draw_groups(
    screen: pygame.Surface,
    groups: Sequence[GroupTable],
    heads: Sequence[str],
    page: int,
    dx: int = 0,
    dy: int = 0,
    render: Render | None = None,
) -> None:
    """Draw a page of the tables of groups, moved by (dx, dy) px; see `draw_table`."""
    render = render or table_row
    across, down = group_grid(groups)
    wide, high = (RIGHT - LEFT - GAP * (across - 1)) // across, (BOTTOM - HEADS_Y + 24) // down
    for i, group in enumerate(groups[page * across * down : (page + 1) * across * down]):
        x, y = dx + LEFT + (i % across) * (wide + GAP), dy + HEADS_Y + (i // across) * high
        text(group.head, BODY, ICE, "head", "l").draw(screen, x, y)
        _heads(screen, heads, x, y, wide, 2)
        pitch = min(112, (high - 56) // max(1, len(group.rows)))
        for k, row in enumerate(group.rows):
            render(row, wide, pitch - 6, 2).draw(screen, x, y + 32 + k * pitch)


def _heads(screen: pygame.Surface, heads: Sequence[str], x: int, y: int, w: int, columns: int) -> None:
    cell, shown = CELL[columns], heads[: FIGURES[columns]]
    size = min((fit_size(head, BODY, cell - 16, "body") for head in shown), default=BODY)
    for k, head in enumerate(shown):
        text(head, size, MIST, "body", "r").draw(screen, x + w - 28 - k * cell, y)


def table_row_steps(row: TableRow, w: int, h: int, columns: int) -> Steps[LitImage]:
    """A row; top left at (0, 0)."""
    layer = Layer(0, 0, w, h)
    best = row.leads
    layer.glow.line(cut_box(0, 0, w, h, 14), FOCUS if best else STEEL, LINE if best else THIN, True)
    size, middle = min(TITLE, round(h * 0.8)), h / 2
    color = FOCUS if best else ICE
    layer.canvas.text(str(row.place), fit_size(str(row.place), size, PLACE_W - 12), PLACE_W, middle, MIST, "head", "r")
    cell, shown = CELL[columns], row.figures[: FIGURES[columns]]
    last = text_width(shown[-1], round(size * 0.8)) if shown else 0  # the figure beside the name
    x, room = PLACE_W + 32, w - PLACE_W - 32 - 28 - cell * (len(shown) - 1) - last - 40
    if row.mark:
        icon(layer.glow, "ai", x + size * 0.4, middle, size * 0.36, MIST, 4)
        x, room = x + round(size * 1.05), room - round(size * 1.05)
    name, name_size = fit_text(row.name, size, room, "hero", BODY)
    layer.canvas.text(name, name_size, x, middle, color, "hero")
    if best:
        at = x + text_width(name, name_size, "hero") + size * 0.7
        if at + size * 0.5 < w - 28 - cell * len(shown):
            icon(layer.glow, "crown", at, middle - 2, size * 0.36, FOCUS, 4)
    yield
    for k, figure in enumerate(shown):
        there = size if k == 0 else round(size * 0.8)
        right = w - 28 - k * cell
        layer.canvas.text(
            figure,
            fit_size(figure, there, cell - 20),
            right,
            middle,
            color if k == 0 else MIST,
            "hero" if k == 0 else "head",
            "r",
        )
    yield
    return (yield from layer.render_steps())


table_row = cached(resumable(table_row_steps))
