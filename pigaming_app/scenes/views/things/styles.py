"""The look of real things in each game: light around walls, mud, paint. Corners are px, convex, clockwise on screen."""

import math
import random
from collections.abc import Callable, Sequence
from typing import NamedTuple

from pigaming_app.scenes.views.race.track import MUD
from pigaming_app.scenes.views.things.outlines import along, draw_blocks, grown
from pigaming_app.sim.things.convex import contains, inset
from pigaming_app.ui.draw import ALARM, BLACK, ICE, LINE, STEEL, THIN, WALL, Color, GlowCanvas, Point, Points, dim

DARK = 2  # px between the margin of a thing and the light around it
BLOCK, KERB = 26.0, 12.0  # px, length and width of kerb blocks
HATCH, HATCHED = 18.0, 11.0  # px between the ticks around a wall, px that they reach outwards
STRIPE, TAPE = 22.0, 12.0  # px, length and width of warning stripes
WARNING: Color = (226, 168, 40)
CONTOUR, RIPPLE = 17.0, 2.5  # px between contour lines of mud, px of their waves
CLOD = 900.0  # px^2 of mud for each clod
ZONE = 30.0  # px between the stripes of a slow zone


class Style(NamedTuple):
    """How a game draws a wall (canvas, corners, margin), mud and a line (canvas, corners)."""

    wall: Callable[[GlowCanvas, Sequence[Point], float], None]
    mud: Callable[[GlowCanvas, Sequence[Point]], None]
    line: Callable[[GlowCanvas, Sequence[Point]], None]


# ---- PiTanks: a solid wall, its ticks outside


def neon_wall(ink: GlowCanvas, corners: Sequence[Point], margin: float) -> None:
    """A neon outline with the slanted ticks of an indestructible wall around it."""
    rim = grown(corners, margin + DARK + LINE / 2)
    ticks = grown(corners, margin + DARK + LINE + 3)
    for (x, y), (nx, ny), (tx, ty) in along(ticks, HATCH):
        end = x + HATCHED * (nx + 0.6 * tx), y + HATCHED * (ny + 0.6 * ty)
        ink.line([(x, y), end], dim(WALL, 0.5), 3)
    ink.neon(rim, WALL, LINE, True)


def mud(ink: GlowCanvas, corners: Sequence[Point]) -> None:
    """Mud: wavy brown contour lines with clods between them."""
    ink.fill(corners, dim(MUD, 0.16))
    ring, level = inset(corners, 4.0), 0
    while len(ring) > 2:
        ink.line(_wavy(ring, level), dim(MUD, 0.85 if not level else 0.6), THIN if not level else 3, True)
        level += 1
        ring = inset(corners, 4.0 + CONTOUR * level)
    _clods(ink, corners)


def neon_line(ink: GlowCanvas, corners: Sequence[Point]) -> None:
    """A strip of light with a bright outline."""
    ink.fill(corners, dim(STEEL, 0.6)).line(corners, ICE, THIN, True)


# ---- Race: kerbs, road paint


def kerb_wall(ink: GlowCanvas, corners: Sequence[Point], margin: float) -> None:
    """A kerb of red and white blocks around a thing."""
    near = margin + DARK
    draw_blocks(ink, grown(corners, near), grown(corners, near + KERB), BLOCK, (ICE, ALARM))


def road_paint(ink: GlowCanvas, corners: Sequence[Point]) -> None:
    """White road paint."""
    ink.fill(corners, dim(ICE, 0.62))


# ---- Factory: warning tape, a slow zone, floor paint


def warning_wall(ink: GlowCanvas, corners: Sequence[Point], margin: float) -> None:
    """Slanted warning stripes around a thing."""
    near = margin + DARK
    inner, outer = grown(corners, near), grown(corners, near + TAPE)
    draw_blocks(ink, inner, outer, STRIPE / 2, (WARNING, BLACK), slant=TAPE)
    ink.line(outer, WARNING, 3, True)


def slow_zone(ink: GlowCanvas, corners: Sequence[Point]) -> None:
    """A hatched zone of the floor."""
    ink.fill(corners, dim(WARNING, 0.08))
    xs, ys = [x for x, _ in corners], [y for _, y in corners]
    reach = max(ys) - min(ys)
    x = min(xs) - reach + ZONE / 2
    while x < max(xs):
        run = [
            (x + reach * k / 64, max(ys) - reach * k / 64)
            for k in range(65)
            if contains(corners, x + reach * k / 64, max(ys) - reach * k / 64)
        ]
        if len(run) > 1:
            ink.line([run[0], run[-1]], dim(WARNING, 0.42), 7)
        x += ZONE
    ink.line(corners, dim(WARNING, 0.75), THIN, True)


def floor_paint(ink: GlowCanvas, corners: Sequence[Point]) -> None:
    """Yellow floor paint."""
    ink.fill(corners, dim(WARNING, 0.62))


STYLES = {
    "pitanks": Style(neon_wall, mud, neon_line),
    "race": Style(kerb_wall, mud, road_paint),
    "factory": Style(warning_wall, slow_zone, floor_paint),
}


def _wavy(ring: Points, seed: int) -> list[Point]:
    """A closed line with waves."""
    out = []
    for i, ((x, y), (nx, ny), _) in enumerate(along(ring, 7.0)):
        wave = RIPPLE * (math.sin(0.9 * i + 1.7 * seed) + 0.7 * math.sin(0.37 * i + seed))
        out.append((x - abs(wave) * nx, y - abs(wave) * ny))
    return out if len(out) > 2 else list(ring)


def _clods(ink: GlowCanvas, corners: Sequence[Point]) -> None:
    """Clods inside an outline."""
    xs, ys = [x for x, _ in corners], [y for _, y in corners]
    rng = random.Random(3)
    for _ in range(round((max(xs) - min(xs)) * (max(ys) - min(ys)) / CLOD)):
        x, y = rng.uniform(min(xs), max(xs)), rng.uniform(min(ys), max(ys))
        if contains(corners, x, y):
            ink.disc(x, y, rng.choice((1.6, 2.2, 2.8)), dim(MUD, 0.8))
