"""Convex outlines as capsules, the only shape of walls: as few as cover an outline and hardly more.

A round or narrow outline is one capsule. Any other has a capsule along each side, inside of it, and a thin one into
each sharp corner. A large thing has one more in its middle, so that no node of the grid inside of it is free.
"""

from collections.abc import Sequence
from math import cos, dist, hypot, pi, sin
from typing import NamedTuple

from pigaming_app.sim.things.convex import Outline, Point, distance, from_side, inradius, inset, sides, simplified

BAND = 12.0  # px, half the thickness of a capsule along a side, at most
CUT, THIN = 5.5, 2.0  # px by which these may round a corner off; half the thickness of the one that fills it else
FIT = 4.0  # px by which a single capsule may extend beyond the outline
MOST_SIDES, SMOOTH = 12, 1.5  # sides of an outline that are kept; px of a corner that may go
FILLED = 40.0  # px: nodes of the grid are blocked as far from a wall
INNER = 0.9  # of the inradius, the half thickness of the capsule in the middle
SAMPLES = 16  # points on each end of a capsule, at which its fit is measured


class CoverPart(NamedTuple):
    """All points within `half` px of the segment from (ax, ay) to (bx, by)."""

    ax: float
    ay: float
    bx: float
    by: float
    half: float


def capsules(outline: Outline, margin: float, hollow: float = FILLED) -> list[CoverPart]:
    """Capsules that cover an outline and the points within `margin` px of it.

    `hollow`: px from the capsules along the sides to the middle, from which on that is filled.
    """
    single = around(outline, 0.0)
    if excess(single, outline) <= FIT:
        return [single._replace(half=single.half + margin)]
    corners, lost = simplified(outline, MOST_SIDES, SMOOTH)
    room = inradius(corners)
    band, extra = min(BAND, INNER * room), margin + lost
    inner = inset(corners, band)
    found = [CoverPart(*a, *b, band + extra) for a, b in sides(inner)]
    for corner in corners:
        end = _nearest(inner, corner)
        if dist(end, corner) - band > CUT:
            found.append(CoverPart(*_nearest(inset(corners, THIN), corner), *end, THIN + extra))
    if room > band + hollow:
        a, b = _farthest(inset(corners, INNER * room))
        found.append(CoverPart(*a, *b, INNER * room))
    return found


def around(outline: Outline, margin: float) -> CoverPart:
    """The narrowest capsule along one of the sides that contains an outline and the points within `margin` px."""
    best = None
    for (ax, ay), (bx, by) in sides(outline):
        length = hypot(bx - ax, by - ay)
        if length < 1e-9:
            continue
        ux, uy = (bx - ax) / length, (by - ay) / length
        along = [ux * x + uy * y for x, y in outline]
        aside = [ux * y - uy * x for x, y in outline]
        middle = 0.5 * (min(aside) + max(aside))
        half = 0.5 * (max(aside) - min(aside))
        one = _lengthwise(ux, uy, along, aside, middle, half)
        if best is None or _extent(one) < _extent(best):
            best = one
    assert best is not None
    return best._replace(half=best.half + margin)


def from_capsule(capsule: CoverPart, x: float, y: float) -> float:
    """Distance of a point from a capsule, px; negative inside."""
    return from_side((capsule.ax, capsule.ay), (capsule.bx, capsule.by), x, y) - capsule.half


def excess(capsule: CoverPart, outline: Outline) -> float:
    """The largest distance of the capsule's edge from the outline, px."""
    ends = ((capsule.ax, capsule.ay), (capsule.bx, capsule.by))
    rim = [
        (x + capsule.half * cos(pi * k / SAMPLES), y + capsule.half * sin(pi * k / SAMPLES))
        for x, y in ends
        for k in range(2 * SAMPLES)
    ]
    return max(distance(outline, x, y) for x, y in rim)


def _lengthwise(
    ux: float, uy: float, along: Sequence[float], aside: Sequence[float], middle: float, half: float
) -> CoverPart:
    """The smallest capsule along (ux, uy) on this middle line that contains all corners.

    A thin one is longer than a thick one: some between `half` and the reach of the farthest corner are tried.
    """
    reach = max(hypot(a - 0.5 * (min(along) + max(along)), b - middle) for a, b in zip(along, aside, strict=True))
    best: CoverPart | None = None
    for k in range(5):
        wide = half + (reach - half) * k / 4.0
        starts = [a + (max(0.0, wide * wide - (b - middle) ** 2)) ** 0.5 for a, b in zip(along, aside, strict=True)]
        stops = [a - (max(0.0, wide * wide - (b - middle) ** 2)) ** 0.5 for a, b in zip(along, aside, strict=True)]
        first, last = min(starts), max(stops)
        if first > last:
            first = last = 0.5 * (min(along) + max(along))
            wide = max(hypot(a - first, b - middle) for a, b in zip(along, aside, strict=True))
        one = CoverPart(
            ux * first - uy * middle, uy * first + ux * middle, ux * last - uy * middle, uy * last + ux * middle, wide
        )
        if best is None or _extent(one) < _extent(best):
            best = one
    assert best is not None
    return best


def _extent(capsule: CoverPart) -> float:
    """Area of a capsule, px^2."""
    length = hypot(capsule.bx - capsule.ax, capsule.by - capsule.ay)
    return capsule.half * (2.0 * length + pi * capsule.half)


def _nearest(points: Sequence[Point], to: Point) -> Point:
    return min(points, key=lambda point: dist(point, to))


def _farthest(corners: Sequence[Point]) -> tuple[Point, Point]:
    """The two corners that are farthest apart."""
    return max(
        ((a, b) for a in corners for b in corners), key=lambda pair: hypot(*(p - q for p, q in zip(*pair, strict=True)))
    )
