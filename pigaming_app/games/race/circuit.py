"""Construction of a closed course from corners: straights joined by arcs of exactly the given radii.

Validation guarantees that a course is drivable: closed, inside the arena, wide enough, without overlaps.
"""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import chain
from math import acos, atan2, ceil, cos, hypot, pi, sin, tan
from typing import NamedTuple

from pigaming_app.games.race.course import POINTS, Course
from pigaming_app.sim.arena import raise_first
from pigaming_app.sim.toml_table import FieldError, TomlTable
from pigaming_app.sim.world import CELL, COLUMNS, HEIGHT, NODES, WIDTH

WIDEST, NARROWEST = 400.0, 150.0  # px; two robots side by side are 144
EASE = 150.0  # px either way over which the width is smoothed
REACH = CELL * 0.7072  # px, largest distance from a node to a point that is nearest to it: half a cell's diagonal
RIDGE = 2.0  # px of extra distance that separates two stretches; the centre of an arc is equally far from all of it
FINE = 4.0  # px between the points from which the ring is resampled


class Corner(NamedTuple):
    """A corner of the centre line, rounded by an arc; px."""

    x: float
    y: float
    radius: float
    width: float


class Bend(NamedTuple):
    """The arc of a corner: start, end, centre, radius (px) and angle (rad, clockwise positive)."""

    start: tuple[float, float]
    end: tuple[float, float]
    middle: tuple[float, float]
    radius: float
    angle: float
    cut: float  # px from the corner to the start of the arc


def read_course(table: TomlTable) -> Course:
    """The course of the tables [[corner]]. It is cached: copy it before changing it. Raises FieldError."""
    return course_of(read_corners(table))


def read_corners(table: TomlTable) -> tuple[Corner, ...]:
    """Parse the tables [[corner]]. Raises FieldError."""
    corners = tuple(_corner(entry) for entry in table.tables("corner"))
    if len(corners) < 3:
        raise table.error("corner", f"{len(corners)} corners, but at least 3 are needed to close a course")
    return corners


@lru_cache(maxsize=32)
def course_of(corners: tuple[Corner, ...]) -> Course:
    """The course of these corners, beginning at the start of the first arc. Raises FieldError."""
    course = traced(corners)
    raise_first(course_faults(course))
    return course


def traced(corners: Sequence[Corner]) -> Course:
    """The line and width of a course, which may leave the arena or lie over itself. Raises FieldError."""
    course = Course()
    xs, ys, widths, length = _line(corners, _bends(corners))
    course.count, course.step, course.length = POINTS, length / POINTS, length
    course.xs[:], course.ys[:] = xs, ys
    course.half[:] = _smoothed([width / 2 for width in widths], max(1, round(EASE / course.step)))
    return course


def course_faults(course: Course) -> Iterator[FieldError]:
    """Places where a course leaves the arena or meets itself; if there are none, its nodes are indexed after that."""
    found = 0
    for fault in chain(_outside(course), _overlaps(course)):
        found += 1
        yield fault
    if not found:
        yield from _index_nodes(course)


def width_faults(course: Course, radius: float) -> Iterator[FieldError]:
    """The first place where a course is too narrow, or too near to the rim, for robots of this radius, px."""
    for x, y, half in zip(course.xs, course.ys, course.half, strict=True):
        if min(half, x, y, WIDTH - x, HEIGHT - y) < radius:
            reason = f"no robot of {2 * radius:.0f} px fits on the course at ({x:.0f}, {y:.0f})"
            yield FieldError("robots.radius", reason, (x, y, half))
            return


def _corner(entry: TomlTable) -> Corner:
    entry.only("at", "radius", "width")
    x, y = entry.point("at")
    return Corner(
        x, y, entry.number("radius", None, 40, 2000, " px"), entry.number("width", None, NARROWEST, WIDEST, " px")
    )


def _bends(corners: Sequence[Corner]) -> list[Bend]:
    """The arc of every corner. Raises FieldError if one does not fit."""
    bends = [_bend(i, corners[i - 1], corner, corners[(i + 1) % len(corners)]) for i, corner in enumerate(corners)]
    for i, bend in enumerate(bends):
        before = (i - 1) % len(corners)
        distance = hypot(corners[i].x - corners[before].x, corners[i].y - corners[before].y)
        if bends[before].cut + bend.cut > distance + 0.5:
            need = bends[before].cut + bend.cut
            reason = (
                f"its arc and that of corner[{before + 1}] need {need:.0f} px, but they are {distance:.0f} px apart"
            )
            raise FieldError(f"corner[{i + 1}].radius", reason)
    return bends


def _bend(i: int, before: Corner, corner: Corner, after: Corner) -> Bend:
    key = f"corner[{i + 1}]"
    come, go = hypot(before.x - corner.x, before.y - corner.y), hypot(after.x - corner.x, after.y - corner.y)
    if min(come, go) < 1.0:
        raise FieldError(f"{key}.at", "is the same point as its neighbour")
    if corner.radius < corner.width / 2:
        raise FieldError(
            f"{key}.radius", f"{corner.radius:g} px, but at least half the width, {corner.width / 2:g}, is needed"
        )
    ux, uy = (before.x - corner.x) / come, (before.y - corner.y) / come
    vx, vy = (after.x - corner.x) / go, (after.y - corner.y) / go
    half = acos(max(-1.0, min(1.0, ux * vx + uy * vy))) / 2  # of the angle between the two straights
    if half < 0.1:
        raise FieldError(f"{key}.at", "the course turns back on itself here")
    cut = corner.radius / tan(half)
    start, end = (corner.x + ux * cut, corner.y + uy * cut), (corner.x + vx * cut, corner.y + vy * cut)
    clockwise = 1 if uy * vx - ux * vy > 0 else -1
    middle = start[0] + clockwise * corner.radius * uy, start[1] - clockwise * corner.radius * ux
    return Bend(start, end, middle, corner.radius, clockwise * (pi - 2 * half), cut)


def _line(corners: Sequence[Corner], bends: Sequence[Bend]) -> tuple[list[float], list[float], list[float], float]:
    """POINTS equally spaced points of the centre line: x, y, width at each (px), and the length of the line (px)."""
    fine: list[tuple[float, float, float, float]] = []  # px along, x, y, width
    along = 0.0
    for i, bend in enumerate(bends):
        after, width = bends[(i + 1) % len(bends)], corners[i].width
        way = bend.radius * abs(bend.angle)
        begin = atan2(bend.start[1] - bend.middle[1], bend.start[0] - bend.middle[0])
        for share in _subdivisions(way):
            angle = begin + share * bend.angle
            x, y = bend.middle[0] + bend.radius * cos(angle), bend.middle[1] + bend.radius * sin(angle)
            fine.append((along + share * way, x, y, width))
        along += way
        dx, dy = after.start[0] - bend.end[0], after.start[1] - bend.end[1]
        way, widening = hypot(dx, dy), corners[(i + 1) % len(corners)].width - width
        for share in _subdivisions(way):
            fine.append(
                (along + share * way, bend.end[0] + share * dx, bend.end[1] + share * dy, width + share * widening)
            )
        along += way
    fine.append((along, *fine[0][1:]))
    return *_resampled(fine, along), along


def _subdivisions(way: float) -> list[float]:
    """Fractions from 0 to below 1 that divide `way` px into steps of at most FINE px."""
    pieces = ceil(way / FINE)
    return [i / pieces for i in range(pieces)]


def _resampled(
    fine: Sequence[tuple[float, float, float, float]], length: float
) -> tuple[list[float], list[float], list[float]]:
    xs, ys, widths = [], [], []
    k = 0
    for i in range(POINTS):
        along = i * length / POINTS
        while fine[k + 1][0] <= along:
            k += 1
        (a, ax, ay, aw), (b, bx, by, bw) = fine[k], fine[k + 1]
        share = (along - a) / (b - a)
        xs.append(ax + share * (bx - ax))
        ys.append(ay + share * (by - ay))
        widths.append(aw + share * (bw - aw))
    return xs, ys, widths


def _smoothed(ring: Sequence[float], reach: int) -> list[float]:
    """Moving average of a ring of numbers, over `reach` elements either way."""
    return [
        sum(ring[(i + k) % len(ring)] for k in range(-reach, reach + 1)) / (2 * reach + 1) for i in range(len(ring))
    ]


@lru_cache(maxsize=8)
def examined(corners: tuple[Corner, ...]) -> tuple[Course, tuple[FieldError, ...]]:
    """A course that may be undrivable, and its faults; cached, do not change it. Raises FieldError."""
    course = traced(corners)
    return course, tuple(course_faults(course))


def _outside(course: Course) -> Iterator[FieldError]:
    """Stretches whose edges lie outside the arena."""
    before = -2
    for i in range(POINTS):
        x, y, half = course.xs[i], course.ys[i], course.half[i]
        ex, ey = course.xs[(i + 1) % POINTS] - course.xs[i - 1], course.ys[(i + 1) % POINTS] - course.ys[i - 1]
        across = half / hypot(ex, ey)
        for side in (across, -across):
            a, b = x - side * ey, y + side * ex
            if not (0 <= a <= WIDTH and 0 <= b <= HEIGHT):
                if i > before + 1:
                    reason = f"the edge at ({a:.0f}, {b:.0f}) lies outside the arena, {WIDTH:g} x {HEIGHT:g}"
                    yield FieldError("corner", reason, (min(max(a, 0.0), WIDTH), min(max(b, 0.0), HEIGHT), half))
                before = i


def _overlaps(course: Course) -> Iterator[FieldError]:
    """Places where stretches overlap; points closer along the line than a half turn are the same stretch."""
    import numpy as np  # an arcade starts faster without

    found: list[tuple[float, float]] = []
    xs, ys, half = np.array(course.xs), np.array(course.ys), np.array(course.half)
    dx, dy, need = xs[None, :] - xs[:, None], ys[None, :] - ys[:, None], half[:, None] + half[None, :]
    apart = np.arange(POINTS)[None, :] - np.arange(POINTS)[:, None]
    way = np.minimum(apart, POINTS - apart) * course.step
    over = (apart > 0) & (dx * dx + dy * dy < need * need) & (way > 0.5 * pi * need)
    for i, j in np.argwhere(over).tolist():
        x, y = course.xs[i] + (course.xs[j] - course.xs[i]) / 2, course.ys[i] + (course.ys[j] - course.ys[i]) / 2
        if all(hypot(x - a, y - b) > WIDEST for a, b in found):
            found.append((x, y))
            extent = (course.half[i] + course.half[j]) / 2
            yield FieldError("corner", f"the course lies over itself near ({x:.0f}, {y:.0f})", (x, y, extent))


def _index_nodes(course: Course) -> Iterator[FieldError]:
    """Set `near` and `other` of a course for each node of the grid, up to one at which three stretches meet."""
    import numpy as np  # an arcade starts faster without

    nodes = np.arange(NODES)
    dx = np.array(course.xs)[None, :] - (nodes % COLUMNS * CELL)[:, None]
    dy = np.array(course.ys)[None, :] - (nodes // COLUMNS * CELL)[:, None]
    distances = np.sqrt(dx * dx + dy * dy)
    lowest = (distances <= np.roll(distances, 1, axis=1)) & (distances < np.roll(distances, -1, axis=1))
    for node in range(NODES):
        minima = np.flatnonzero(lowest[node]).tolist()
        gaps = dict(zip(minima, distances[node, minima].tolist(), strict=True))
        near: list[int] = []
        if len(minima) > 1:
            ridges = np.maximum.reduceat(distances[node], minima).tolist()
            ridges[-1] = max([ridges[-1], *distances[node, : minima[0]].tolist()])
        for i in sorted(minima, key=lambda i: gaps[i] - course.half[i]):
            if all(_separate(minima, gaps, ridges, i, j) for j in near):
                near.append(i)
        depths = [gaps[i] - course.half[i] for i in near]
        course.near[node] = near[0]
        course.other[node] = near[1] if len(near) > 1 and depths[1] < depths[0] + 2 * REACH else -1
        if len(near) > 2 and depths[2] < REACH:
            x, y = node % COLUMNS * CELL, node // COLUMNS * CELL
            yield FieldError("corner", f"three stretches of the course meet near ({x:g}, {y:g})", (x, y, REACH))
            return


def _separate(minima: list[int], gaps: dict[int, float], ridges: list[float], i: int, j: int) -> bool:
    """True if i and j are on separate stretches: between them, both ways round, the distance rises above both.

    `ridges`: the largest distance from each of the minima to the next.
    """
    low, high = sorted((minima.index(i), minima.index(j)))
    ridge = max(gaps[i], gaps[j]) + RIDGE
    return max(ridges[low:high]) > ridge and max(ridges[high:] + ridges[:low]) > ridge
