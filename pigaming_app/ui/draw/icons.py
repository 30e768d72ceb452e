"""Line icons on a 2 x 2 square, drawn as strokes."""

import math
from functools import partial

from pigaming_app.ui.draw.award_icons import AWARD_ICONS
from pigaming_app.ui.draw.glow import GlowCanvas
from pigaming_app.ui.draw.pen import Icon, Pen, dot, fill, line, ring, together
from pigaming_app.ui.draw.theme import Color, cut_box


def icon(ink: GlowCanvas, name: str, x: float, y: float, r: float, color: Color, w: float | None = None) -> GlowCanvas:
    """Draw the icon `name` (a key of ICONS) round (x, y), `r` px to each side, with lines `w` px wide."""
    ICONS[name](Pen(ink, x, y, r, color, w or max(3, r * 0.13)))
    return ink


def _shield(pen: Pen) -> None:
    outline = ((0, -0.95), (0.8, -0.6), (0.72, 0.2), (0.4, 0.68), (0, 0.98), (-0.4, 0.68), (-0.72, 0.2), (-0.8, -0.6))
    pen.line(*outline, closed=True)
    pen.line((-0.34, 0.0), (-0.08, 0.3), (0.4, -0.28))


def _rapid(pen: Pen) -> None:
    for d in (-0.62, 0, 0.62):
        pen.line((-0.75, d), (0.25, d))
        pen.dot(0.7, d, 0.17)


def _triple(pen: Pen) -> None:
    for a in (-0.5, 0, 0.5):
        c, s = math.cos(a), math.sin(a)
        pen.line((-0.8 + 0.3 * c, 0.33 * s), (-0.8 + 1.2 * c, 1.2 * s))
        pen.dot(-0.8 + 1.65 * c, 1.65 * s, 0.17)


def _mine(pen: Pen) -> None:
    pen.ring(0.55)
    for i in range(8):
        c, s = math.cos(i * math.tau / 8), math.sin(i * math.tau / 8)
        pen.line((0.62 * c, 0.62 * s), (0.95 * c, 0.95 * s))
    pen.dot(0, 0, 0.2)


def _pad(pen: Pen) -> None:
    half = ((0.55, -0.52), (0.82, -0.34), (1.0, 0.42), (0.86, 0.66), (0.62, 0.6), (0.36, 0.26))
    pen.line(*half, *((-x, y) for x, y in reversed(half)), closed=True)
    pen.line((-0.62, -0.12), (-0.26, -0.12))
    pen.line((-0.44, -0.3), (-0.44, 0.06))
    for x, y in ((0.3, -0.12), (0.58, -0.12), (0.44, -0.28), (0.44, 0.04)):
        pen.dot(x, y, 0.075)


def _keys(pen: Pen) -> None:
    pen.line(*cut_box(-1, -0.58, 2, 1.16, 0.14), closed=True)
    for y in (-0.25, 0.05):
        for x in (-0.66, -0.22, 0.22, 0.66):
            pen.dot(x, y, 0.09)
    pen.line((-0.4, 0.34), (0.4, 0.34))


def _keypad(pen: Pen) -> None:
    """Three rows of keys above a wide one."""
    pen.line(*cut_box(-0.66, -0.74, 1.32, 1.48, 0.14), closed=True)
    for y in (-0.42, -0.1, 0.22):
        for x in (-0.34, 0.0, 0.34):
            pen.dot(x, y, 0.1)
    pen.line((-0.32, 0.5), (0.32, 0.5))


def _ai(pen: Pen) -> None:
    pen.line(*cut_box(-0.72, -0.42, 1.44, 1.1, 0.22), closed=True)
    pen.dot(-0.3, 0.08, 0.14)
    pen.dot(0.3, 0.08, 0.14)
    pen.line((0, -0.46), (0, -0.8))
    pen.dot(0, -0.86, 0.12)
    pen.line((-0.95, 0), (-0.95, 0.3))
    pen.line((0.95, 0), (0.95, 0.3))
    pen.line((-0.22, 0.42), (0.22, 0.42))


def _shoot(pen: Pen) -> None:
    """A cross-hair."""
    pen.ring(0.66)
    for k in range(4):
        c, s = math.cos(k * math.tau / 4), math.sin(k * math.tau / 4)
        pen.line((0.42 * c, 0.42 * s), (1.0 * c, 1.0 * s))


def _arrow(pen: Pen, up: float) -> None:
    pen.line((0, 0.9 * up), (0, -0.4 * up))
    pen.fill((0, -1.0 * up), (0.68, -0.12 * up), (-0.68, -0.12 * up))


def _hook(pen: Pen, side: float) -> None:
    """A U-turn arrow: up, over and down on one side."""
    arc = [math.pi * (0.95 + 1.05 * i / 14) for i in range(15)]
    pen.line(*((side * (0.6 * math.cos(a) - 0.08), 0.06 + 0.6 * math.sin(a)) for a in arc))
    pen.fill((side * 0.06, 0.06), (side * 0.98, 0.06), (side * 0.52, 0.8))


def _oil(pen: Pen) -> None:
    """A drop."""
    side = [(0.62 * math.sin(a / 8), 0.28 - 0.62 * math.cos(a / 8)) for a in range(6, 45)]
    pen.line((0, -0.98), *side, closed=True)
    pen.line((-0.3, 0.3), (-0.22, 0.52), (0.0, 0.6))


def _list(pen: Pen) -> None:
    """Lines of a list."""
    for y in (-0.62, 0.0, 0.62):
        pen.dot(-0.76, y, 0.15)
        pen.line((-0.36, y), (0.9, y))


def _point(pen: Pen) -> None:
    """A stick with an arrow in every direction."""
    pen.dot(0, 0, 0.26)
    for k in range(4):
        c, s = math.cos(k * math.tau / 4), math.sin(k * math.tau / 4)
        pen.fill(*((a * c - b * s, a * s + b * c) for a, b in ((1.0, 0.0), (0.5, 0.42), (0.5, -0.42))))


ICONS: dict[str, Icon] = {
    "shield": _shield,
    "speed": together(*(line((x - 0.28, -0.7), (x + 0.32, 0), (x - 0.28, 0.7)) for x in (-0.62, 0, 0.62))),
    "rapid": _rapid,
    "triple": _triple,
    "ricochet": together(
        line((-0.95, 0.85), (0.95, 0.85)),
        line((-0.9, -0.7), (-0.1, 0.6), (0.75, -0.75)),
        line((0.2, -0.72), (0.75, -0.75), (0.86, -0.2)),
    ),
    "mine": _mine,
    "pad": _pad,
    "phone": together(
        line(*cut_box(-0.56, -0.96, 1.12, 1.92, 0.16), closed=True),
        line((-0.16, -0.7), (0.16, -0.7)),
        dot(0, 0.68, 0.11),
    ),
    "keys": _keys,
    "keypad": _keypad,
    "ai": _ai,
    "check": line((-0.8, 0.05), (-0.25, 0.6), (0.85, -0.6)),
    "crown": line((-0.9, 0.55), (-0.9, -0.5), (-0.42, 0), (0, -0.75), (0.42, 0), (0.9, -0.5), (0.9, 0.55), closed=True),
    "left": line((0.35, -0.7), (-0.35, 0), (0.35, 0.7)),
    "right": line((-0.35, -0.7), (0.35, 0), (-0.35, 0.7)),
    "up": line((-0.7, 0.35), (0, -0.35), (0.7, 0.35)),
    "down": line((-0.7, -0.35), (0, 0.35), (0.7, -0.35)),
    "plus": together(line((-0.8, 0), (0.8, 0)), line((0, -0.8), (0, 0.8))),
    "cross": together(line((-0.6, -0.6), (0.6, 0.6)), line((-0.6, 0.6), (0.6, -0.6))),
    "circle": ring(0.62),
    "square": line((-0.56, -0.56), (0.56, -0.56), (0.56, 0.56), (-0.56, 0.56), closed=True),
    "triangle": line((0, -0.76), (0.7, 0.46), (-0.7, 0.46), closed=True),
    "clock": together(ring(0.88), line((0, -0.5), (0, 0), (0.38, 0.22))),
    "shoot": _shoot,
    "ahead": partial(_arrow, up=1.0),
    "behind": partial(_arrow, up=-1.0),
    "turn_left": partial(_hook, side=-1.0),
    "turn_right": partial(_hook, side=1.0),
    "stay": together(*(line((x, -0.6), (x, 0.6)) for x in (-0.34, 0.34))),
    "unknown": together(*(dot(x, 0, 0.17) for x in (-0.6, 0.0, 0.6))),
    "oil": _oil,
    "list": _list,
    "play": fill((-0.45, -0.66), (0.55, 0.0), (-0.45, 0.66)),
    "faster": together(*(fill((x, -0.66), (x + 0.85, 0.0), (x, 0.66)) for x in (-0.85, 0.0))),
    "fastest": together(*(fill((x, -0.6), (x + 0.66, 0.0), (x, 0.6)) for x in (-0.95, -0.32, 0.31))),
    "wheel": together(  # of a car
        ring(0.86),
        dot(0, 0.06, 0.2),
        line((-0.84, -0.06), (-0.2, 0.02)),
        line((0.84, -0.06), (0.2, 0.02)),
        line((0, 0.22), (0, 0.84)),
    ),
    "point": _point,
    "button": together(ring(0.92), dot(0, 0, 0.56)),
    "pencil": together(
        line((-0.9, 0.9), (-0.72, 0.26), (0.5, -0.96), (0.96, -0.5), (-0.26, 0.72), closed=True),
        line((0.2, -0.66), (0.66, -0.2)),
    ),
    **AWARD_ICONS,
}
