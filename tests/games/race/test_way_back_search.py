"""Robot Race, back to the track: a search for drives on which FIRE gains distance. It has to find none.

Drives mix a competent driver with loops, random sticks and FIRE, and a hill climb improves them. A referee with its own
geometry, and no knowledge of the rules but the order of lines, follows every drive.
"""

from dataclasses import dataclass, replace
from math import atan2, hypot, pi, tau
from random import Random

import pytest

from pigaming_app.ai.registry import make_brain
from pigaming_app.games.arenas import arenas
from tests.cases import one_in
from tests.games.race.test_laps import judged
from tests.games.rails import IN_ORDER, place_on
from tests.matches import match_of

JUMP = 40.0  # px in a tick, more than any robot drives
BESIDE = 90.0  # px from the edge, in the mud along the course
ROUNDING = 3.0  # px, between two ways of measuring along a ring of points
LUCK = 150.0  # px that one hill climb may find and another miss: half a second
TICKS = 500
SIGN = -1
CASES = [
    (track, variant) for track in (*arenas("race"), "surprise-7", "surprise-21") for variant in ("standard", "party")
]


@dataclass(frozen=True, order=True)
class Leg:
    """A part of a drive: with the competent driver, round an end of the line crossed last, or with a stick."""

    ticks: int
    able: bool = True
    linear: float = 1.0
    angular: float = 0.0
    fire: int = 0  # ticks from one press to the next; 0: none; SIGN: once "missed a line" is shown
    around: int = 0  # 1: round the right end of that line and across it once more; -1: the left end


def random_leg(random: Random, fire: bool) -> Leg:
    kind = random.choice(("able", "round", "loop", "arc", "back"))
    press = random.choice((SIGN, SIGN, 11, 60)) if fire else 0
    if kind == "round":
        return Leg(random.randrange(150, 300), fire=press, around=random.choice((-1, 1)))
    if kind == "able":
        return Leg(random.randrange(20, 250), fire=press)
    if kind == "loop":  # a turn or two, out over the edge and back
        return Leg(random.randrange(100, 260), False, 1.0, random.choice((-1.0, 1.0)) * random.uniform(0.6, 1.0), press)
    if kind == "arc":
        return Leg(random.randrange(10, 100), False, 1.0, random.uniform(-1.0, 1.0), press)
    return Leg(random.randrange(10, 100), False, -1.0, random.uniform(-1.0, 1.0), press)


def mutated(drive: list[Leg], random: Random, fire: bool) -> list[Leg]:
    at = random.randrange(len(drive))
    leg = drive[at]
    cut = random.randrange(1, min(leg.ticks, 150)) if leg.ticks > 1 else 1
    return [*drive[:at], replace(leg, ticks=cut), random_leg(random, fire), *drive[at:]]


class Referee:
    """Follows the path of one robot by geometry of its own: the course as a ring of segments, searched by force."""

    def __init__(self, state):
        self.course, self.length = state.course, state.course.length
        self.lines = [line.along for line in state.lines]
        self.own = state.racers[0].line
        self.driven: dict[int, float] = {}  # by lines counted: furthest place past the last that it drove to, px

    def way(self, passed, along):
        """Distance from the last counted line, px; negative before it, and None between the next line and that one."""
        last, following = (self.lines[(self.own + passed + i) % 4] for i in (-1, 0))
        way = (along - last) % self.length
        return way if way <= (following - last) % self.length + ROUNDING else None

    def drove(self, passed, x, y):
        along, beyond = place_on(self.course, x, y)
        way, driven = self.way(passed, along), self.driven.get(passed, 0.0)
        if way is not None and (beyond <= 0.0 or (beyond < BESIDE and way < driven + JUMP)):
            self.driven[passed] = max(way, driven)

    def put(self, passed, x, y):
        """Assert that a robot was put no further along than it had driven."""
        along, beyond = place_on(self.course, x, y)
        assert beyond <= 0.0
        way = self.way(passed, along)
        if way is not None:
            assert way <= self.driven.get(passed, 0.0) + ROUNDING, "FIRE put it further along than it had driven"


def distance(track: str, variant: str, drive: list[Leg], seed: int) -> float:
    """The distance, px, that a drive covers by the match's own progress; the referee checks it on the way."""
    match = match_of("race", "idle", track, 10.0, IN_ORDER, variant, 9)
    state, robot, racer = match.state, match.state.robots[0], match.state.racers[0]
    referee = Referee(state)
    driver = Driver([*drive, Leg(TICKS)], make_brain("race", "hand3", seed))
    match.sit(0, driver)
    path = [(robot.x, robot.y)]
    while state.tick < TICKS:
        passed, (was_x, was_y) = racer.passed, path[-1]
        match.tick()
        if any(leg.fire for leg in drive):
            moved = hypot(robot.x - was_x, robot.y - was_y) <= JUMP
            referee.drove(racer.passed, robot.x, robot.y) if moved else referee.put(passed, robot.x, robot.y)
        path.append((robot.x, robot.y))
    assert judged(path[:-1], state.lines, racer.line, 9, state.rules.carried)[0] == racer.passed
    return float(racer.progress)


class Driver:
    """Drives the legs of a drive, one after the other."""

    def __init__(self, drive: list[Leg], able):
        self.legs = [(leg, i) for leg in drive for i in range(leg.ticks)]
        self.able, self.corner = able, 0

    def think(self, state, seat):
        leg, i = self.legs[state.tick]
        action = state.actions[seat]
        if leg.around:
            aim(state, seat, self.corners(state, state.racers[seat], leg.around, i), action)
        elif leg.able:
            self.able.think(state, seat)
        else:
            action.linear, action.angular, action.turbo = leg.linear, leg.angular, 0
        pressed = state.racers[seat].missed and i % 2 if leg.fire == SIGN else leg.fire and i % leg.fire == leg.fire - 1
        action.fire = int(bool(pressed))

    def corners(self, state, racer, side, i):
        """The next corner of a way from past the line to before it, 70 px beside its end, and across its middle."""
        line = state.lines[(racer.line + racer.passed - 1) % 4]
        mid, half = ((line.ax + line.bx) / 2, (line.ay + line.by) / 2), (line.bx - line.ax, line.by - line.ay)
        width = hypot(*half)
        out = side * (width / 2 + 70.0) / width
        on = half[1] / width, -half[0] / width  # driving direction
        corners = [(mid[0] + out * half[0] + a * on[0], mid[1] + out * half[1] + a * on[1]) for a in (60.0, -60.0)]
        corners += [(mid[0] + a * on[0], mid[1] + a * on[1]) for a in (-60.0, 90.0)]
        self.corner = 0 if i == 0 else self.corner
        x, y = corners[self.corner % 4]
        if hypot(x - state.robots[0].x, y - state.robots[0].y) < 30.0:
            self.corner += 1
        return corners[self.corner % 4]


def aim(state, seat, target, action):
    """Turn towards a point and drive there."""
    robot = state.robots[seat]
    turn = (atan2(target[1] - robot.y, target[0] - robot.x) - robot.heading + pi) % tau - pi
    action.linear, action.angular, action.turbo = float(abs(turn) < 1.0), max(-1.0, min(1.0, 2.0 * turn)), 0


def climb(track: str, variant: str, fire: bool, seed: int, tries: int) -> float:
    """The best distance that a hill climb finds, px: from the competent driver's own, and from circled lines."""
    random = Random(seed)
    drives = [[Leg(TICKS)]]
    if fire:
        drives += [[Leg(t), Leg(300, fire=SIGN, around=side)] for t in (80, 110, 140) for side in (-1, 1)]
    best, drive = max((distance(track, variant, each, seed), each) for each in drives)
    for _ in range(tries):
        attempt = mutated(drive, random, fire)
        covered = distance(track, variant, attempt, seed)
        if covered >= best:
            best, drive = covered, attempt
    return best


@pytest.mark.parametrize(("track", "variant"), one_in(12, CASES))
def test_no_drive_gains_distance_by_fire(track, variant):
    alone = climb(track, variant, fire=False, seed=1, tries=4)
    assert climb(track, variant, fire=True, seed=2, tries=10) <= alone + LUCK
