"""A plant moves robots; a game never does."""

from collections import deque
from collections.abc import Sequence
from math import exp
from typing import Any, NamedTuple, Protocol

from pigaming_app.sim.contact import drive
from pigaming_app.sim.drivetrain import Drivetrain, twist, wheel_shares
from pigaming_app.sim.world import DT, World

Pose = tuple[float, float, float]  # px, px, rad
Twist = tuple[float, float]  # px/s, rad/s


class Sighting(NamedTuple):
    """Where a robot is known to be, and how old that knowledge is."""

    x: float
    y: float
    heading: float
    age: float  # s


class Plant(Protocol):
    """Robots, real or simulated, in the order of their seats."""

    def sense(self) -> Sequence[Sighting]:
        """Where every robot is."""

    def drive(self, twists: Sequence[Twist], dt: float) -> None:
        """Let every robot drive for `dt` seconds with the speeds asked for."""

    def place(self, poses: Sequence[Pose]) -> None:
        """Bring every robot to where it shall begin."""


class SimPlant:
    """Simulated robots: those of a match's own record, so that a snapshot of the match holds them too.

    With `drivetrains`, the first robots drive like real ones that were measured: no faster, as lazily, as late.
    """

    def __init__(self, world: World, drivetrains: Sequence[Drivetrain] = ()) -> None:
        self.world: Any = world
        self.drivetrains = drivetrains
        self.waiting = _silence(drivetrains)
        for robot, drivetrain in zip(self.world.robots, drivetrains, strict=False):
            robot.gain = 1.0 - exp(-DT / drivetrain.lag)

    def sense(self) -> list[Sighting]:
        return [Sighting(robot.x, robot.y, robot.heading, 0.0) for robot in self.world.robots]

    def drive(self, twists: Sequence[Twist], dt: float) -> None:
        for robot, (linear, angular) in zip(self.world.robots, self._heard(twists), strict=True):
            robot.ask_linear, robot.ask_angular = linear, angular
        drive(self.world)

    def place(self, poses: Sequence[Pose]) -> None:
        for robot, (x, y, heading) in zip(self.world.robots, poses, strict=True):
            robot.x, robot.y, robot.heading = x, y, heading
            robot.linear = robot.angular = 0.0
        self.waiting = _silence(self.drivetrains)

    def _heard(self, twists: Sequence[Twist]) -> Sequence[Twist]:
        """What the motors are told in this tick."""
        if not self.drivetrains:
            return twists
        heard = list(twists)
        for seat, (drivetrain, waiting) in enumerate(zip(self.drivetrains, self.waiting, strict=True)):
            waiting.append(twist(drivetrain, *wheel_shares(drivetrain, *twists[seat])))
            heard[seat] = waiting.popleft()
        return heard


def _silence(drivetrains: Sequence[Drivetrain]) -> list[deque[Twist]]:
    """For each robot, what it has been told and not yet heard: to stand."""
    return [deque((0.0, 0.0) for _ in range(round(one.dead_time / DT))) for one in drivetrains]
