"""A closed course, a centre line with a width, and the location of robots along it. circuit.py constructs courses.

The line is a ring of equally spaced points. For each node of the grid (see grid.py) the course stores its nearest point
and, if near, the nearest point of another stretch. Locating a robot therefore takes a few steps and depends on its
position only, so that tracking cannot be lost.
"""

from math import sqrt
from typing import Annotated

from pigaming_app.sim.grid import node_at
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.world import NODES_PADDED

POINTS = 320


@record
class Course:
    """A ring of `count` points `step` px apart, closed from the last to the first."""

    count: int
    step: float
    length: float  # px, of a lap
    xs: Annotated[list[float], POINTS]
    ys: Annotated[list[float], POINTS]
    half: Annotated[list[float], POINTS]  # px from the line to either edge
    near: Annotated[list[int], NODES_PADDED, "h"]  # the nearest point to each node of the grid
    other: Annotated[list[int], NODES_PADDED, "h"]  # the nearest point of another stretch, -1 if none is near


@record
class CoursePosition:
    """A position relative to a course."""

    along: float  # px from the first point, in [0, length)
    aside: float  # px from the line, positive to the right of the driving direction
    half: float  # px from the line to the edge there
    on: int  # 1: the point is on the course
    tangent_x: float  # unit tangent of the course there
    tangent_y: float


@kernel
def locate(course: Course, x: float, y: float, place: CoursePosition) -> None:
    """Locate (x, y): on the stretch that it is on, else on the one whose edge is nearest. Fills in `place`."""
    node = node_at(x, y)
    k, share, gap = project(course, x, y, nearest_point(course, x, y, course.near[node]))
    half = half_width_at(course, k, share)
    second = course.other[node]
    if second >= 0:
        k2, share2, gap2 = project(course, x, y, nearest_point(course, x, y, second))
        half2 = half_width_at(course, k2, share2)
        if gap2 - half2 < gap - half:
            k, share, gap, half = k2, share2, gap2, half2
    after = k + 1 if k + 1 < course.count else 0
    ex, ey = course.xs[after] - course.xs[k], course.ys[after] - course.ys[k]
    way = sqrt(ex * ex + ey * ey)
    place.tangent_x, place.tangent_y = ex / way, ey / way
    right = ex * (y - course.ys[k]) - ey * (x - course.xs[k])
    place.aside = gap if right >= 0.0 else -gap
    place.along = (k + share) * course.step
    if place.along >= course.length:
        place.along = 0.0
    place.half = half
    place.on = 1 if gap <= half else 0


@kernel
def nearest_point(course: Course, x: float, y: float, k: int) -> int:
    """The point nearest to (x, y), found by descent from point k: a local minimum of the distance."""
    last = course.count - 1
    dx, dy = course.xs[k] - x, course.ys[k] - y
    nearest2 = dx * dx + dy * dy
    moved = 0
    while True:
        after = k + 1 if k < last else 0
        dx, dy = course.xs[after] - x, course.ys[after] - y
        distance2 = dx * dx + dy * dy
        if distance2 >= nearest2:
            break
        k, nearest2, moved = after, distance2, 1
    while not moved:
        before = k - 1 if k > 0 else last
        dx, dy = course.xs[before] - x, course.ys[before] - y
        distance2 = dx * dx + dy * dy
        if distance2 >= nearest2:
            break
        k, nearest2 = before, distance2
    return k


@kernel
def project(course: Course, x: float, y: float, k: int) -> tuple[int, float, float]:
    """Project (x, y) onto the two segments that meet at point k: nearest segment, fraction of it, distance in px."""
    last = course.count - 1
    before, after = k - 1 if k > 0 else last, k + 1 if k < last else 0
    share, gap = project_on_segment(course, x, y, k, after)
    share2, gap2 = project_on_segment(course, x, y, before, k)
    if gap2 < gap:
        return before, share2, sqrt(gap2)
    return k, share, sqrt(gap)


@kernel
def project_on_segment(course: Course, x: float, y: float, a: int, b: int) -> tuple[float, float]:
    """Project (x, y) onto the segment from point a to b: fraction of it in [0, 1], and squared distance, px^2."""
    ax, ay = course.xs[a], course.ys[a]
    ex, ey = course.xs[b] - ax, course.ys[b] - ay
    dx, dy = x - ax, y - ay
    share = (dx * ex + dy * ey) / (ex * ex + ey * ey)
    if share < 0.0:
        share = 0.0
    elif share > 1.0:
        share = 1.0
    dx -= share * ex
    dy -= share * ey
    return share, dx * dx + dy * dy


@kernel
def half_width_at(course: Course, k: int, share: float) -> float:
    """Half the width, px, at a fraction of the segment from point k."""
    after = k + 1 if k + 1 < course.count else 0
    half: float = course.half[k] + share * (course.half[after] - course.half[k])
    return half


@kernel
def segment_at(course: Course, along: float) -> tuple[int, float]:
    """Segment (by its first point) at `along` px, and the fraction of it; `along` is at most a lap out of range."""
    if along < 0.0:
        along += course.length
    elif along >= course.length:
        along -= course.length
    steps = along / course.step
    k = int(steps)
    if k >= course.count:
        return 0, 0.0
    return k, steps - k


@kernel
def point_at(course: Course, along: float, aside: float) -> tuple[float, float]:
    """The point `along` px along the course and `aside` px to the right of its line."""
    k, share = segment_at(course, along)
    after = k + 1 if k + 1 < course.count else 0
    ax, ay = course.xs[k], course.ys[k]
    ex, ey = course.xs[after] - ax, course.ys[after] - ay
    across = aside / sqrt(ex * ex + ey * ey)
    return ax + share * ex - across * ey, ay + share * ey + across * ex


@kernel
def distance_ahead(course: Course, start: float, end: float) -> float:
    """Forward distance between two positions along the course, px, in [0, length)."""
    way = end - start
    if way < 0.0:
        way += course.length
    return 0.0 if way >= course.length else way
