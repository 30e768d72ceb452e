"""Robots and cameras of a ROS network as the camera, tracker and link of a rig.

The same filters predict over the dead time, and the same safety judges ages. Commands go out 50 times a second; without
a new one for 0.1 s, and five times at the end, the speeds are zero.
"""

import threading
from collections import deque
from collections.abc import Sequence
from math import isfinite

import numpy as np

from pigaming_app.hardware.radio.link import BEAT, FAREWELLS, PATIENCE, CommandLink
from pigaming_app.hardware.radio.protocol import LinkQuality
from pigaming_app.hardware.ros.node import ArenaFrame, Pose, RosNode
from pigaming_app.hardware.signals import CameraFrame, Clock, ExposureState, Fix, Telemetry, WheelCommand
from pigaming_app.hardware.tracking.pose_filters import PoseFilters
from pigaming_app.sim.drivetrain import Drivetrain, twist
from pigaming_app.sim.plant import Twist
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.messages import OperatorMessage

BATTERY = 0.0  # V: none is reported
POSES = 20  # a second and robot, at least, for a share of 100 %
WINDOW = 2.0  # s over which poses are counted
ABSENT = 1.0  # s without any pose after which the network is reported
LATE = 0.25  # s, age of the newest pose after which its stamp or the network is reported
OUTSIDE = 5000.0  # px, poses farther off are refused
NO_PICTURE = np.zeros((0, 0), np.uint8)
REST: Twist = (0.0, 0.0)


class RosPoses(PoseFilters):
    """Poses from topics: CameraSource and tracker of a rig."""

    def __init__(self, node: RosNode, frame: ArenaFrame, clock: Clock, drivetrains: Sequence[Drivetrain]) -> None:
        super().__init__(drivetrains, frame.mm)
        self.node, self.frame, self.clock = node, frame, clock
        self.received = [float("-inf")] * ROBOTS  # s, newest pose of each robot
        self._arrived = [deque[float](maxlen=round(POSES * WINDOW)) for _ in range(ROBOTS)]  # s, by robot
        self._begun = clock()
        self._lock = threading.Lock()
        self._waiting: list[Fix] = []
        self._frames = 0
        for robot in range(ROBOTS):
            node.on_pose(robot, self._take)

    @property
    def fault(self) -> OperatorMessage | None:
        """Fault of the node, no poses at all, or late ones alone."""
        now = self.clock()
        if self.node.fault is not None:
            return self.node.fault
        if now - max([self._begun, *(times[-1] for times in self._arrived if times)]) > ABSENT:
            return OperatorMessage("ros_poses")
        late = now - max(self.received)
        return OperatorMessage("ros_late", seconds=f"{late:.1f}") if LATE < late < float("inf") else None

    def share(self, robot: int) -> float:
        """Poses of the last WINDOW s as a share of POSES a second, at most 1."""
        return min(1.0, sum(self.clock() - time < WINDOW for time in tuple(self._arrived[robot])) / (POSES * WINDOW))

    @property
    def exposure(self) -> ExposureState:
        """Unknown: the cameras are the network's."""
        return ExposureState()

    def newest(self) -> CameraFrame | None:
        """A frame without a picture if poses have arrived, else None."""
        if not self._waiting:
            return None
        self._frames += 1
        return CameraFrame(NO_PICTURE, self.clock(), self._frames)

    def process(self, frame: CameraFrame) -> list[Fix]:
        """Correct the filters with the poses that have arrived."""
        with self._lock:
            fixes, self._waiting = self._waiting, []
        for fix in fixes:
            self.last_captured = max(self.last_captured, fix.captured)
        return [fix for fix in sorted(fixes, key=lambda fix: fix.captured) if self.filters[fix.robot].correct(fix)]

    def close(self) -> None:
        """Leave the topics."""
        self.node.close()

    def _take(self, robot: int, pose: Pose, age: float) -> None:
        x, y, heading = self.frame.from_ros(pose)
        if not all(isfinite(number) for number in (x, y, heading, age)) or max(abs(x), abs(y)) > OUTSIDE:
            return
        captured = self.clock() - age
        with self._lock:
            self.received[robot] = max(self.received[robot], captured)
            self._arrived[robot].append(self.clock())
            self._waiting.append(Fix(robot, x, y, heading, captured))


class RosLink(CommandLink):
    """Commands to topics, published at once."""

    def __init__(self, poses: RosPoses) -> None:
        super().__init__(poses.clock)
        self.node, self.poses, self.drivetrains = poses.node, poses, [one.drivetrain for one in poses.filters]
        self._driven: set[int] = set()  # robots that were commanded; the others belong to somebody else

    @property
    def telemetry(self) -> dict[int, Telemetry]:
        """A pose counts as a report."""
        seen = enumerate(self.poses.received)
        return {i: Telemetry(i, BATTERY, 0, received) for i, received in seen if isfinite(received)}

    @property
    def fault(self) -> OperatorMessage | None:
        return OperatorMessage("ros_gone") if self._dead else self.node.fault

    def quality(self, robot: int) -> LinkQuality:
        """Reception of a robot's poses."""
        return LinkQuality(self.poses.share(robot), None, None)

    def send(self, wheels: Sequence[WheelCommand | None]) -> None:
        self._driven |= {i for i, command in enumerate(wheels) if command is not None}
        super().send(wheels)

    def pump(self) -> None:
        """Publish the speeds of the robots that were driven."""
        posted, wheels = self._mail
        fresh = self._clock() - posted <= PATIENCE
        for robot in sorted(self._driven):
            command = wheels[robot] if fresh else None
            speeds = twist(self.drivetrains[robot], *command) if command else REST
            self.node.publish_twist(robot, self.poses.frame.twist_to_ros(speeds))

    def _shut_down(self) -> None:
        pause = threading.Event()
        for _ in range(FAREWELLS):
            self._mail = (float("-inf"), self._mail[1])
            self.pump()
            pause.wait(BEAT)  # a topic is sent by a thread of its own
