"""A rose of sixteen petals round a robot that faces up: value and action per direction.

Length and colour of a petal both show its value; good and bad also differ in brightness, for the colour-blind.
"""

import math
from collections.abc import Sequence

import pygame

from pigaming_app.ui.draw import ADD, ICE, MIST, THIN, Color, GlowCanvas, Points, dim, icon
from pigaming_app.ui.draw.sprites import Batch, Sprite, put, trim
from pigaming_app.ui.draw.surface_cache import cached

PETALS = 16
GOOD, BAD = (70, 214, 255), (255, 84, 60)
LEVELS = 10  # petal lengths in each direction of the scale
EMPTY = (30, 38, 50)
SHORTEST = 0.2  # share of a petal's room
GLOW = 24  # px of glow round a petal
SIGN = 15  # half the size of an action's sign, px
SIGN_AT = 27  # px from the outer radius to the middle of the sign
SIGNS = ("shoot", "ahead", "behind", "turn_left", "turn_right", "stay", "unknown")


def draw_petals(
    screen: pygame.Surface, x: float, y: float, levels: Sequence[int], inner: int = 50, outer: int = 140
) -> None:
    """Petals round (x, y); `levels`: per direction, clockwise from ahead, -LEVELS (bad) to LEVELS (good)."""
    batch: Batch = []
    for k, level in enumerate(levels):
        put(batch, petal(k, level, inner, outer), x, y)
    screen.fblits(batch, ADD)


def draw_signs(screen: pygame.Surface, x: float, y: float, signs: Sequence[str], outer: int = 140) -> None:
    """The action per direction, a key of SIGNS, at the end of each petal; "shoot" is brighter."""
    batch: Batch = []
    for k, name in enumerate(signs):
        angle = middle(k)
        put(batch, sign(name), x + (outer + SIGN_AT) * math.cos(angle), y + (outer + SIGN_AT) * math.sin(angle))
    screen.fblits(batch, ADD)


def middle(k: int) -> float:
    """The angle of the middle of petal `k` on the screen, rad."""
    return math.tau * k / PETALS - math.pi / 2


def tone(level: int) -> Color:
    """The colour of a level."""
    return dim(GOOD if level > 0 else BAD, 0.45 + 0.55 * abs(level) / LEVELS)


@cached
def petal(k: int, level: int, inner: int, outer: int) -> Sprite:
    """One petal and its outline, anchored at the middle of the rose."""
    room = _slice(k, inner, outer)
    left, top = min(x for x, _ in room) - GLOW, min(y for _, y in room) - GLOW
    w, h = max(x for x, _ in room) + GLOW - left, max(y for _, y in room) + GLOW - top
    ink = GlowCanvas(math.ceil(w), math.ceil(h)).set_transform(-left, -top)
    ink.line(room, EMPTY, 2, True)
    if level:
        reach = inner + (outer - inner) * (SHORTEST + (1 - SHORTEST) * abs(level) / LEVELS)
        shape, color = _slice(k, inner, reach), tone(level)
        ink.fill(shape, dim(color, 0.5)).line(shape, color, THIN, True)
    return trim(ink.lit(0.6), -left, -top)


@cached
def sign(name: str, r: int = SIGN) -> Sprite:
    """The sign of an action, `r` px to each side."""
    ink = GlowCanvas(2 * r + 32, 2 * r + 32, 3)
    icon(ink, name, r + 16, r + 16, r, ICE if name == "shoot" else MIST, 0.26 * r if name == "shoot" else 0.32 * r)
    return trim(ink.lit(0.3), r + 16, r + 16)


def _slice(k: int, inner: float, outer: float) -> Points:
    """The outline of petal `k` between two radii."""
    half, at = math.pi / PETALS - 0.03, middle(k)
    angles = [at + half * i / 4 for i in range(-4, 5)]
    ends = [(inner * math.cos(a), inner * math.sin(a)) for a in angles]
    return [*ends, *((outer * math.cos(a), outer * math.sin(a)) for a in reversed(angles))]
