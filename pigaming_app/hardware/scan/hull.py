"""Convex hull of an outline, with coordinates that an arena file can hold."""

from collections.abc import Iterable

from pigaming_app.sim.things.convex import Outline, Point


def hull(points: Iterable[Point]) -> Outline:
    """The corners of the convex hull, rounded to 0.1 px, clockwise on screen; none on a straight side.

    Monotone chain, A. M. Andrew, Information Processing Letters 9, 1979.
    """
    corners = sorted({(round(x, 1), round(y, 1)) for x, y in points})
    return (*_half(corners)[:-1], *_half(corners[::-1])[:-1])


def _half(corners: list[Point]) -> list[Point]:
    """The part of the hull from the first corner to the last one."""
    kept: list[Point] = []
    for x, y in corners:
        while len(kept) > 1 and _turn(kept[-2], kept[-1], (x, y)) <= 0.0:
            kept.pop()
        kept.append((x, y))
    return kept


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
