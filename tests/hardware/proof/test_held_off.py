"""Players who drive real robots into real things, at full stick: virtual walls hold the robots off.

The match is played on the layout that a scan has found, and compared with the true things.
"""

from collections.abc import Sequence
from math import atan2, cos, hypot, inf, pi, sin
from random import Random
from typing import Any

import pytest

from pigaming_app.games.arenas import parse
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.emulator.arena import STARTS
from pigaming_app.hardware.emulator.robots import RADIUS
from pigaming_app.hardware.emulator.things.prism import Prism, distance, obstacles
from pigaming_app.hardware.emulator.things.random_scene import some_things
from pigaming_app.hardware.proof import testbed
from pigaming_app.hardware.proof.trials import play
from pigaming_app.sim.action import set_action
from pigaming_app.sim.things.spec import ThingSpec, Use, written
from pigaming_app.sim.world import HZ, ROBOTS
from tests.cases import repeated
from tests.hardware.proof.things_watch import scanned

RAM, BACK = 3 * HZ, HZ  # ticks for which a player drives at a thing at most, and away from it
SPEEDS = (1.0, 1.0, 0.7, 0.4)  # of the stick
ASIDE = 30.0  # px beside the middle of a thing at which a player aims
ATTEMPT = 25.0  # mm from a thing, below which it was approached


class Rammer:
    """A player who drives at one thing after another: forwards or backwards, with turbo or without."""

    def __init__(self, seed: int, targets: Sequence[tuple[float, float]]) -> None:
        self._random, self._targets = Random(f"rammer {seed}"), targets
        self._ticks, self._sign, self._speed, self._turbo = 0, 1.0, 1.0, 0
        self._at = targets[0]

    def think(self, state: Any, seat: int) -> None:
        """Drive at the present thing, or away from it."""
        if self._ticks == 0:
            self._choose()
        self._ticks -= 1
        robot, action = state.robots[seat], state.actions[seat]
        if self._ticks < BACK:
            set_action(action, -self._sign * 0.8, 0.3 * self._sign, 0, 0)
            return
        way = atan2(self._at[1] - robot.y, self._at[0] - robot.x) - robot.heading + (pi if self._sign < 0.0 else 0.0)
        turn = atan2(sin(way), cos(way))
        ahead = self._sign * self._speed if abs(turn) < 1.0 else 0.0
        set_action(action, ahead, max(-1.0, min(1.0, 2.0 * turn)), 0, self._turbo)

    def _choose(self) -> None:
        random = self._random
        x, y = random.choice(self._targets)
        self._at = x + random.uniform(-ASIDE, ASIDE), y + random.uniform(-ASIDE, ASIDE)
        self._sign = -1.0 if random.random() < 0.25 else 1.0
        self._speed, self._turbo = random.choice(SPEEDS), random.randrange(2)
        self._ticks = RAM + BACK


class MeasuredBed(testbed.Testbed):
    """A testbed that measures true gaps between robots and things. `nearest`: mm.

    `attempts`: approaches to less than ATTEMPT, each after a retreat.
    """

    nearest, attempts = inf, 0

    def furnish(self, things: Sequence[Prism]) -> None:
        """Put these things on the mat."""
        self.arena.furnish(things)
        self._tall = obstacles(things)
        self._close = [False] * ROBOTS

    def tick(self) -> None:
        super().tick()
        for i, robot in enumerate(self.arena.robots):
            gap = min(_gap(thing, robot.x, robot.y) for thing in self._tall) - RADIUS
            self.nearest = min(self.nearest, gap)
            self.attempts += gap < ATTEMPT and not self._close[i]
            self._close[i] = gap < ATTEMPT or (self._close[i] and gap < 2.0 * ATTEMPT)


def specs_of(bed: testbed.Testbed) -> list[ThingSpec]:
    """Scan the mat of a testbed: its things as a game gets them; flat ones as lines. Raises RuntimeError."""
    layout = scanned(bed).layout
    assert layout is not None
    return [thing.spec for thing in layout.things]


def _gap(thing: Prism, x: float, y: float) -> float:
    """Distance of a point from a thing, mm."""
    if hypot(x - thing.middle[0], y - thing.middle[1]) > thing.reach + 300.0:
        return 300.0
    return distance(thing, x, y)[0]


OPEN_FLOOR = '[title]\nen = "Open floor"\npt = "Sala"\n' + "".join(
    f"[[start]]\nat = [{x}, {y}]\nheading = {round(57.3 * heading)}\n" for x, y, heading in STARTS
)


@pytest.mark.long(first=True)
@pytest.mark.parametrize("seed", repeated([1, 2, 3]))
def test_robots_that_are_driven_into_things_at_full_stick_never_touch_them(seed):
    bed = MeasuredBed(seed, 30.0)
    bed.furnish(some_things(seed, 8, bed.arena.optics, STARTS))
    specs = specs_of(bed)
    arena = parse("pitanks", OPEN_FLOOR + written(specs), "open.toml")
    one, two, three, four = (Seat("human", team) for team in range(ROBOTS))
    setup = Setup("pitanks", "open", (one, two, three, four), 0.25, seed, games()["pitanks"].default.name)
    match = Match(setup, lambda world: RealPlant(world, bed.rig), arena)
    targets = [spec.middle for spec in specs if spec.use is Use.WALL]
    for seat in range(ROBOTS):
        match.sit(seat, Rammer(ROBOTS * seed + seat, targets))
    result = play(bed, match, 10.0)
    assert len(targets) == 6
    assert result.seconds - result.paused >= 9.0
    assert bed.nearest > 0.0
    assert bed.attempts >= 12
