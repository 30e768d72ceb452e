"""Plants: the interface through which robots, real or simulated, are moved. Games only request speeds."""

from collections import deque
from collections.abc import Sequence
from math import exp
from typing import Any, NamedTuple, Protocol

from pigaming_app.sim.contact import drive
from pigaming_app.sim.drivetrain import MM, Drivetrain, twist, wheel_shares
from pigaming_app.sim.world import DT, World

Pose = tuple[float, float, float]  # px, px, rad
Twist = tuple[float, float]  # px/s, rad/s


class Sighting(NamedTuple):
    """The last known pose of a robot, px, px, rad, and its age."""

    x: float
    y: float
    heading: float
    age: float  # s


class Plant(Protocol):
    """Robots, real or simulated, in the order of their seats."""

    @property
    def mm(self) -> float:
        """Length of an arena px on their surface, mm; simulated ones are on the nominal mat."""

    def sense(self) -> Sequence[Sighting]:
        """The latest pose of every robot."""

    def drive(self, twists: Sequence[Twist], dt: float) -> None:
        """Drive every robot for `dt` seconds at the requested speeds."""

    def place(self, poses: Sequence[Pose]) -> None:
        """Move every robot to its start pose."""


class SimPlant:
    """Simulated robots, stored in the match's own record, so that a snapshot of the match includes them.

    With `drivetrains`, the first robots have the speed limits, lag and dead time of measured real ones.
    """

    mm = MM

    def __init__(self, world: World, drivetrains: Sequence[Drivetrain] = ()) -> None:
        self.world: Any = world
        self.drivetrains = drivetrains
        self._in_flight = _stopped(drivetrains)
        for robot, drivetrain in zip(self.world.robots, drivetrains, strict=False):
            robot.gain = 1.0 - exp(-DT / drivetrain.lag)

    def sense(self) -> list[Sighting]:
        return [Sighting(robot.x, robot.y, robot.heading, 0.0) for robot in self.world.robots]

    def drive(self, twists: Sequence[Twist], dt: float) -> None:
        for robot, (linear, angular) in zip(self.world.robots, self._delayed(twists), strict=True):
            robot.requested_linear, robot.requested_angular = linear, angular
        drive(self.world)

    def place(self, poses: Sequence[Pose]) -> None:
        for robot, (x, y, heading) in zip(self.world.robots, poses, strict=True):
            robot.x, robot.y, robot.heading = x, y, heading
            robot.linear = robot.angular = 0.0
        self._in_flight = _stopped(self.drivetrains)

    def _delayed(self, twists: Sequence[Twist]) -> Sequence[Twist]:
        """The commands that reach the motors in this tick, after dead time and limits of the drivetrains."""
        if not self.drivetrains:
            return twists
        delayed = list(twists)
        for seat, (drivetrain, queue) in enumerate(zip(self.drivetrains, self._in_flight, strict=True)):
            queue.append(twist(drivetrain, *wheel_shares(drivetrain, *twists[seat])))
            delayed[seat] = queue.popleft()
        return delayed


def _stopped(drivetrains: Sequence[Drivetrain]) -> list[deque[Twist]]:
    """A queue of commands in flight for each robot, filled with zero twists over its dead time."""
    return [deque((0.0, 0.0) for _ in range(round(train.dead_time / DT))) for train in drivetrains]
