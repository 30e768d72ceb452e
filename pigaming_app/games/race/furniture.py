"""Layout of `party` on any track: the common start, boost pads, and item boxes. Track files do not mention them.

They lie where the course is straightest, away from the lines and from each other; the starting grid is behind the line
with the straightest approach.
"""

from collections.abc import Sequence
from itertools import accumulate
from math import atan2, hypot, tau

from pigaming_app.games.race.course import POINTS, Course, CoursePosition, half_width_at, locate, point_at, segment_at
from pigaming_app.games.race.passages import Span
from pigaming_app.games.race.state import BOXES, PADS
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.arena import StartPose
from pigaming_app.sim.things.spec import ThingSpec, Use
from pigaming_app.sim.toml_table import FieldError
from pigaming_app.sim.world import RADIUS, ROBOTS

BEHIND = 55.0  # px between a robot's start and its line
ROW, FARTHEST_ROW = 110, 300  # px between the rows of the grid: on a straight, and the limit in bends
COLUMN = 46.0  # px from the middle of the course to either column; farther for wider robots
SPACE = 6.0  # px, least gap between robots on the grid; virtual walls of real robots need 4
WIDE_SPACE = 24.0  # px, that of robots that are wide on their surface, which drive to their places one by one
STEP_BACK = 10  # px between tried places on the grid
PAD_RUN = 300.0  # px of straight wanted after a pad
PAD_ASIDE, BOX_ASIDE = 0.4, 0.5  # of half the width
LINE_SPACE = 120.0  # px from a line to a pad or a box
PAD_SPACE = 240.0  # px from a pad to a box
ABREAST = 2  # boxes in a row
CROWDED = 10.0  # rad of bend, as much worse is a place too near to a line or to something else


def heading_at(course: Course, along: float) -> float:
    """Direction of the course at `along` px."""
    k, _ = segment_at(course, along)
    after = (k + 1) % POINTS
    return atan2(course.ys[after] - course.ys[k], course.xs[after] - course.xs[k]) % tau


def pose_at(course: Course, along: float, aside: float = 0.0) -> StartPose:
    """The pose `along` px along the course and `aside` px to the right of its line, heading along it."""
    x, y = point_at(course, along, aside)
    return StartPose(x, y, heading_at(course, along))


def clear_pose(course: Course, along: float, aside: float, spans: Sequence[Span]) -> StartPose:
    """The pose at (along, aside), moved aside to where robots can pass; `spans` are empty if there are no things."""
    if spans:
        low, high = spans[segment_at(course, along)[0]]
        aside = min(max(aside, low), high)
    return pose_at(course, along, aside)


def taped(course: Course, things: Sequence[ThingSpec]) -> list[float]:
    """Where lines of tape lie across the course, px along it."""
    found = []
    for thing in things:
        (x, y), place = thing.middle, CoursePosition()
        locate(course, x, y, place)
        along = [x * place.tangent_x + y * place.tangent_y for x, y in thing.outline]
        aside = [y * place.tangent_x - x * place.tangent_y for x, y in thing.outline]
        if thing.use is Use.LINE and place.on and max(along) - min(along) < max(aside) - min(aside):
            found.append(place.along)
    return found


def separation(course: Course, a: float, b: float) -> float:
    """Distance between two places along the course, the shorter way, px."""
    return min((a - b) % course.length, (b - a) % course.length)


def common_line(course: Course, lines: Sequence[float]) -> int:
    """Index of the line with the straightest approach: start and finish of everybody in `party`."""
    between = Bends(course).between
    bends = [between(line - BEHIND - 2 * ROW, line) for line in lines]
    return bends.index(min(bends))


def grid(course: Course, line: float, spans: Sequence[Span] = (), radius: float = RADIUS) -> tuple[StartPose, ...]:
    """Four start poses in two rows behind a line at `line` px; the rows are as far apart as a bend requires.

    Where things stand, or robots are wider than usual, each is the next place behind the line, in its column, where
    robots can pass. Raises FieldError if there is no room.
    """
    if spans or radius > RADIUS:
        return _grid_beside(course, line, spans, radius)
    poses: list[StartPose] = []
    for row in range(ROW, FARTHEST_ROW, 10):
        poses = []
        for place in range(ROBOTS):
            along = line - BEHIND - row * (place // 2)
            aside = min(COLUMN + radius - RADIUS, half_width_at(course, *segment_at(course, along)) - radius)
            poses.append(pose_at(course, along, aside if place % 2 else -aside))
        if min(hypot(a.x - b.x, a.y - b.y) for a in poses[:2] for b in poses[2:]) >= 2 * radius + SPACE:
            break
    return tuple(poses)


def _grid_beside(course: Course, line: float, spans: Sequence[Span], radius: float) -> tuple[StartPose, ...]:
    """Four start poses behind a line, each as near to it as others and things allow.

    Raises FieldError if there is no room within half a lap.
    """
    poses: list[StartPose] = []
    apart = 2 * radius + (WIDE_SPACE if radius > RADIUS else SPACE)
    for back in range(round(BEHIND), round(course.length / 2), STEP_BACK):
        half = half_width_at(course, *segment_at(course, line - back))
        for side in (-1.0, 1.0):
            pose = clear_pose(course, line - back, side * min(COLUMN + radius - RADIUS, half - radius), spans)
            free = all(hypot(pose.x - other.x, pose.y - other.y) >= apart for other in poses)
            if free and len(poses) < ROBOTS:
                poses.append(pose)
    if len(poses) < ROBOTS:
        raise FieldError("thing" if spans else "robots.radius", "no room for four robots behind the line")
    return tuple(poses)


def place_pads(course: Course, lines: Sequence[float]) -> tuple[float, ...]:
    """Boost pads, px along the course."""
    return tuple(_spots(course, lines, (), PADS, -60.0, PAD_RUN))


def pad_aside(course: Course, along: float, ideal: float) -> float:
    """Offset of a pad, px: on the side away from the fastest line, which there is `ideal` px aside."""
    return across(course, along, -PAD_ASIDE if ideal > 0.0 else PAD_ASIDE)


def place_boxes(
    course: Course, lines: Sequence[float], pads: Sequence[float], spans: Sequence[Span] = ()
) -> tuple[tuple[float, float], ...]:
    """Item boxes, each at (along, aside) px, in rows across the course, or across the passage beside things."""
    rows = _spots(course, lines, pads, BOXES // ABREAST, -80.0, 80.0)
    if spans:
        passes = [(along, *spans[segment_at(course, along)[0]]) for along in rows]
        return tuple((along, low + share * (high - low)) for along, low, high in passes for share in (0.25, 0.75))
    return tuple((along, across(course, along, side)) for along in rows for side in (-BOX_ASIDE, BOX_ASIDE))


def across(course: Course, along: float, share: float) -> float:
    """A share of half the width of the course, px."""
    return share * half_width_at(course, *segment_at(course, along))


def _spots(
    course: Course, lines: Sequence[float], pads: Sequence[float], count: int, begin: float, end: float
) -> list[float]:
    """`count` places with the least bend between `begin` and `end` px from them, well apart, and away from the rest.

    px along the course, in driving order.
    """
    between = Bends(course).between
    places = [k * course.step for k in range(POINTS)]
    bends = [between(along + begin, along + end) for along in places]
    found: list[float] = []
    for _ in range(count):
        costs = [
            cost
            + CROWDED * sum(separation(course, along, other) < LINE_SPACE for other in lines)
            + CROWDED * sum(separation(course, along, other) < PAD_SPACE for other in pads)
            + CROWDED * sum(separation(course, along, other) < course.length / (count + 2) for other in found)
            for along, cost in zip(places, bends, strict=True)
        ]
        found.append(places[costs.index(min(costs))])
    return sorted(found)


class Bends:
    """How much a course turns between any two places."""

    def __init__(self, course: Course) -> None:
        ways = [
            atan2(course.ys[(k + 1) % POINTS] - course.ys[k], course.xs[(k + 1) % POINTS] - course.xs[k])
            for k in range(POINTS)
        ]
        self.step = course.step
        self.sums = list(accumulate(abs(turn_to(ways[k % POINTS] - ways[k % POINTS - 1])) for k in range(3 * POINTS)))

    def between(self, start: float, end: float) -> float:
        """Sum of the absolute turns from `start` to `end`, rad; px along the course, at most a lap out of range."""
        return self.sums[POINTS + int(end // self.step)] - self.sums[POINTS + int(start // self.step)]
