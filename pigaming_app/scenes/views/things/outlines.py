"""Geometry of the light around outlines: px, convex, clockwise on screen."""

import math
from collections.abc import Sequence
from itertools import pairwise

from pigaming_app.sim.things.convex import sides
from pigaming_app.ui.draw import BLACK, Color, GlowCanvas, Point, Points


def grown(corners: Sequence[Point], by: float) -> list[Point]:
    """A convex outline with every side moved outwards, and corners cut: two points for each side."""
    out = []
    for (ax, ay), (bx, by_) in sides(corners):
        length = math.hypot(bx - ax, by_ - ay)
        if length > 1e-9:
            nx, ny = (by_ - ay) / length * by, (ax - bx) / length * by
            out += [(ax + nx, ay + ny), (bx + nx, by_ + ny)]
    return out


def along(ring: Points, apart: float) -> list[tuple[Point, Point, Point]]:
    """Points along a closed line, about `apart` px from each other: place, outward normal, direction."""
    loop = [*ring, ring[0]]
    whole = sum(math.dist(a, b) for a, b in pairwise(loop))
    gap = whole / max(1, round(whole / apart))
    found, left = [], gap / 2
    for (ax, ay), (bx, by) in pairwise(loop):
        length = math.hypot(bx - ax, by - ay)
        while left < length:
            tx, ty = (bx - ax) / length, (by - ay) / length
            found.append(((ax + tx * left, ay + ty * left), (ty, -tx), (tx, ty)))
            left += gap
        left -= length
    return found


def mix_points(a: Point, b: Point, share: float) -> Point:
    """The point at a share of the way from a to b."""
    return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])


def draw_blocks(
    ink: GlowCanvas, inner: Points, outer: Points, long: float, colors: tuple[Color, Color], slant: float = 0.0
) -> None:
    """Alternating blocks between two closed lines of as many points; outer ends are `slant` px ahead."""
    near, far = [*inner, inner[0]], [*outer, outer[0]]
    lengths = [0.5 * (math.dist(*a) + math.dist(*b)) for a, b in zip(pairwise(near), pairwise(far), strict=True)]
    whole = sum(lengths)
    count = 2 * max(2, round(whole / long / 2))
    starts = [whole * k / count for k in range(count)]
    for k, start in enumerate(starts):
        end = whole * (k + 1) / count
        marks = [start, *(at for at in _sums(lengths) if start < at < end), end]
        tops = [start + slant, *(at for at in _sums(lengths) if start + slant < at < end + slant), end + slant]
        ring = [_on(near, lengths, at) for at in marks] + [_on(far, lengths, at) for at in reversed(tops)]
        if colors[k % 2] != BLACK:
            ink.fill(ring, colors[k % 2])


def _sums(lengths: Sequence[float]) -> list[float]:
    """Positions of the corners, over two rounds."""
    out, at = [], 0.0
    for length in (*lengths, *lengths):
        at += length
        out.append(at)
    return out


def _on(loop: Points, lengths: Sequence[float], at: float) -> Point:
    """The point of a closed line at a position."""
    at %= sum(lengths)
    for (a, b), length in zip(pairwise(loop), lengths, strict=True):
        if at <= length:
            return mix_points(a, b, at / length if length else 0.0)
        at -= length
    return loop[0]
