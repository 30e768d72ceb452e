"""Marks on the board: what cannot be played, where it is, and faintly how AIs will drive."""

import math
from collections.abc import Sequence
from itertools import pairwise

import pygame

from pigaming_app.scenes.editor.board import SCALE, on_canvas
from pigaming_app.scenes.editor.model.problems import Problem
from pigaming_app.scenes.editor.model.shapes import Routes
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import ALARM, BLACK, LINE, ORANGE, Color, GlowCanvas, Point, dim, icon
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import LEVELS, dimmed, pulse

SIZES = (40, 60, 90, 130)  # px, radius of a mark
ROUTE = (38, 92, 104)
DASH, GAP = 14.0, 12.0  # px


def draw_problems(screen: pygame.Surface, problems: Sequence[Problem], seconds: float) -> None:
    """Draw a ring round each problem: red with a cross if it blocks, else orange with the walls that are too near."""
    for problem in problems:
        extent = SCALE * problem.extent
        radius = next((size for size in SIZES if size >= extent + 16), SIZES[-1])
        x, y = min(max(problem.x, 0.0), WIDTH), min(max(problem.y, 0.0), HEIGHT)
        mark(radius, problem.blocks, pulse(seconds, 6)).draw(screen, *on_canvas(x, y))


def draw_routes(screen: pygame.Surface, routes: Routes, seconds: float) -> None:
    """Draw the ways of AIs as faint dashes that run along them."""
    for route in routes:
        for a, b in _dashes([on_canvas(*point) for point in route], 30.0 * seconds % (DASH + GAP)):
            pygame.draw.line(screen, ROUTE, a, b, 4)


def _dashes(points: Sequence[Point], first: float) -> list[tuple[Point, Point]]:
    """Dashes along a line, the first one `first` px after its start."""
    found, at = list[tuple[Point, Point]](), first - DASH - GAP
    for a, b in pairwise(points):
        length = math.dist(a, b)
        if length < 1e-6:
            continue
        ux, uy = (b[0] - a[0]) / length, (b[1] - a[1]) / length
        while at < length:
            start, end = max(at, 0.0), min(at + DASH, length)
            if end > start:
                found.append(((a[0] + ux * start, a[1] + uy * start), (a[0] + ux * end, a[1] + uy * end)))
            if at + DASH + GAP > length:
                break
            at += DASH + GAP
        at -= length
    return found


@cached
def mark(radius: int, blocks: bool, level: int) -> LitImage:
    """The ring round a problem, centred on (0, 0)."""
    if level < LEVELS:
        return dimmed(mark(radius, blocks, LEVELS), level / LEVELS)
    color: Color = ALARM if blocks else ORANGE
    size = radius + 40
    ink = GlowCanvas(2 * size, 2 * size).set_transform(size, size)
    ink.ring(0, 0, radius, color, LINE)
    if blocks:
        x = radius * math.sqrt(0.5)
        ink.disc(x, -x, 24, BLACK)
        icon(ink.disc(x, -x, 21, color), "cross", x, -x, 12, BLACK, LINE)
    else:
        for s in (1, -1):
            ink.line([(26 * s, -10), (12 * s, 0), (26 * s, 10)], dim(color, 0.9), 5)
    return LitImage(ink.lit(0.7), (-size, -size))
