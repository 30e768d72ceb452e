"""Where robots can pass the things on a course: at each of its points an interval of offsets from the centre line.

Of the gaps beside the things, the ones are taken that lie nearest to the fastest line and are wide, and that connect
all round. Where things leave no room on the course, robots pass through the mud beside it, but not at a line.
"""

from collections.abc import Sequence
from math import hypot

from pigaming_app.games.race.course import POINTS, Course, CoursePosition, locate, segment_at
from pigaming_app.games.race.state import Race
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.things.cover import CoverPart, from_capsule
from pigaming_app.sim.toml_table import FieldError
from pigaming_app.sim.world import HEIGHT, RADIUS, WIDTH

SPARE = 6.0  # px between a robot that passes and a thing; virtual walls of real robots need 4
STEP = 3.0  # px between tried offsets
NARROW = 60.0  # px, a gap of this width costs as much as a detour of NARROW px
BESIDE = 90.0  # px from the edge of the course, within which robots in the mud drive along it, past a thing if need be
LINE = 70.0  # px from a line within which they may not
MUD = 1000.0  # px, cost of that
LAPS = 2  # round the course, until the choice at its beginning no longer depends on that beginning

Span = tuple[float, float]  # offsets, px, positive to the right


@kernel
def clear_aside(match: Race, along: float) -> float:
    """The offset nearest to the middle of the course at which no thing stands, px; `along` px along it."""
    if not match.narrow:
        return 0.0
    k, _ = segment_at(match.course, along)
    low: float = match.low[k]
    high: float = match.high[k]
    return low if low > 0.0 else high if high < 0.0 else 0.0


@kernel
def in_passage(match: Race, place: CoursePosition) -> bool:
    """True if a position beside the course is where robots pass a thing."""
    if not match.narrow:
        return False
    k, _ = segment_at(match.course, place.along)
    low: float = match.low[k] - match.radius
    high: float = match.high[k] + match.radius
    return bool(low <= place.aside <= high)


def passages(
    course: Course,
    capsules: Sequence[CoverPart],
    ideal: Sequence[float],
    lines: Sequence[float],
    radius: float = RADIUS,
) -> tuple[Span, ...]:
    """The interval of offsets at each point of the course in which robots can pass.

    `ideal`: offsets of the fastest line; `lines`: px along the course, where robots must stay on it; `radius`: theirs,
    px.

    Raises FieldError if they cannot pass somewhere.
    """
    gaps = [_gaps(course, k, capsules, _beside(course, k, lines), radius + SPARE) for k in range(POINTS)]
    for k, some in enumerate(gaps):
        if not some:
            raise _blocked(course, k)
    costs: list[dict[int, float]] = [dict.fromkeys(range(len(gaps[0])), 0.0)]
    came: list[dict[int, int]] = [{}]
    for step in range(1, LAPS * POINTS + 1):
        k = step % POINTS
        before, cost, origin = costs[-1], {}, {}
        for i, gap in enumerate(gaps[k]):
            linked = [j for j in before if _overlap(gaps[k - 1][j], gap)]
            if linked:
                origin[i] = min(linked, key=lambda j: before[j])
                cost[i] = before[origin[i]] + _cost(gap, ideal[k], course.half[k])
        if not cost:
            raise _blocked(course, k)
        costs.append(cost)
        came.append(origin)
    chosen = min(costs[-1], key=lambda i: costs[-1][i])
    way = [0] * POINTS
    for step in range(LAPS * POINTS, (LAPS - 1) * POINTS, -1):
        way[step % POINTS] = chosen
        chosen = came[step][chosen]
    return tuple(_on_course(gaps[k][way[k]], course.half[k]) for k in range(POINTS))


def _beside(course: Course, k: int, lines: Sequence[float]) -> float:
    """How far beside the course robots may pass at a point, px."""
    at = k * course.step
    gap = min((min((at - line) % course.length, (line - at) % course.length) for line in lines), default=course.length)
    return BESIDE if gap > LINE else 0.0


def _on_course(gap: Span, half: float) -> Span:
    """The part of a gap that lies on the course; the whole gap if there is none."""
    low, high = max(gap[0], -half), min(gap[1], half)
    return (low, high) if low <= high else gap


def _gaps(course: Course, k: int, capsules: Sequence[CoverPart], beside: float, room: float) -> list[Span]:
    """The intervals of offsets at a point, up to `beside` px beside the course, at least `room` px from everything."""
    x, y, half = course.xs[k], course.ys[k], course.half[k]
    reach, place = half + beside, CoursePosition()
    near = [one for one in capsules if from_capsule(one, x, y) < reach + room]
    if not near:
        return [(-half, half)]
    after = (k + 1) % POINTS
    ex, ey = course.xs[after] - course.xs[k - 1], course.ys[after] - course.ys[k - 1]
    right_x, right_y = -ey / hypot(ex, ey), ex / hypot(ex, ey)
    count = int(2.0 * reach / STEP)
    found: list[Span] = []
    begin: float | None = None
    for i in range(count + 1):
        aside = -reach + i * STEP
        px, py = x + aside * right_x, y + aside * right_y
        free = room <= px <= WIDTH - room and room <= py <= HEIGHT - room
        if free and abs(aside) > half:  # not on another stretch of the course
            locate(course, px, py, place)
            free = not place.on
        free = free and all(from_capsule(one, px, py) >= room for one in near)
        if free and begin is None:
            begin = aside
        elif not free and begin is not None:
            found.append((begin, aside - STEP))
            begin = None
    if begin is not None:
        found.append((begin, -reach + count * STEP))
    return found


def _overlap(one: Span, other: Span) -> bool:
    return one[0] <= other[1] + STEP and other[0] <= one[1] + STEP


def _cost(gap: Span, ideal: float, half: float) -> float:
    detour = max(0.0, gap[0] - ideal, ideal - gap[1])
    mud = max(0.0, gap[0] - half, -half - gap[1])
    return detour + (MUD + mud if mud > 0.0 else 0.0) + NARROW * NARROW / max(gap[1] - gap[0], STEP)


def _blocked(course: Course, k: int) -> FieldError:
    return FieldError("thing", f"no robot can pass the things at ({course.xs[k]:.0f}, {course.ys[k]:.0f})")
