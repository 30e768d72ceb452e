"""Floors of walled arenas: faint patterns, each with a tint of its own, on black. Drawn in px of the arena.

Real robots must be found on them, so no channel is above BRIGHTEST, and fields are darker still.
"""

import math
from collections.abc import Callable, Mapping
from zlib import crc32

from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import Color, GlowCanvas, Point, regular_polygon

LINE, DOT = 2, 1.6  # px
BRIGHTEST = 72  # of 255, any channel of any pattern
BANDS, CUT = 10, 28  # mown stripes of a turf, and px by which its corners are cut
Pattern = Callable[[GlowCanvas], object]


def pattern_of(arena: Arena) -> str:
    """The floor of an arena: the one in its file, else one that its name chooses."""
    names = [name for name in FLOORS if name != "turf"]
    return arena.floor or names[crc32(arena.name.encode()) % len(names)]


def grid(ink: GlowCanvas) -> None:
    """Dots and crosses, and a dial in the middle: blue."""
    for x in range(50, int(WIDTH), 50):
        for y in range(50, int(HEIGHT), 50):
            if x % 200 == 0 and (y - 50) % 200 == 0:
                ink.line([(x - 7, y), (x + 7, y)], (34, 48, 70), LINE).line(
                    [(x, y - 7), (x, y + 7)], (34, 48, 70), LINE
                )
            else:
                ink.disc(x, y, DOT, (26, 37, 54))
    cx, cy = WIDTH / 2, HEIGHT / 2
    ink.ring(cx, cy, 150, (20, 29, 43), 3).ring(cx, cy, 164, (20, 29, 43), LINE)
    for i in range(24):
        c, s = math.cos(i * math.tau / 24), math.sin(i * math.tau / 24)
        ink.line([(cx + 172 * c, cy + 172 * s), (cx + 180 * c, cy + 180 * s)], (24, 35, 52), 3)


def paving(ink: GlowCanvas) -> None:
    """Slabs in a running bond: sand."""
    color, high, wide = (54, 44, 28), 75, 160
    for row in range(int(HEIGHT) // high):
        y = row * high
        if row:
            ink.line([(20, y), (WIDTH - 20, y)], color, LINE)
        for x in range(wide // 2 if row % 2 else wide, int(WIDTH), wide):
            ink.line([(x, y + 8), (x, y + high - 8)], color, LINE)


def waves(ink: GlowCanvas) -> None:
    """Ripples of water: teal."""
    for row, y in enumerate(range(60, int(HEIGHT), 60)):
        for x in range(60 + 110 * (row % 2), int(WIDTH) - 120, 220):
            crest = [(x + 5.0 * i, y - 9 * math.sin(i * math.tau / 20)) for i in range(21)]
            ink.line(crest, (14, 52, 60), LINE + 1)


def hexagons(ink: GlowCanvas) -> None:
    """A honeycomb: violet."""
    r = 62.0
    across, down = math.sqrt(3.0) * r, 1.5 * r
    for row in range(1, int(HEIGHT / down) + 1):
        for column in range(int(WIDTH / across)):
            x, y = across * (column + (1.0 if row % 2 else 0.5)), down * (row - 0.2)
            if across / 2 < x < WIDTH - across / 2 and r < y < HEIGHT - r:
                ink.line(regular_polygon(6, r - 7, math.pi / 6, x, y), (46, 36, 72), LINE, True)


def strata(ink: GlowCanvas) -> None:
    """Layers of earth, whose dashes run on unevenly: brown."""
    for row, y in enumerate(range(40, int(HEIGHT) - 20, 42)):
        x = 30.0 + 47 * (row * 5 % 7)
        while x < WIDTH - 120:
            long = 60 + 40 * ((row * 3 + int(x) // 90) % 4)
            end = min(x + long, WIDTH - 30)
            ink.line([(x, y), ((x + end) / 2, y + 7 - row % 3 * 7), (end, y)], (62, 42, 20), LINE + 1)
            x = end + 70 + 30 * ((row + int(x)) % 3)


def circuit(ink: GlowCanvas) -> None:
    """Traces of a circuit board with their pads: green."""
    color = (16, 54, 36)
    for row, y in enumerate(range(70, int(HEIGHT) - 60, 84)):
        for column, x in enumerate(range(60 + 70 * (row % 2), int(WIDTH) - 200, 250)):
            rise = 34 if (row + column) % 2 else -34
            trace: list[Point] = [(x, y), (x + 70, y), (x + 70 + abs(rise), y + rise), (x + 150, y + rise)]
            ink.line(trace, color, LINE).ring(*trace[0], 6, color, LINE).disc(*trace[-1], 5, color)


def diamonds(ink: GlowCanvas) -> None:
    """Lozenges: rose."""
    for row, y in enumerate(range(75, int(HEIGHT), 75)):
        for x in range(100 + 100 * (row % 2), int(WIDTH) - 60, 200):
            ink.line([(x - 62, y), (x, y - 42), (x + 62, y), (x, y + 42)], (62, 30, 50), LINE, True)


def turf(ink: GlowCanvas) -> None:
    """Mown grass: green stripes."""
    wide = WIDTH / BANDS
    for i in range(BANDS):
        left, right = CUT if i == 0 else 0, CUT if i == BANDS - 1 else 0
        a, b = i * wide, (i + 1) * wide
        band = [(a + left, 0.0), (b - right, 0.0), (b, right), (b, HEIGHT - right), (b - right, HEIGHT)]
        ink.fill([*band, (a + left, HEIGHT), (a, HEIGHT - left), (a, left)], GRASS[i % 2])


GRASS: tuple[Color, Color] = (3, 18, 8), (7, 30, 14)
FLOORS: Mapping[str, Pattern] = {
    "grid": grid,
    "paving": paving,
    "waves": waves,
    "hexagons": hexagons,
    "strata": strata,
    "circuit": circuit,
    "diamonds": diamonds,
    "turf": turf,
}
