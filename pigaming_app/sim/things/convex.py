"""Geometry of convex outlines: sequences of corners, px, clockwise on screen."""

from collections.abc import Sequence
from math import hypot

Point = tuple[float, float]
Outline = tuple[Point, ...]
BISECTIONS = 20  # of the search for an inradius


def signed_area(corners: Sequence[Point]) -> float:
    """Area, px^2; positive clockwise on screen."""
    return 0.5 * sum(ax * by - bx * ay for (ax, ay), (bx, by) in sides(corners))


def sides(corners: Sequence[Point]) -> list[tuple[Point, Point]]:
    """The sides in order, each from its first corner to its second."""
    return list(zip(corners, (*corners[1:], corners[0]), strict=True))


def is_convex(corners: Sequence[Point]) -> bool:
    """True for a convex outline, clockwise on screen, that encloses an area; corners may lie on a straight side."""
    turns = [
        (bx - ax) * (cy - by) - (by - ay) * (cx - bx)
        for ((ax, ay), (bx, by)), (_, (cx, cy)) in zip(sides(corners), sides((*corners[1:], corners[0])), strict=True)
    ]
    return all(turn > -1.0 for turn in turns) and signed_area(corners) > 1.0


def contains(corners: Sequence[Point], x: float, y: float) -> bool:
    """True if a point lies in a convex outline."""
    return all((bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0.0 for (ax, ay), (bx, by) in sides(corners))


def distance(corners: Sequence[Point], x: float, y: float) -> float:
    """Distance of a point from a convex outline, px; 0 inside."""
    return 0.0 if contains(corners, x, y) else min(from_side(a, b, x, y) for a, b in sides(corners))


def inset(corners: Sequence[Point], by: float) -> list[Point]:
    """A convex outline with every side moved inwards by a distance, px; empty if nothing is left."""
    left = list(corners)
    for (ax, ay), (bx, by_) in sides(corners):
        length = hypot(bx - ax, by_ - ay)
        if length > 1e-9:
            nx, ny = (ay - by_) / length, (bx - ax) / length  # inwards
            left = _cut(left, nx, ny, nx * ax + ny * ay + by)
    return left


def inradius(corners: Sequence[Point]) -> float:
    """Radius of the largest disc inside a convex outline, px."""
    low, high = 0.0, max(hypot(bx - ax, by - ay) for ax, ay in corners for bx, by in corners)
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if inset(corners, middle) else (low, middle)
    return low


def simplified(corners: Sequence[Point], most: int, near: float) -> tuple[list[Point], float]:
    """The outline without the corners that matter least, and the largest distance of a removed one from it, px.

    Corners go while there are more than `most`, or while one stands out by less than `near` px.
    """
    left = list(corners)
    while len(left) > 3:
        heights = [from_side(left[i - 1], left[(i + 1) % len(left)], *left[i]) for i in range(len(left))]
        least = min(heights)
        if least >= near and len(left) <= most:
            break
        left.pop(heights.index(least))
    return left, max(distance(left, x, y) for x, y in corners)


def _cut(corners: Sequence[Point], nx: float, ny: float, least: float) -> list[Point]:
    """The part of a convex outline with nx x + ny y >= least."""
    kept: list[Point] = []
    if not corners:
        return kept
    for (ax, ay), (bx, by) in sides(corners):
        a, b = nx * ax + ny * ay - least, nx * bx + ny * by - least
        if a >= 0.0:
            kept.append((ax, ay))
        if a * b < 0.0:
            share = a / (a - b)
            kept.append((ax + share * (bx - ax), ay + share * (by - ay)))
    return kept


def from_side(a: Point, b: Point, x: float, y: float) -> float:
    """Distance of a point from the segment between two others, px."""
    ex, ey = b[0] - a[0], b[1] - a[1]
    length2 = ex * ex + ey * ey
    share = max(0.0, min(1.0, ((x - a[0]) * ex + (y - a[1]) * ey) / length2)) if length2 else 0.0
    return hypot(x - a[0] - share * ex, y - a[1] - share * ey)
