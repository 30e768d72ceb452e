"""Arenas printed to scale: one page as large as the surface, or pages of A4 or A3 to be put together.

Corner markers stand where the projector would show them, so that tracking and its check for drift know them. A page of
several overlaps its neighbours by TAB to the right and below; cut off at the marks, its left and upper edges lie on the
tabs of the pages before.
"""

from collections.abc import Iterator, Sequence
from math import ceil, cos, sin
from textwrap import wrap
from typing import NamedTuple

from pigaming_app.hardware.calibration.boards import ARENA_AT
from pigaming_app.hardware.calibration.drift import EDGE, PLACES, QUIET
from pigaming_app.hardware.calibration.floor_surface import FloorSurface
from pigaming_app.hardware.calibration.printed import PRINTED_PLACES
from pigaming_app.scenes.mat.paper.marker_sheet import marker
from pigaming_app.scenes.mat.paper.paper_canvas import PaperCanvas
from pigaming_app.scenes.views.game_screens import GameScreens
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import MIST, PLAYERS, WALL, dim, shape_points
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.pdf import PdfFile, op, path, placed, written

PAPERS = {"A4": (210.0, 297.0), "A3": (297.0, 420.0)}  # mm
EDGES = 12.0  # mm round a page that stay white
TAB = 10.0  # mm
TICK, AWAY = 5.0, 1.5  # mm: length of a cut mark, and from what is printed
BAR = 100.0  # mm
LETTER = 0.5  # em, mean width of a letter of Helvetica
GREY, DARK = "0.55 g 0.55 G", "0.15 g 0.15 G"

Box = tuple[float, float, float, float]  # left, top, right, bottom


class PageOfArena(NamedTuple):
    """A page of several: its name and what of the surface is printed on it, mm."""

    name: str
    left: float
    top: float
    right: float
    bottom: float


def add_poster(
    pdf: PdfFile, surface: FloorSurface, screens: GameScreens, arena: Arena, title: str, words: Words
) -> None:
    """Add a page as large as the surface. Raises OpenCVMissing."""
    part = pdf.part(_box(surface), drawing(surface, screens, arena, title, words))
    pdf.draw((surface.width, surface.height), "/Arena Do", {"Arena": part})


def add_tiles(
    pdf: PdfFile, surface: FloorSurface, screens: GameScreens, arena: Arena, title: str, words: Words, paper: str
) -> None:
    """Add a page that explains how to put them together, and the pages. Raises OpenCVMissing."""
    part = {"Arena": pdf.part(_box(surface), drawing(surface, screens, arena, title, words))}
    page, cut = tiles(surface, paper)
    pdf.draw(PAPERS["A4"], "\n".join(_overview(surface, title, words, paper, cut)), part)
    for tile in cut:
        pdf.draw(page, "\n".join(_tile(tile, page, title, words)), part)


def tiles(surface: FloorSurface, paper: str) -> tuple[tuple[float, float], list[PageOfArena]]:
    """The pages of a surface, row by row: their size, mm, upright or lying as takes fewer, and what each shows."""
    wide, high = PAPERS[paper]
    return min((_laid(surface, page) for page in ((wide, high), (high, wide))), key=lambda laid: len(laid[1]))


def drawing(surface: FloorSurface, screens: GameScreens, arena: Arena, title: str, words: Words) -> str:
    """Operators of an arena on its surface, mm: floor, starts, corner markers, a bar of 10 cm. Raises OpenCVMissing."""
    ink, (left, top), mm = PaperCanvas(), surface.corner, surface.mm
    screens.floor(ink, arena)
    if screens.plan:
        screens.plan(ink, arena, 0.0, 0.0, 1.0)
    ink.line([(0.0, 0.0), (WIDTH, 0.0), (WIDTH, HEIGHT), (0.0, HEIGHT)], WALL, 4.0, True)
    _starts(ink, arena)
    corners = [
        marker(number, x - 0.5 - ARENA_AT[0] - EDGE / 2, y - 0.5 - ARENA_AT[1] - EDGE / 2, EDGE)
        for number, (x, y) in PRINTED_PLACES.items()
    ]
    heading, note = written(title, 0.0, -60.0, 36.0, True), words("sheet.bar")
    bar = _bar(WIDTH - max(BAR / mm, 20.0 * LETTER * len(note)), -60.0, 1.0 / mm, note, 20.0)
    return "\n".join(["q", placed(mm, left, top), *ink.drawn, "0 g", *corners, DARK, heading, *bar, "Q"])


def _starts(ink: PaperCanvas, arena: Arena) -> None:
    """The starts of the four seats: as large as a robot, with the seat's shape, open where it looks ahead."""
    radius = arena.radius
    for seat, start in enumerate(arena.starts):
        c, s = cos(start.heading), sin(start.heading)
        ink.ring(start.x, start.y, radius, dim(MIST, 0.5), 2)
        points = [(start.x + 0.6 * x, start.y + 0.6 * y) for y, x in shape_points(seat, 26)]
        ink.line(points, PLAYERS[seat], 3, True)
        tip = [(radius + 8.0, -9.0), (radius + 18.0, 0.0), (radius + 8.0, 9.0)]
        ink.line([(start.x + u * c - v * s, start.y + u * s + v * c) for u, v in tip], PLAYERS[seat], 4)


def _box(surface: FloorSurface) -> Box:
    return 0.0, 0.0, surface.width, surface.height


def _laid(surface: FloorSurface, page: tuple[float, float]) -> tuple[tuple[float, float], list[PageOfArena]]:
    """The tiles of all that lies between the corner markers, with their quiet zones, on such pages."""
    wide, high = (side - 2.0 * EDGES for side in page)
    (x0, y0), _, (x1, y1), _ = PLACES
    whole, (left, top) = EDGE + 2 * QUIET, surface.corner
    left += (x0 - 0.5 - whole / 2 - ARENA_AT[0]) * surface.mm
    top += (y0 - 0.5 - whole / 2 - ARENA_AT[1]) * surface.mm
    across, down = (x1 - x0 + whole) * surface.mm, (y1 - y0 + whole) * surface.mm
    columns, rows = (
        max(1, ceil((length - TAB - 1e-6) / (side - TAB))) for length, side in ((across, wide), (down, high))
    )
    cut = []
    for row in range(rows):
        for column in range(columns):
            x, y = left + column * (wide - TAB), top + row * (high - TAB)
            cut.append(PageOfArena(f"{_letters(row)}{column + 1}", x, y, x + wide, y + high))
    return page, cut


def _letters(row: int) -> str:
    """A, B … Z, AA, AB …"""
    return (_letters(row // 26 - 1) if row >= 26 else "") + chr(ord("A") + row % 26)


def _tile(tile: PageOfArena, page: tuple[float, float], title: str, words: Words) -> Iterator[str]:
    """One page: its part of the arena, cut marks at the edges and tabs, its name, and a bar to check the print."""
    wide, high = page
    window = op("re", EDGES, EDGES, wide - 2 * EDGES, high - 2 * EDGES)
    yield f"q {window} W n {placed(1.0, EDGES - tile.left, EDGES - tile.top)} /Arena Do Q {DARK} 0.15 w"
    for x in (EDGES, wide - EDGES - TAB):
        for y in (EDGES - AWAY - TICK, high - EDGES + AWAY):
            yield path([(x, y), (x, y + TICK)], "S")
    for y in (EDGES, high - EDGES - TAB):
        for x in (EDGES - AWAY - TICK, wide - EDGES + AWAY):
            yield path([(x, y), (x + TICK, y)], "S")
    yield written(tile.name, EDGES + 4.0, high - 4.5, 5.0, True)
    yield f"{GREY} {written(title, EDGES + 20.0, high - 4.5, 3.0)} {DARK}"
    yield from _bar(wide - EDGES - TAB - BAR - 4.0, high - 6.0, 1.0, words("sheet.bar"), 2.6)


def _bar(x: float, y: float, mm: float, text: str, size: float) -> Iterator[str]:
    """A bar of 10 cm from (x, y), with a tick at each cm and a line of text below; `mm`: the units of one."""
    yield op("w", 0.25 * mm)
    yield path([(x, y), (x + BAR * mm, y)], "S")
    for cm in range(11):
        at, high = x + 10 * cm * mm, (3.0 if cm % 10 == 0 else 1.6) * mm
        yield path([(at, y), (at, y - high)], "S")
    yield written(text, x, y + 1.2 * size, size)


def _overview(surface: FloorSurface, title: str, words: Words, paper: str, cut: Sequence[PageOfArena]) -> Iterator[str]:
    """The first page: the whole in small with the names of its pages, and what to do."""
    wide, _ = PAPERS["A4"]
    left, room = 20.0, wide - 40.0
    across, down = cut[-1].right - cut[0].left, cut[-1].bottom - cut[0].top
    k = min(room / across, 120.0 / down)
    x, y = left + (room - k * across) / 2.0, 42.0
    yield f"{DARK} {written(title, left, 22.0, 8.0, True)}"
    rows, columns = len({tile.top for tile in cut}), len({tile.left for tile in cut})
    field = {"width": round(surface.field[0]), "height": round(surface.field[1])}
    facts = words("sheet.facts", **field, pages=len(cut), rows=rows, columns=columns, paper=paper)
    yield f"{GREY} {written(facts, left, 31.0, 4.0)}"
    yield f"q {placed(k, x - k * cut[0].left, y - k * cut[0].top)} /Arena Do Q"
    yield f"{GREY} 0.2 w"
    size = min(4.0, 0.25 * k * (cut[0].bottom - cut[0].top))
    for tile in cut:
        at = x + k * (tile.left - cut[0].left), y + k * (tile.top - cut[0].top)
        yield f"{op('re', *at, k * (tile.right - tile.left - TAB), k * (tile.bottom - tile.top - TAB))} S"
        yield f"0.1 0.35 0.75 rg {written(tile.name, at[0] + 1.2, at[1] + 1.1 * size, size, True)} {GREY}"
    line = y + k * down + 14.0
    yield DARK
    for number, key in enumerate(("floor_print", "floor_cut", "floor_join", "floor_lay", "floor_measure"), 1):
        for i, text in enumerate(wrap(words(f"sheet.{key}", **field), round(room / (LETTER * 4.2)))):
            if not i:
                yield written(f"{number}", left, line, 4.2, True)
            yield written(text, left + 8.0, line, 4.2)
            line += 6.0
        line += 2.5
    yield from _bar(left, 282.0, 1.0, words("sheet.bar"), 3.5)
