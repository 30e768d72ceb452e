"""Acceptance trials of the robot loop on the emulated arena.

`follow` measures tracking accuracy; `play` plays a whole match and measures how deep robots get into walls. Faults are
covered by `emergencies`.
"""

from dataclasses import dataclass
from math import atan2, degrees, hypot, pi, sin, sqrt, tau
from random import Random
from typing import Any, NamedTuple

from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.proof.testbed import Testbed
from pigaming_app.sim.action import set_action
from pigaming_app.sim.plant import Sighting, Twist
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.world import DT, HEIGHT, HZ, RADIUS, ROBOTS, WIDTH, World


@dataclass(frozen=True)
class TrackingResult:
    """Tracking of four robots: predicted present poses, with dead time compensated, against ground truth."""

    rmse_mm: float
    rmse_deg: float
    tracker_ms: float  # per frame, on one core
    complete: float  # share of the frames in which all four were found


class FigureEight:
    """Four robots that drive figures of eight, one per quarter of the arena, by closed-loop control.

    `speed`: mm/s; 0: that of the bed's way of showing.
    """

    def __init__(self, bed: Testbed, speed: float = 0.0) -> None:
        bed.session.find()
        self.speed = speed or bed.showing.speed
        self.bed, self.world = bed, World()
        for robot in self.world.robots:
            robot.present = 1
        self.plant = RealPlant(self.world, bed.rig)
        self._phase = [0.0] * ROBOTS  # rad, of each robot's figure

    def tick(self) -> None:
        """Advance by 1/50 s."""
        twists = [self._steered(i, sighting) for i, sighting in enumerate(self.plant.sense())]
        self.plant.drive(twists, DT)
        self.bed.tick()

    def _steered(self, robot: int, seen: Sighting) -> Twist:
        """Twist at full speed towards the figure's point at least 90 px ahead."""
        for _ in range(50):
            x, y = self._figure(robot)
            if hypot(x - seen.x, y - seen.y) > 90.0:
                break
            self._phase[robot] += 0.02
        aside = (atan2(y - seen.y, x - seen.x) - seen.heading + pi) % tau - pi
        return self.speed / self.bed.ground.mm, max(-3.0, min(3.0, 4.0 * aside))

    def _figure(self, robot: int) -> tuple[float, float]:
        middle_x, middle_y = 400.0 + 800.0 * (robot in (1, 2)), 225.0 + 450.0 * (robot in (2, 3))
        turn = self._phase[robot] + robot
        return middle_x + 250.0 * sin(turn), middle_y + 110.0 * sin(2.0 * turn)


def follow(trail: FigureEight, seconds: float) -> TrackingResult:
    """Measure tracking for `seconds`, after two seconds of acceleration."""
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


class ButtonMasher:
    """A player that holds random sticks and buttons for up to a second each."""

    def __init__(self, seed: int) -> None:
        self._random = Random(f"masher {seed}")
        self._ticks = 0
        self._held = (0.0, 0.0, 0, 0)

    def think(self, state: Any, seat: int) -> None:
        """Set the held action, drawing a new one when its time is over."""
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
    """Result of a match on the mat."""

    deepest_mm: float  # deepest intrusion into a wall or beyond the arena's edge
    seconds: float  # simulated time, including pauses
    paused: float  # s
    places: float  # s until all robots had taken their places
    alarms: int  # number of robots that had to be cleared after a lasting fault


def play(bed: Testbed, match: Any, seconds: float) -> MatchResult:
    """Let the robots take their places, then play the match to its end. Raises RuntimeError if either takes too long.

    `match`: of the games. As in the arcade, it is paused for as long as a pausing fault lasts.
    """
    plant: RealPlant = match.plant
    ready = alarms = 0
    while not plant.take_places():
        alarms += _clear_faults(plant)
        ready += 1
        bed.tick()
        if ready > 90 * HZ:
            raise RuntimeError(f"not all took their places: {plant.places}, {plant.faults}")
    bed.lighting.show(busy=True)
    deepest, ticks, paused = 0.0, 0, 0
    body = bed.body_mm / bed.ground.mm
    longest = seconds + match.game.variants[match.setup.variant].overtime
    while not match.over:
        if plant.safety.pauses:
            alarms += _clear_faults(plant)
            plant.watch()
            paused += 1
        else:
            match.tick()
        bed.tick()
        ticks += 1
        deepest = max(deepest, *(entered(match.state, x, y, body) for x, y, _ in bed.arena.poses()))
        if ticks > 1.5 * HZ * longest + 20 * HZ:
            raise RuntimeError(f"the match did not end: {plant.faults}")
    return MatchResult(deepest * bed.ground.mm, ticks * DT, paused * DT, ready * DT, alarms)


def _clear_faults(plant: RealPlant) -> int:
    """Clear the lasting faults that wait for an operator; returns their number."""
    waiting = plant.safety.latched
    for robot in waiting:
        plant.clear_fault(robot)
    return len(waiting)


def entered(world: Any, x: float, y: float, radius: float = RADIUS) -> float:
    """Depth of a robot at (x, y) in a standing wall or beyond the edge, px; negative: distance to the nearest."""
    depths = [radius - x, radius - y, x + radius - WIDTH, y + radius - HEIGHT]
    for i in range(world.wall_count):
        wall = world.walls[i]
        if wall.health:
            depths.append(wall.half + radius - hypot(*offset_from_wall(wall, x, y)))
    return max(depths)
