"""Lap counting for arbitrary paths, compared with an oracle that has nothing but the paths.

The oracle works differently from the rules: it intersects the complete path of a robot with each of the four lines, by
the orientation of triangles, and greedily matches the crossings with the lines in order.
"""

from itertools import pairwise
from math import atan2, cos, hypot, pi, sin
from random import Random

import pytest

from pigaming_app.ai.registry import make_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.race.course import point_at
from tests.cases import one_in
from tests.games.rails import Ride
from tests.matches import match_of

TRACKS = arenas("race")


# ---------------------------------------------------------------------------------------------------------- the oracle


def area(a, b, c):
    """Twice the signed area of a triangle, positive if clockwise on the screen."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def cuts(path, left, right, carried):
    """(when, direction) of each crossing of the line from left to right: when in steps, direction 1 is forwards.

    Before the line is where (left, right, point) runs clockwise; the line itself belongs to what is behind it.
    """
    found = []
    for step, (a, b) in enumerate(pairwise(path)):
        if hypot(b[0] - a[0], b[1] - a[1]) > carried:
            continue
        was, now = area(left, right, a) > 0.0, area(left, right, b) > 0.0
        if was == now:
            continue
        to_left, to_right = area(a, b, left), area(a, b, right)
        if (to_left > 0.0) == (to_right > 0.0):
            continue
        share = area(left, right, a) / (area(left, right, a) - area(left, right, b))
        found.append((step + share, 1 if was else -1))
    return found


def judged(path, lines, own, laps, carried):
    """Result of a path: lines crossed in order, lap times in ticks, laps that did not count, the missed line."""
    ends = [((line.ax, line.ay), (line.bx, line.by)) for line in lines]
    events = sorted((when, line, way) for line, (a, b) in enumerate(ends) for when, way in cuts(path, a, b, carried))
    wanted = [(own + i) % 4 for i in range(4 * laps + 1)]  # in order, all the way to the finish
    passed, own_at, void, missed = 0, [], 0, 0
    undone: list[int] = []  # lines gone back over since the last that counted, most recent last
    for when, line, way in events:
        if passed == len(wanted):
            break
        if way > 0 and line == wanted[passed]:
            if line == own:
                own_at.append(when)
            passed, missed, undone = passed + 1, 0, []
        elif way < 0:
            if line == (wanted[passed] - 1 - len(undone)) % 4:
                undone.append(line)
        elif undone and line == undone[-1]:
            undone.pop()
        elif passed:
            missed, undone = 1 + wanted[passed], []
            void += line == own
    return passed, [b - a for a, b in pairwise(own_at)], void, missed


def agree(match, paths):
    """Assert that the rules and the oracle agree on every robot."""
    state = match.state
    for seat, path in enumerate(paths):
        racer = state.racers[seat]
        passed, laps, void, missed = judged(path, state.lines, racer.line, state.rules.laps, state.rules.carried)
        assert (racer.passed, racer.void, racer.missed) == (passed, void, missed), f"robot {seat}"
        assert state.robots[seat].score == len(laps)
        assert list(match.game.times(state, seat)) == pytest.approx([lap / 50 for lap in laps])
        assert racer.finished == (passed == 4 * state.rules.laps + 1)


# -------------------------------------------------------------------------------------------------- robots that drive


class Wild:
    """A driver that alternates between random manoeuvres and a competent AI."""

    def __init__(self, seat, seed):
        self.random, self.able = Random(seed * 7 + seat), make_brain("race", "hand3", seed)
        self.left, self.mood = 0, "race"
        self.x = self.y = 0.0

    def think(self, state, seat):
        action, robot, random = state.actions[seat], state.robots[seat], self.random
        if self.left == 0:
            self.left = random.randrange(20, 250)
            self.mood = random.choice(("race", "race", "race", "cut", "back", "dance", "park", "spin", "ram"))
            self.x, self.y = random.uniform(40, 1560), random.uniform(40, 860)
            line = state.lines[random.randrange(4)]
            if self.mood in ("dance", "park"):
                share = random.uniform(-0.1, 1.1)  # at the ends of lines as well
                self.x, self.y = line.ax + share * (line.bx - line.ax), line.ay + share * (line.by - line.ay)
        self.left -= 1
        if self.mood == "race":
            self.able.think(state, seat)
            return
        if self.mood == "ram":
            other = state.robots[(seat + 1) % 4]
            self.x, self.y = other.x, other.y
        away, bearing = hypot(self.x - robot.x, self.y - robot.y), atan2(self.y - robot.y, self.x - robot.x)
        turn = (bearing - robot.heading + pi) % (2 * pi) - pi
        if self.mood == "back":  # backwards
            turn = (turn + 2 * pi) % (2 * pi) - pi
        action.angular = max(-1.0, min(1.0, 2.0 * turn))
        action.linear = (1.0 if abs(turn) < 1.0 else 0.0) * (-1.0 if self.mood == "back" else 1.0)
        action.fire, action.turbo = int(random.random() < 0.01), int(random.random() < 0.5)  # FIRE: the way back
        if self.mood == "spin":
            action.linear, action.angular = random.choice((-1.0, 0.0, 1.0)), random.choice((-1.0, 1.0))
        if away < 30.0 and self.mood == "park":
            action.linear = 0.0
        if away < 30.0 and self.mood == "dance":
            action.linear = random.choice((-1.0, 1.0))


@pytest.mark.parametrize("track", one_in(2, TRACKS))
@pytest.mark.parametrize("seed", one_in(2, [1, 2]))
def test_wild_robots_that_push_each_other(track, seed):
    match = match_of("race", ["idle"] * 4, track, 3.0, seed, "standard", 2)
    for seat in range(4):
        match.sit(seat, Wild(seat, seed))
    paths = [list[tuple[float, float]]() for _ in range(4)]
    while not match.over and match.state.tick < 4000:
        for robot, path in zip(match.state.robots, paths, strict=True):
            path.append((robot.x, robot.y))
        match.tick()
    agree(match, paths)


# ------------------------------------------------------------------------------------------------ robots that are moved


@pytest.mark.parametrize("track", one_in(2, TRACKS))
@pytest.mark.parametrize("seed", one_in(4, range(4)))
def test_any_path_at_all(track, seed):
    """Random walks: over lines, also sideways, along the course and back, through the infield, and carried about."""
    ride = Ride(track, laps=9)
    random = Random(seed)
    paths = [[pose[:2]] for pose in ride.rails.poses]
    walkers = [walk(random, ride, seat) for seat in range(4)]
    for _ in range(4000):
        for seat, walker in enumerate(walkers):
            x, y = next(walker)
            ride.put(seat, x, y)
            paths[seat].append((x, y))
        ride.match.tick()
    ride.match.tick()
    agree(ride.match, paths)
    assert any(racer.passed > 5 for racer in ride.racers), "some of them got round"


def walk(random, ride, seat):
    """Endless generator of the points of a walk, from the robot's position."""
    x, y, _ = ride.rails.poses[seat]
    yield x, y
    along, course = ride.lines[seat].along, ride.course
    while True:
        mood = random.choice(("on", "on", "on", "off", "back", "line", "cut", "carried"))
        if mood in ("on", "off", "back"):
            goal = along + random.uniform(100, 0.7 * course.length) * (-1 if mood == "back" else 1)
            aside = random.uniform(-1, 1) * (60 if mood != "off" else 200)
            while (goal - along) * (1 if mood != "back" else -1) > 0:
                along += (8.0 if mood != "back" else -8.0) * random.uniform(0.5, 1.5)
                k = int(along / course.step) % course.count
                tx, ty = (
                    course.xs[(k + 1) % course.count] - course.xs[k],
                    course.ys[(k + 1) % course.count] - course.ys[k],
                )
                to = course.xs[k] - aside * ty / course.step, course.ys[k] + aside * tx / course.step
                x, y = nearer((x, y), to, 12.0)
                yield x, y
        elif mood == "line":
            line = ride.lines[random.randrange(4)]
            share = random.uniform(-0.2, 1.2)
            mid = line.ax + share * (line.bx - line.ax), line.ay + share * (line.by - line.ay)
            if hypot(mid[0] - x, mid[1] - y) > 500:
                continue
            for _ in range(100):
                angle = random.uniform(0, 2 * pi)
                x, y = nearer((x, y), (mid[0] + 20 * cos(angle), mid[1] + 20 * sin(angle)), 12.0)
                yield x, y
            along = line.along
        elif mood == "cut":
            to = random.uniform(40, 1560), random.uniform(40, 860)
            for _ in range(40):
                x, y = nearer((x, y), to, 12.0)
                yield x, y
        elif random.random() < 0.2:
            x, y = random.uniform(40, 1560), random.uniform(40, 860)
            yield x, y


def nearer(at, to, limit):
    """The point up to `limit` px from one point towards another."""
    way = hypot(to[0] - at[0], to[1] - at[1])
    share = min(1.0, limit / way) if way else 0.0
    return at[0] + share * (to[0] - at[0]), at[1] + share * (to[1] - at[1])


# ---------------------------------------------------------------------------------------------------- specified cases


LINE_OF_TRACK = [(track, seat) for track in TRACKS for seat in range(4)]


def carry(ride, seat, along):
    """Carry a robot to another position on the course."""
    ride.put(seat, *point_at(ride.course, along % ride.course.length, 0.0))
    ride.match.tick()


@pytest.mark.parametrize(("track", "seat"), LINE_OF_TRACK)
@pytest.mark.parametrize("skipped", [(1,), (2,), (3,), (1, 2), (2, 3), (1, 3), (1, 2, 3), ()])
def test_the_first_line_left_out_is_the_one_to_go_back_to(track, seat, skipped):
    """Carried over some lines of a lap: a lap with all lines counts, any other does not and reports the line."""
    ride = Ride(track, present=(seat,))
    racer, own = ride.racers[seat], ride.lines[seat].along
    for step in range(4):
        along = ride.lines[(seat + step) % 4].along
        if step not in skipped:
            carry(ride, seat, along - 30.0)
            ride.along(seat, along - 30.0, along + 30.0)
    assert bool(racer.missed) == any(step - 1 in skipped for step in (2, 3) if step not in skipped)
    carry(ride, seat, own - 30.0)
    ride.along(seat, own - 30.0, own + 30.0)
    assert ride.state.robots[seat].score == (0 if skipped else 1)
    assert racer.missed == (1 + (seat + skipped[0]) % 4 if skipped else 0)
    assert racer.void == (1 if skipped else 0)
