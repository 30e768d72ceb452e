"""Drawing of a track: edges, kerbs, a dashed centre line and direction arrows; lines.py draws what lies across it.

Everything is drawn in arena px on a sheet positioned and scaled by the caller, so that a match and a preview look the
same.
"""

import math
from functools import lru_cache
from typing import NamedTuple

from pigaming_app.games.race.course import Course, point_at, segment_at
from pigaming_app.games.race.start import TrackPlan
from pigaming_app.ui.draw import ALARM, ICE, Color, GlowCanvas, Point
from pigaming_app.ui.draw.frame_budget import Steps

EDGE: Color = (150, 178, 214)
MARKS: Color = (34, 45, 64)
ARROWS: Color = (70, 88, 116)
TIGHT = 340.0  # px: a bend of a smaller radius has a kerb
KERB = 26.0  # px between kerb blocks


class Rib(NamedTuple):
    """Point of the centre line: x, y (px), direction (rad), half the width (px), curvature."""

    x: float
    y: float
    heading: float
    half: float
    distort: float  # 1/px, positive to the right


@lru_cache(maxsize=8)
def ribs(course: Course) -> tuple[Rib, ...]:
    """The closed centre line of a course."""
    n = course.count
    headings = [
        math.atan2(course.ys[(i + 1) % n] - course.ys[i - 1], course.xs[(i + 1) % n] - course.xs[i - 1])
        for i in range(n)
    ]
    out = []
    for i in range(n):
        turn = (headings[(i + 1) % n] - headings[i - 1] + math.pi) % math.tau - math.pi
        out.append(Rib(course.xs[i], course.ys[i], headings[i], course.half[i], turn / (2 * course.step)))
    return tuple(out)


def edge_point(rib: Rib, side: float, out: float = 0.0) -> Point:
    """Point `out` px outside the edge; `side` 1: right, -1: left of the driving direction."""
    far = side * (rib.half + out)
    return rib.x - far * math.sin(rib.heading), rib.y + far * math.cos(rib.heading)


def edges(course: Course) -> tuple[list[Point], list[Point]]:
    """Left and right edge."""
    return [edge_point(rib, -1) for rib in ribs(course)], [edge_point(rib, 1) for rib in ribs(course)]


def draw_track(glow: GlowCanvas, crisp: GlowCanvas, track: TrackPlan) -> Steps[None]:
    """Draw a track without its lines: glowing and crisp parts on one sheet each. The road itself is black."""
    course = track.course
    crisp.dashes([(rib.x, rib.y) for rib in ribs(course)], MARKS, 4, 34, 40)
    yield
    for edge in edges(course):
        glow.neon(edge, EDGE, 5, True)
        yield
    draw_kerbs(glow, course)
    yield
    draw_arrows(crisp, track)
    yield


def draw_kerbs(ink: GlowCanvas, course: Course) -> None:
    """Red and white blocks on the inside of every tight bend."""
    ring = ribs(course)
    for side in (1, -1):
        run = 0.0
        for a, b in zip(ring, ring[1:] + ring[:1], strict=True):
            if a.distort * side < 1.0 / TIGHT or b.distort * side < 1.0 / TIGHT:
                run = 0.0
                continue
            near, far = [edge_point(rib, side, -4) for rib in (a, b)], [edge_point(rib, side, 10) for rib in (b, a)]
            whole = math.dist(edge_point(a, side, 3), edge_point(b, side, 3))
            done = 0.0
            while done < whole - 1e-6:
                block = int((run + 1e-6) // KERB)
                to = min(whole, done + (block + 1) * KERB - run)
                ink.fill(_part(near, far, done / whole, to / whole), ICE if block % 2 else ALARM)
                run, done = run + to - done, to


def _part(near: list[Point], far: list[Point], start: float, end: float) -> list[Point]:
    """Part of a block between two shares of its length; `far` runs opposite to `near`."""
    (a, b), (d, c) = near, far

    def between(p: Point, q: Point, share: float) -> Point:
        return p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])

    return [between(a, b, start), between(a, b, end), between(c, d, end), between(c, d, start)]


def draw_arrows(ink: GlowCanvas, track: TrackPlan) -> None:
    """Two pairs of arrowheads between consecutive lines, in driving direction."""
    course = track.course
    for i, along in enumerate(track.lines):
        gap = (track.lines[(i + 1) % len(track.lines)] - along) % course.length
        for share in (0.36, 0.72):
            for back in (0.0, 26.0):
                position = along + share * gap - back
                k, _ = segment_at(course, position % course.length)
                x, y = point_at(course, position % course.length, 0.0)
                c, s = math.cos(ribs(course)[k].heading), math.sin(ribs(course)[k].heading)
                head = [(-12.0, -17.0), (0.0, 0.0), (-12.0, 17.0)]
                ink.line([(x + a * c - b * s, y + a * s + b * c) for a, b in head], ARROWS, 6)
