"""What robots must be able to do before anybody lets them drive, measured on the emulated arena.

`follow`: how well they are tracked. `play`: a whole match, and how deep a robot gets into a wall. What goes wrong is in
`emergencies`.
"""

from dataclasses import dataclass
from math import atan2, degrees, hypot, pi, sin, sqrt, tau
from random import Random
from typing import Any, NamedTuple, Protocol

from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.proof.testbed import Testbed
from pigaming_app.sim.action import set_action
from pigaming_app.sim.plant import Sighting, Twist
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.world import DT, HEIGHT, HZ, ROBOTS, WIDTH, World

SPEED = 350.0  # mm/s


@dataclass(frozen=True)
class TrackingResult:
    """How well four robots were tracked: against where they were at that moment, all dead time made up for."""

    rmse_mm: float
    rmse_deg: float
    tracker_ms: float  # a picture, on one core
    complete: float  # share of the pictures in which all four were found


class FigureEight:
    """Four robots that drive figures of eight, each in its quarter, steered by what the rig says."""

    def __init__(self, bed: Testbed) -> None:
        bed.session.find()
        self.bed, self.world = bed, World()
        for robot in self.world.robots:
            robot.present = 1
        self.plant = RealPlant(self.world, bed.rig)
        self._along = [0.0] * ROBOTS

    def tick(self) -> None:
        """1/50 s of it."""
        twists = [self._steered(i, sighting) for i, sighting in enumerate(self.plant.sense())]
        self.plant.drive(twists, DT)
        self.bed.tick()

    def _steered(self, robot: int, seen: Sighting) -> Twist:
        """At full pace towards a point of the figure that stays ahead."""
        for _ in range(50):
            x, y = self._figure(robot)
            if hypot(x - seen.x, y - seen.y) > 90.0:
                break
            self._along[robot] += 0.02
        aside = (atan2(y - seen.y, x - seen.x) - seen.heading + pi) % tau - pi
        return SPEED / self.bed.ground.mm, max(-3.0, min(3.0, 4.0 * aside))

    def _figure(self, robot: int) -> tuple[float, float]:
        middle_x, middle_y = 400.0 + 800.0 * (robot in (1, 2)), 225.0 + 450.0 * (robot in (2, 3))
        turn = self._along[robot] + robot
        return middle_x + 250.0 * sin(turn), middle_y + 110.0 * sin(2.0 * turn)


def follow(trail: FigureEight, seconds: float) -> TrackingResult:
    """Drive for so long at 0.35 m/s, after two seconds to get up speed."""
    bed, misses = trail.bed, []
    for _ in range(2 * HZ):
        trail.tick()
    bed.count()
    for _ in range(round(seconds * HZ)):
        trail.tick()
        misses += bed.misses()
    tracker = bed.tracker
    return TrackingResult(
        sqrt(sum(mm * mm for mm, _ in misses) / len(misses)),
        degrees(sqrt(sum(turned * turned for _, turned in misses) / len(misses))),
        1e3 * tracker.seconds / tracker.pictures,
        tracker.complete / tracker.pictures,
    )


class PlayableMatch(Protocol):
    """The part of a match that is played here."""

    state: Any
    plant: Any

    @property
    def over(self) -> bool:
        """Whether it has ended."""

    def tick(self) -> None:
        """Advance by 1/50 s."""


class ButtonMasher:
    """A seat at which somebody mashes all buttons and throws the stick about."""

    def __init__(self, seed: int) -> None:
        self._random = Random(f"masher {seed}")
        self._ticks = 0
        self._held = (0.0, 0.0, 0, 0)

    def think(self, state: Any, seat: int) -> None:
        """Hold on to something for up to a second."""
        random = self._random
        if not self._ticks:
            self._ticks = random.randrange(3, HZ)
            linear = random.choice((-64, -32, 48, 64, 64, 64)) / 64
            self._held = (
                linear,
                random.choice((-64, -20, 0, 0, 20, 64)) / 64,
                random.randrange(2),
                random.randrange(2),
            )
        self._ticks -= 1
        set_action(state.actions[seat], *self._held)


class MatchResult(NamedTuple):
    """How a match on the mat went."""

    deepest_mm: float  # into a wall or over the arena's edge
    seconds: float  # of simulated time, pauses and all
    paused: float
    places: float  # s until all had taken their places
    alarms: int  # how often a robot seemed not to do as it was told


def play(bed: Testbed, match: PlayableMatch, seconds: float) -> MatchResult:
    """Let the robots take their places and play to the end. Raises RuntimeError if either takes too long.

    Pauses are as the arcade makes them: as long as a fault that pauses is there, nobody plays.
    """
    plant: RealPlant = match.plant
    ready = alarms = 0
    while not plant.take_places():
        alarms += _calm(plant)
        ready += 1
        bed.tick()
        if ready > 90 * HZ:
            raise RuntimeError(f"not all took their places: {plant.places}, {plant.faults}")
    bed.lighting.show(busy=True)
    deepest, ticks, paused = 0.0, 0, 0
    while not match.over:
        if plant.safety.pauses:
            alarms += _calm(plant)
            plant.watch()
            paused += 1
        else:
            match.tick()
        bed.tick()
        ticks += 1
        deepest = max(deepest, *(entered(match.state, x, y) for x, y, _ in bed.arena.poses()))
        if ticks > 1.5 * HZ * seconds + 20 * HZ:
            raise RuntimeError(f"the match did not end: {plant.faults}")
    return MatchResult(deepest * bed.ground.mm, ticks * DT, paused * DT, ready * DT, alarms)


def _calm(plant: RealPlant) -> int:
    """Let robots go on that wait until somebody has looked after them; how many there were."""
    waiting = plant.safety.lasting
    for robot in waiting:
        plant.forgive(robot)
    return len(waiting)


def entered(world: Any, x: float, y: float) -> float:
    """How far, in px, a robot at (x, y) is in a wall that stands or over the edge; negative: how far it is from it."""
    depths = [RADIUS - x, RADIUS - y, x + RADIUS - WIDTH, y + RADIUS - HEIGHT]
    for i in range(world.wall_count):
        wall = world.walls[i]
        if wall.health:
            depths.append(wall.half + RADIUS - hypot(*offset_from_wall(wall, x, y)))
    return max(depths)
