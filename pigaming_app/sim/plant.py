"""A plant moves robots; a game never does."""

from collections.abc import Sequence
from typing import Any, NamedTuple, Protocol

from pigaming_app.sim.contact import drive
from pigaming_app.sim.world import World

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
    """Simulated robots: those of a match's own record, so that a snapshot of the match holds them too."""

    def __init__(self, world: World) -> None:
        self.world: Any = world

    def sense(self) -> list[Sighting]:
        return [Sighting(robot.x, robot.y, robot.heading, 0.0) for robot in self.world.robots]

    def drive(self, twists: Sequence[Twist], dt: float) -> None:
        for robot, (linear, angular) in zip(self.world.robots, twists, strict=True):
            robot.ask_linear, robot.ask_angular = linear, angular
        drive(self.world)

    def place(self, poses: Sequence[Pose]) -> None:
        for robot, (x, y, heading) in zip(self.world.robots, poses, strict=True):
            robot.x, robot.y, robot.heading = x, y, heading
            robot.linear = robot.angular = 0.0
