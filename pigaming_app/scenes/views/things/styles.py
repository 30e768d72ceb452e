"""The look of real things in each game: light around walls, mud, paint. Corners are px, convex, clockwise on screen."""

import math
import random
from collections.abc import Callable, Sequence
from typing import NamedTuple

from pigaming_app.scenes.views.things.outlines import along, draw_blocks, grown, mix_points
from pigaming_app.sim.things.convex import contains, inset
from pigaming_app.ui.draw import ALARM, BLACK, ICE, LINE, STEEL, THIN, WALL, Color, GlowCanvas, Point, Points, dim

MUD: Color = (170, 106, 44)
DARK = 2  # px between the margin of a thing and the light around it
BLOCK, KERB = 26.0, 12.0  # px, length and width of kerb blocks
BAND = 18.0  # px, width of the light around a wall
STRIPE, TAPE = 22.0, 12.0  # px, length and width of warning stripes
WARNING: Color = (226, 168, 40)
CONTOUR, RIPPLE = 17.0, 2.0  # px between contour lines of mud, px of their waves
CUTS = 2  # times that the corners of a contour line are cut
CLOD = 900.0  # px^2 of mud for each clod
ZONE = 30.0  # px between the stripes of a slow zone


class ThingStyle(NamedTuple):
    """How a game draws a wall (canvas, corners, margin), mud and a line (canvas, corners)."""

    wall: Callable[[GlowCanvas, Sequence[Point], float], None]
    mud: Callable[[GlowCanvas, Sequence[Point]], None]
    line: Callable[[GlowCanvas, Sequence[Point]], None]


# ---- PiTanks: neon


def neon_wall(ink: GlowCanvas, corners: Sequence[Point], margin: float) -> None:
    """A neon outline on a band of light."""
    near = margin + DARK
    ink.line(grown(corners, near + BAND / 2), dim(WALL, 0.3), BAND, True)
    ink.neon(grown(corners, near + LINE / 2), WALL, LINE, True)


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


NEON = ThingStyle(neon_wall, mud, neon_line)
ROAD = ThingStyle(kerb_wall, mud, road_paint)
WORKSHOP = ThingStyle(warning_wall, slow_zone, floor_paint)


def _wavy(ring: Points, level: int) -> list[Point]:
    """A contour line of mud: round corners, and waves that reach inwards."""
    out = list(ring)
    for _ in range(CUTS):
        loop = zip(out, (*out[1:], out[0]), strict=True)
        out = [p for a, b in loop for p in (mix_points(a, b, 0.2), mix_points(a, b, 0.8))]
    waves = []
    for i, ((x, y), (nx, ny), _) in enumerate(along(out, 8.0)):
        wave = RIPPLE * (1.0 + math.sin(0.55 * i + 1.7 * level) * math.cos(0.23 * i + level))
        waves.append((x - wave * nx, y - wave * ny))
    return waves if len(waves) > 2 else out


def _clods(ink: GlowCanvas, corners: Sequence[Point]) -> None:
    """Clods inside an outline."""
    xs, ys = [x for x, _ in corners], [y for _, y in corners]
    rng = random.Random(3)
    for _ in range(round((max(xs) - min(xs)) * (max(ys) - min(ys)) / CLOD)):
        x, y = rng.uniform(min(xs), max(xs)), rng.uniform(min(ys), max(ys))
        if contains(corners, x, y):
            ink.disc(x, y, rng.choice((1.6, 2.2, 2.8)), dim(MUD, 0.8))
