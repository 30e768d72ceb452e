"""The robots on the mat for a ROS network: their poses as topics, their speeds by topics, within walls and safety."""

from math import isfinite
from typing import Any

from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.ros.node import ArenaFrame, RosNode
from pigaming_app.hardware.signals import Clock
from pigaming_app.sim.plant import Twist
from pigaming_app.sim.world import DT, ROBOTS, World

FRESH = 0.2  # s, age of a command after which a robot stands
SEEN = 0.2  # s, age of a pose after which it is not published
MAX_LINEAR, MAX_ANGULAR = 1000.0, 12.0  # px/s, rad/s; further limits are those of a match
REST: Twist = (0.0, 0.0)


class Bridge:
    """Call `tick` 50 times a second."""

    def __init__(self, rig: Rig, node: RosNode, mm: float, clock: Clock) -> None:
        self.node, self.frame, self.clock = node, ArenaFrame(mm), clock
        world: Any = World()
        for robot in world.robots:
            robot.present = 1
        self.plant = RealPlant(world, rig)
        self._commands: dict[int, tuple[float, Twist]] = {}
        for robot in range(ROBOTS):
            node.on_twist(robot, self._take)

    def tick(self) -> None:
        """Publish the poses and drive."""
        seen, now = self.plant.sense(), self.clock()
        for robot, (x, y, heading, age) in enumerate(seen):
            if age < SEEN:
                self.node.publish_pose(robot, self.frame.to_ros((x, y, heading)))
        twists = [self._commands.get(robot, (float("-inf"), REST)) for robot in range(ROBOTS)]
        self.plant.drive([twist if now - sent < FRESH else REST for sent, twist in twists], DT)

    def _take(self, robot: int, twist: Twist) -> None:
        linear, angular = self.frame.twist_from_ros(twist)
        if isfinite(linear) and isfinite(angular):
            limited = max(-MAX_LINEAR, min(MAX_LINEAR, linear)), max(-MAX_ANGULAR, min(MAX_ANGULAR, angular))
            self._commands[robot] = self.clock(), limited
