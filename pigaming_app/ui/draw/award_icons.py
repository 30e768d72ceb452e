"""Line icons of awards."""

import math

from pigaming_app.ui.draw.pen import Icon, Pen, dot, fill, line, ring, together
from pigaming_app.ui.draw.theme import Point, cut_box


def around(x: float, y: float, r: float, start: float, end: float, steps: int = 20) -> list[Point]:
    """Points of an arc; angles in turns, clockwise from the right."""
    angles = [math.tau * (start + (end - start) * i / steps) for i in range(steps + 1)]
    return [(x + r * math.cos(a), y + r * math.sin(a)) for a in angles]


def circle(x: float, y: float, r: float) -> Icon:
    """A circle anywhere on the square."""
    return line(*around(x, y, r, 0.0, 1.0))


def _spiral(pen: Pen) -> None:
    turns = 2.25
    points = [(i / 60, math.tau * turns * i / 60) for i in range(61)]
    pen.line(*((0.92 * share * math.cos(a), 0.92 * share * math.sin(a)) for share, a in points))


def _calm(pen: Pen) -> None:
    """Three gentle waves."""
    for y in (-0.5, 0.0, 0.5):
        pen.line(*((-0.95 + 1.9 * i / 24, y + 0.14 * math.sin(math.tau * i / 24 * 1.5)) for i in range(25)))


def _heart(pen: Pen) -> None:
    angles = [math.tau * i / 40 for i in range(40)]
    shape = [
        (16 * math.sin(a) ** 3, 13 * math.cos(a) - 5 * math.cos(2 * a) - 2 * math.cos(3 * a) - math.cos(4 * a))
        for a in angles
    ]
    pen.line(*((x / 17.5, -y / 17.5 - 0.08) for x, y in shape), closed=True)


def _gear(pen: Pen) -> None:
    teeth = 8
    corners = []
    for i in range(teeth):
        for share, r in ((-0.3, 0.68), (-0.2, 0.96), (0.2, 0.96), (0.3, 0.68)):
            a = math.tau * (i + share) / teeth
            corners.append((r * math.cos(a), r * math.sin(a)))
    pen.line(*corners, closed=True)
    pen.ring(0.3)


def _ball(pen: Pen) -> None:
    pen.ring(0.92)
    corners = [math.tau * (i / 5 - 0.25) for i in range(5)]
    pen.line(*((0.36 * math.cos(a), 0.36 * math.sin(a)) for a in corners), closed=True)
    for a in corners:
        pen.line((0.36 * math.cos(a), 0.36 * math.sin(a)), (0.86 * math.cos(a), 0.86 * math.sin(a)))


def _star(pen: Pen, y: float, r: float) -> None:
    points = [(r if i % 2 == 0 else 0.45 * r, math.tau * (i / 10 - 0.25)) for i in range(10)]
    pen.line(*((far * math.cos(a), y + far * math.sin(a)) for far, a in points), closed=True)


def _medal(pen: Pen) -> None:
    """A star on a ribbon."""
    pen.line((-0.62, -0.98), (-0.2, -0.3))
    pen.line((0.62, -0.98), (0.2, -0.3))
    pen.line(*around(0, 0.34, 0.62, 0.0, 1.0))
    _star(pen, 0.36, 0.36)


def _clover(pen: Pen) -> None:
    for k in range(4):
        a = math.tau * (k / 4 + 0.125)
        pen.line(*around(0.5 * math.cos(a), 0.5 * math.sin(a) - 0.1, 0.4, 0.0, 1.0))
    pen.line((0.0, 0.1), (0.12, 0.6), (0.36, 0.98))


AWARD_ICONS: dict[str, Icon] = {
    "target": together(ring(0.92), ring(0.52), dot(0, 0, 0.2)),
    "first": together(
        line((-0.6, 1.0), (-0.6, -0.95)), line((-0.6, -0.85), (0.85, -0.85), (0.5, -0.35), (0.85, 0.15), (-0.6, 0.15))
    ),
    "rebound": together(
        line((-0.95, -0.35), (-0.25, 0.7), (0.6, -0.6)), fill((0.95, -0.98), (0.86, -0.2), (0.18, -0.62))
    ),
    "even": together(*(line((x, -0.8), (x, 0.8)) for x in (-0.75, -0.25, 0.25, 0.75))),
    "road": together(
        line((-0.95, 0.95), (-0.3, -0.95)),
        line((0.95, 0.95), (0.3, -0.95)),
        *(line((0.0, y), (0.0, y + 0.34)) for y in (-0.9, -0.28, 0.44)),
    ),
    "compass": together(ring(0.92), fill((0.42, -0.52), (0.14, 0.14), (-0.14, -0.14)), line((-0.42, 0.52), (0.0, 0.0))),
    "spiral": _spiral,
    "calm": _calm,
    "hourglass": together(
        line((-0.6, -0.92), (0.6, -0.92), (-0.6, 0.92), (0.6, 0.92), closed=True),
        fill((-0.34, 0.78), (0.34, 0.78), (0, 0.3)),
    ),
    "amid": together(dot(0, 0, 0.3), *(circle(0.68 * x, 0.68 * y, 0.24) for x in (-1, 1) for y in (-1, 1))),
    "heart": _heart,
    "gear": _gear,
    "crate": together(
        line(*cut_box(-0.85, -0.85, 1.7, 1.7, 0.1), closed=True),
        line((-0.8, -0.8), (0.8, 0.8)),
        line((0.8, -0.8), (-0.8, 0.8)),
    ),
    "ball": _ball,
    "pass": together(
        circle(-0.7, 0.5, 0.26), line((-0.4, 0.3), (0.45, -0.34)), fill((0.8, -0.62), (0.58, -0.06), (0.22, -0.52))
    ),
    "medal": _medal,
    "smile": together(
        ring(0.92), dot(-0.34, -0.26, 0.13), dot(0.34, -0.26, 0.13), line(*around(0, 0.02, 0.52, 0.06, 0.44))
    ),
    "clover": _clover,
    "fair": together(circle(-0.36, 0.0, 0.58), circle(0.36, 0.0, 0.58)),
}
"""By name, as in ICONS."""
