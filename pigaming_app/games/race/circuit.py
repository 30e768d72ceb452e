"""Making a closed course of corners: straights joined by arcs, so that every corner has exactly its radius.

Everything is checked here, so that a course that exists can be driven: it is closed, lies inside the arena, is wide
enough, and no stretch of it lies over another.
"""

from collections.abc import Sequence
from functools import lru_cache
from math import acos, atan2, ceil, cos, hypot, pi, sin, sqrt, tan
from typing import NamedTuple

from pigaming_app.games.race.course import POINTS, Course
from pigaming_app.sim.toml_table import FieldError, TomlTable
from pigaming_app.sim.world import CELL, COLUMNS, HEIGHT, NODES, WIDTH

WIDEST, NARROWEST = 400.0, 150.0  # px; two robots side by side are 144
EASE = 150.0  # px before and after over which a width becomes the next
REACH = CELL * 0.7072  # px from a node to whatever belongs to it
RIDGE = 2.0  # px further away, between two stretches that are near: the middle of an arc has all of it at one distance
FINE = 4.0  # px between the points of which the ring is chosen


class Corner(NamedTuple):
    """A corner of the line, rounded by an arc; px."""

    x: float
    y: float
    radius: float
    width: float


class Bend(NamedTuple):
    """The arc of a corner: where it begins and ends, its middle, its angle, clockwise positive; px, rad."""

    start: tuple[float, float]
    end: tuple[float, float]
    middle: tuple[float, float]
    radius: float
    angle: float
    cut: float  # px from the corner to where the arc begins


def read_course(table: TomlTable) -> Course:
    """The course of the tables [[corner]]; it is shared, copy it before you change it. Raises FieldError."""
    corners = tuple(_corner(entry) for entry in table.tables("corner"))
    if len(corners) < 3:
        raise table.error("corner", f"{len(corners)} corners, but at least 3 are needed to close a course")
    return course_of(corners)


@lru_cache(maxsize=32)
def course_of(corners: tuple[Corner, ...]) -> Course:
    """The course of these corners, beginning where the arc of the first does. Raises FieldError."""
    course = Course()
    xs, ys, widths, length = _line(corners, _bends(corners))
    course.count, course.step, course.length = POINTS, length / POINTS, length
    course.xs[:], course.ys[:] = xs, ys
    course.half[:] = _eased([width / 2 for width in widths], max(1, round(EASE / course.step)))
    _check_inside(course)
    _check_apart(course)
    _enter(course)
    return course


def _corner(entry: TomlTable) -> Corner:
    entry.only("at", "radius", "width")
    x, y = entry.point("at")
    return Corner(
        x, y, entry.number("radius", None, 40, 2000, " px"), entry.number("width", None, NARROWEST, WIDEST, " px")
    )


def _bends(corners: Sequence[Corner]) -> list[Bend]:
    """The arc of every corner. Raises FieldError where one does not fit."""
    bends = [_bend(i, corners[i - 1], corner, corners[(i + 1) % len(corners)]) for i, corner in enumerate(corners)]
    for i, bend in enumerate(bends):
        before = (i - 1) % len(corners)
        way = hypot(corners[i].x - corners[before].x, corners[i].y - corners[before].y)
        if bends[before].cut + bend.cut > way + 0.5:
            need = bends[before].cut + bend.cut
            reason = f"its arc and that of corner[{before + 1}] need {need:.0f} px, but they are {way:.0f} px apart"
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
    """POINTS equally spaced points of the line, x and y, the width at each, and the length of the line."""
    fine: list[tuple[float, float, float, float]] = []  # px along, x, y, width
    along = 0.0
    for i, bend in enumerate(bends):
        after, width = bends[(i + 1) % len(bends)], corners[i].width
        way = bend.radius * abs(bend.angle)
        begin = atan2(bend.start[1] - bend.middle[1], bend.start[0] - bend.middle[0])
        for share in _shares(way):
            angle = begin + share * bend.angle
            x, y = bend.middle[0] + bend.radius * cos(angle), bend.middle[1] + bend.radius * sin(angle)
            fine.append((along + share * way, x, y, width))
        along += way
        dx, dy = after.start[0] - bend.end[0], after.start[1] - bend.end[1]
        way, wider = hypot(dx, dy), corners[(i + 1) % len(corners)].width - width
        for share in _shares(way):
            fine.append(
                (along + share * way, bend.end[0] + share * dx, bend.end[1] + share * dy, width + share * wider)
            )
        along += way
    fine.append((along, *fine[0][1:]))
    return *_spaced(fine, along), along


def _shares(way: float) -> list[float]:
    """Shares of a way, from 0 to below 1, at most FINE px apart."""
    pieces = ceil(way / FINE)
    return [i / pieces for i in range(pieces)]


def _spaced(
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


def _eased(ring: Sequence[float], reach: int) -> list[float]:
    """A ring of numbers, each the mean of those up to `reach` places away."""
    return [
        sum(ring[(i + k) % len(ring)] for k in range(-reach, reach + 1)) / (2 * reach + 1) for i in range(len(ring))
    ]


def _check_inside(course: Course) -> None:
    """Both edges lie inside the arena."""
    for i in range(POINTS):
        x, y, half = course.xs[i], course.ys[i], course.half[i]
        ex, ey = course.xs[(i + 1) % POINTS] - course.xs[i - 1], course.ys[(i + 1) % POINTS] - course.ys[i - 1]
        across = half / hypot(ex, ey)
        for side in (across, -across):
            a, b = x - side * ey, y + side * ex
            if not (0 <= a <= WIDTH and 0 <= b <= HEIGHT):
                raise FieldError(
                    "corner", f"the edge at ({a:.0f}, {b:.0f}) lies outside the arena, {WIDTH:g} x {HEIGHT:g}"
                )


def _check_apart(course: Course) -> None:
    """No stretch lies over another; what is nearer along the line than a half turn belongs together."""
    for i in range(POINTS):
        x, y, half = course.xs[i], course.ys[i], course.half[i]
        for j in range(i + 1, POINTS):
            need = half + course.half[j]
            dx, dy = course.xs[j] - x, course.ys[j] - y
            if dx * dx + dy * dy < need * need and min(j - i, POINTS - j + i) * course.step > 0.5 * pi * need:
                raise FieldError("corner", f"the course lies over itself near ({x + dx / 2:.0f}, {y + dy / 2:.0f})")


def _enter(course: Course) -> None:
    """For each node of the grid, the points to look at from there. Raises FieldError where three stretches meet."""
    for node in range(NODES):
        x, y = node % COLUMNS * CELL, node // COLUMNS * CELL
        away = [sqrt((a - x) * (a - x) + (b - y) * (b - y)) for a, b in zip(course.xs, course.ys, strict=True)]
        least = [i for i in range(POINTS) if away[i] <= away[i - 1] and away[i] < away[(i + 1) % POINTS]]
        near: list[int] = []
        for i in sorted(least, key=lambda i: away[i] - course.half[i]):
            if all(_parted(away, i, j) for j in near):
                near.append(i)
        depths = [away[i] - course.half[i] for i in near]
        course.near[node] = near[0]
        course.other[node] = near[1] if len(near) > 1 and depths[1] < depths[0] + 2 * REACH else -1
        if len(near) > 2 and depths[2] < REACH:
            raise FieldError("corner", f"three stretches of the course meet near ({x:g}, {y:g})")


def _parted(away: list[float], i: int, j: int) -> bool:
    """Whether i and j are stretches of their own: one gets further away on the way from one to the other, both ways."""
    low, high = min(i, j), max(i, j)
    ridge = max(away[i], away[j]) + RIDGE
    return max(away[low:high]) > ridge and max(away[high:] + away[:low]) > ridge
