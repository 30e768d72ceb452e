"""The fastest line around a course, and the speed it permits.

Robots do not slip: they can turn at the full rate at any speed. A piece of a line therefore takes the longer of its
length at full speed and its turn at full rate; the fastest line is short where possible, and wide where turning would
limit the speed. It is found by local search: bumps, broad ones first, displace the line on a coarse ring of points,
then on finer ones, as long as they save time.
"""

from collections.abc import Sequence
from functools import lru_cache
from math import atan2, hypot, sqrt

from pigaming_app.games.race.course import POINTS, Course
from pigaming_app.games.race.passages import Span, passages
from pigaming_app.sim.things.cover import CoverPart
from pigaming_app.sim.world import HEIGHT, RADIUS, WIDTH

MARGIN = 3.0  # px between the line and the edges
WALL = 6.0  # px between a robot on the line and the outer walls
LEVELS = (  # course points per line point; widths of bumps, in points; heights, in px; limit on rounds
    (4, (8, 4, 2, 1), (32.0, 16.0, 8.0, 4.0, 2.0, 1.0), 6),
    (2, (8, 4, 2, 1), (4.0, 2.0, 1.0, 0.5), 6),
    (1, (8, 4, 2), (2.0, 1.0, 0.5), 2),
)
MIN_GAIN = 1e-3  # s saved in a round, below which the search stops
EASE = 2  # points over which a lower pace is widened


Line = tuple[tuple[float, ...], tuple[float, ...]]


@lru_cache(maxsize=32)
def fastest_line(course: Course, speed: float, turn_rate: float, radius: float = RADIUS) -> Line:
    """For each point of the course: offset of the line in px, positive to the right, and the share of full speed."""
    return _search(course, speed, turn_rate, radius, (), ())


@lru_cache(maxsize=32)
def line_round(
    course: Course,
    speed: float,
    turn_rate: float,
    capsules: tuple[CoverPart, ...],
    lines: tuple[float, ...],
    radius: float = RADIUS,
) -> tuple[Line, tuple[Span, ...]]:
    """The fastest line that goes round things, and the passages that it takes; none if there are no things.

    `lines`: px along the course, see `passages`; `radius`: of robots, px.

    Raises FieldError if there is no way past them.
    """
    line = fastest_line(course, speed, turn_rate, radius)
    if not capsules:
        return line, ()
    spans = passages(course, capsules, line[0], lines, radius)
    return _search(course, speed, turn_rate, radius, line[0], spans), spans


def _search(
    course: Course, speed: float, turn_rate: float, radius: float, initial: Sequence[float], spans: Sequence[Span]
) -> Line:
    """The fastest line within `spans`, one for each point of the course; empty: within its edges."""
    band = list(initial[:: LEVELS[0][0]])
    for every, breadths, heights, rounds in LEVELS:
        line = ElasticBand(course, every, speed, turn_rate, radius, spans)
        line.initialise(band)
        for _ in range(rounds):
            if sum(line.push(breadth, height) for breadth in breadths for height in heights) < MIN_GAIN:
                break
        band = line.aside
    return tuple(band), _pace(line, speed, turn_rate)


class ElasticBand:
    """A line around the course, with a control point (post) at every `every`-th point of the course."""

    def __init__(
        self,
        course: Course,
        every: int,
        speed: float,
        turn_rate: float,
        radius: float = RADIUS,
        spans: Sequence[Span] = (),
    ) -> None:
        self.count = POINTS // every
        self.speed, self.turn_rate = speed, turn_rate
        self.posts = [_post(course, i * every) for i in range(self.count)]
        self.room = [_room(course.half[i * every], post, radius + WALL) for i, post in enumerate(self.posts)]
        if spans:
            near = [[spans[k % POINTS] for k in range((i - 1) * every, (i + 1) * every + 1)] for i in range(self.count)]
            self.room = [_within(room, some) for room, some in zip(self.room, near, strict=True)]
        self.aside = [0.0] * self.count
        self.xs, self.ys = [0.0] * self.count, [0.0] * self.count
        self.costs = [0.0] * self.count

    def initialise(self, band: Sequence[float]) -> None:
        """Start from the offsets of a coarser line; empty: from the centre line."""
        factor = self.count // len(band) if band else 1
        for i in range(self.count):
            self.set(i, _interpolate(band, i // factor, i % factor / factor) if band else 0.0)
        self.costs = [self.cost(i) for i in range(self.count)]

    def set(self, i: int, aside: float) -> None:
        """Set the offset at post i, clamped to the course, px."""
        low, high = self.room[i]
        aside = low if aside < low else high if aside > high else aside
        x, y, right_x, right_y = self.posts[i]
        self.aside[i] = aside
        self.xs[i], self.ys[i] = x + aside * right_x, y + aside * right_y

    def cost(self, i: int) -> float:
        """Approximate time around post i, s: a smooth maximum (8-norm) of the times to drive and to turn."""
        after = i + 1 - self.count
        x, y = self.xs[i], self.ys[i]
        ax, ay, bx, by = x - self.xs[i - 1], y - self.ys[i - 1], self.xs[after] - x, self.ys[after] - y
        drive = (sqrt(ax * ax + ay * ay) + sqrt(bx * bx + by * by)) / (2.0 * self.speed)
        turn = atan2(ax * by - ay * bx, ax * bx + ay * by) / self.turn_rate
        return float((drive**8 + turn**8) ** 0.125)

    def push(self, breadth: int, height: float) -> float:
        """Try bumps of this breadth (posts) and height (px), to either side, all around. Returns the s saved."""
        saved = 0.0
        for middle in range(0, self.count, max(1, breadth // 2)):
            posts = [(middle + k) % self.count for k in range(-breadth, breadth + 1)]
            before = sum([self.costs[i] for i in posts])
            for side in (height, -height):
                previous = [self.aside[i] for i in posts]
                for i, k in zip(posts, range(-breadth, breadth + 1), strict=True):
                    self.set(i, self.aside[i] + side * (1 - abs(k) / breadth))
                costs = [self.cost(i) for i in posts]
                if before - sum(costs) > 1e-6:
                    saved += before - sum(costs)
                    for i, cost in zip(posts, costs, strict=True):
                        self.costs[i] = cost
                    break
                for i, aside in zip(posts, previous, strict=True):
                    self.set(i, aside)
        return saved


def _post(course: Course, i: int) -> tuple[float, float, float, float]:
    """A point of the course, and the unit vector to its right."""
    after = (i + 1) % POINTS
    ex, ey = course.xs[after] - course.xs[i - 1], course.ys[after] - course.ys[i - 1]
    way = hypot(ex, ey)
    return course.xs[i], course.ys[i], -ey / way, ex / way


def _room(half: float, post: tuple[float, float, float, float], wall: float) -> tuple[float, float]:
    """Limits of the offset at a post, to the left and to the right, px. `wall`: between it and the outer walls."""
    x, y, right_x, right_y = post
    sides = []
    for side in (-1.0, 1.0):
        room = half - MARGIN
        while room > 0.0 and not (
            wall <= x + side * room * right_x <= WIDTH - wall and wall <= y + side * room * right_y <= HEIGHT - wall
        ):
            room -= 1.0
        sides.append(side * max(0.0, room))
    return sides[0], sides[1]


def _within(room: Span, spans: Sequence[Span]) -> Span:
    """The part of `room` in all spans; where there is none, as near to all as possible."""
    low, high = max(span[0] for span in spans), min(span[1] for span in spans)
    low, high = (low, high) if low <= high else (0.5 * (low + high), 0.5 * (low + high))
    inner = max(room[0], low), min(room[1], high)
    return inner if inner[0] <= inner[1] else (low, high)  # beside the course


def _interpolate(band: Sequence[float], i: int, share: float) -> float:
    """Catmull-Rom interpolation of a ring of numbers, a fraction `share` after element i."""
    a, b, c, d = (band[(i + k) % len(band)] for k in (-1, 0, 1, 2))
    cubic = 2.0 * a - 5.0 * b + 4.0 * c - d + share * (3.0 * (b - c) + d - a)
    return b + 0.5 * share * (c - a + share * cubic)


def _pace(line: ElasticBand, speed: float, turn_rate: float) -> tuple[float, ...]:
    """The share of full speed that the line's curvature permits, widened by EASE so that the motors can follow."""
    turns = []
    for i in range(line.count):
        a, b, c = ((line.xs[(i + k) % line.count], line.ys[(i + k) % line.count]) for k in (-2, 0, 2))
        ux, uy, vx, vy = b[0] - a[0], b[1] - a[1], c[0] - b[0], c[1] - b[1]
        angle = abs(atan2(ux * vy - uy * vx, ux * vx + uy * vy))
        turns.append(2.0 * angle * speed / turn_rate / (hypot(ux, uy) + hypot(vx, vy)))
    shares = [1.0 / max(1.0, turn) for turn in turns]
    return tuple(min(shares[(i + k) % line.count] for k in range(-EASE // 2, EASE // 2 + 1)) for i in range(line.count))
