"""A plant that places robots at poses given by a test, tick by tick."""

from math import atan2, hypot, inf, tau

from pigaming_app.games.match import Match
from pigaming_app.games.race.course import point_at
from pigaming_app.sim.plant import Sighting
from tests.matches import setup_of

IN_ORDER = 3  # a seed that deals line i, in driving order, to seat i


class Rails:
    """Robots stay where they were last put; nothing else moves them."""

    mm = 1.32

    def __init__(self):
        self.poses = [(0.0, 0.0, 0.0)] * 4

    def sense(self):
        return [Sighting(*pose, 0.0) for pose in self.poses]

    def drive(self, twists, dt):
        pass

    def place(self, poses):
        self.poses = list(poses)


class Ride:
    """A race on rails, with helpers to move its robots."""

    def __init__(self, arena="classic", present=(0, 1, 2, 3), laps=3, minutes=10.0):
        seats = ["idle" if i in present else "off" for i in range(4)]
        self.rails = Rails()
        self.match = Match(setup_of("race", seats, arena, minutes, IN_ORDER, "standard", laps), self.rails)
        self.state = self.match.state
        self.course, self.lines, self.racers = self.state.course, self.state.lines, self.state.racers

    def put(self, seat, x, y, heading=None):
        """Put robot `seat` there for the next tick."""
        self.rails.poses[seat] = (x, y, self.rails.poses[seat][2] if heading is None else heading)

    def to(self, seat, x, y):
        """Drive straight to a point, 8 px a tick."""
        fx, fy, _ = self.rails.poses[seat]
        way = ((x - fx) ** 2 + (y - fy) ** 2) ** 0.5
        steps = max(1, int(way / 8.0) + 1)
        heading = atan2(y - fy, x - fx) % tau
        for k in range(1, steps + 1):
            self.put(seat, fx + (x - fx) * k / steps, fy + (y - fy) * k / steps, heading)
            self.match.tick()

    def along(self, seat, start, end, aside=0.0):
        """Follow the course from `start` to `end` (px, may exceed a lap or run backwards), `aside` px from its line."""
        steps = max(1, int(abs(end - start) / 8.0) + 1)
        for k in range(steps + 1):
            x, y = point_at(self.course, (start + (end - start) * k / steps) % self.course.length, aside)
            self.to(seat, x, y)

    def before(self, seat, line, way=60.0):
        """The position along the course at a distance before a line, px."""
        return self.lines[line].along - way

    def lap(self, seat, aside=0.0):
        """Drive a lap, from before the robot's own line to just past it."""
        own = self.lines[seat].along
        self.along(seat, own - 30.0, own + self.course.length + 30.0, aside)


def place_on(course, x, y):
    """(px along a course, px beyond its edge) of its place nearest to (x, y), by force."""
    nearest, along, beyond = inf, 0.0, 0.0
    xs, ys, half, step = course.xs, course.ys, course.half, course.step
    for k, (ax, ay) in enumerate(zip(xs, ys, strict=True)):
        if abs(ax - x) > nearest + 2.0 * step or abs(ay - y) > nearest + 2.0 * step:
            continue
        after = (k + 1) % len(xs)
        bx, by = xs[after], ys[after]
        share = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2)
        share = min(1.0, max(0.0, share))
        gap = hypot(ax + share * (bx - ax) - x, ay + share * (by - ay) - y)
        if gap < nearest:
            nearest, along, beyond = gap, (k + share) * step, gap - half[k] - share * (half[after] - half[k])
    return along, beyond
