"""The session of robots in a ROS network: their poses come from topics, and their speeds go to topics."""

import json
import time
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from pigaming_app.hardware.robot_kinds import DEFAULT
from pigaming_app.hardware.session.robot_session import RobotSession, RobotsUnavailable
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.messages import OperatorMessage

if TYPE_CHECKING:
    from pigaming_app.hardware.calibration.site import CalibrationSite
    from pigaming_app.hardware.control.rig import Rig
    from pigaming_app.hardware.radio.xbee_setup import Carrier
    from pigaming_app.hardware.ros.node import RosNode

WIDTH_MM = 2112.0  # of the nominal arena
STICK_AGE = 0.5  # s, after which a message of a joystick or of keys no longer counts
STATE_EVERY = 0.1  # s between two messages of the state
SEATS = {f"robot_{seat + 1}": seat for seat in range(ROBOTS)}
Stick = tuple[float, float, bool, bool]  # ahead, clockwise, fire, turbo


class RosSession(RobotSession):
    """Robots of an arena `width` mm wide."""

    radio = False

    def __init__(self, width: float = WIDTH_MM) -> None:
        self.width = width
        self._node: RosNode | None = None
        self._sticks: dict[int | None, tuple[float, Stick]] = {}  # by seat; None: not addressed
        self._published = 0.0

    @property
    def site(self) -> "CalibrationSite":
        raise RobotsUnavailable(OperatorMessage("ros_site"))

    @property
    def arena_id(self) -> int:
        raise RobotsUnavailable(OperatorMessage("ros_site"))

    def carrier(self, number: int) -> "Carrier":
        raise RobotsUnavailable(OperatorMessage("ros_site"))

    def open(self) -> "Rig":
        if self._rig is None:
            from pigaming_app.hardware.control.kinematics import Kinematics
            from pigaming_app.hardware.control.rig import UNMEASURED, Rig, unmeasured
            from pigaming_app.hardware.drivers.driver import LinkSite
            from pigaming_app.hardware.drivers.ours import ROS
            from pigaming_app.hardware.ros.node import STATE, ArenaFrame, RosNode, RosUnavailable, topic_of
            from pigaming_app.hardware.ros.robots import RosPoses

            try:
                self._node = RosNode("pigaming", [*(topic_of(robot, "cmd_vel") for robot in range(ROBOTS)), STATE])
            except RosUnavailable as error:
                raise RobotsUnavailable(error.message) from error
            frame = ArenaFrame.of_width(self.width)
            drivetrains = [unmeasured(DEFAULT, frame.mm, UNMEASURED.dead_time)] * ROBOTS
            self._node.on_joystick(self._take_stick)
            self._node.on_keys(self._take_keys)
            poses = RosPoses(self._node, frame, time.monotonic, drivetrains)
            link = ROS.open(LinkSite(0, time.monotonic, poses=poses))
            rig = Rig(poses, poses, link, time.monotonic, drivetrains, mm=frame.mm)
            rig.kinematics = [Kinematics(drivetrain, levels=None) for drivetrain in drivetrains]
            rig.remote = True
            self.mm, self._rig = frame.mm, rig.start()
        return self._rig

    def stick(self, seat: int, first: bool) -> Stick | None:
        """Joystick or keys of a seat; those that address none are the `first` person's."""
        now = time.monotonic()
        for key in (seat, None) if first else (seat,):
            received, stick = self._sticks.get(key, (float("-inf"), (0.0, 0.0, False, False)))
            if now - received < STICK_AGE:
                return stick
        return None

    def publish(self, state: Mapping[str, Any]) -> None:
        """Publish the state of the match, ten times a second at most."""
        now = time.monotonic()
        if self._node is not None and now - self._published >= STATE_EVERY:
            self._published = now
            self._node.publish_state(json.dumps(state))

    def close(self) -> None:
        super().close()
        self._node = None

    def _take_stick(self, frame: str, axes: tuple[float, ...], buttons: tuple[int, ...]) -> None:
        """The layout of joy_node: axis 0 to the left, axis 1 ahead; buttons 0 and 1."""
        left, ahead = (max(-1.0, min(1.0, axis)) if axis == axis else 0.0 for axis in (*axes, 0.0, 0.0)[:2])
        fire, turbo = (bool(button) for button in (*buttons, 0, 0)[:2])
        self._sticks[SEATS.get(frame)] = time.monotonic(), (ahead, -left, fire, turbo)

    def _take_keys(self, text: str) -> None:
        """The names of all keys that are held, and perhaps that of a robot, in any order."""
        held = set(text.lower().split())
        ahead, clockwise = float("up" in held) - ("down" in held), float("right" in held) - ("left" in held)
        seat = next((SEATS[word] for word in held if word in SEATS), None)
        self._sticks[seat] = time.monotonic(), (ahead, clockwise, "fire" in held, "turbo" in held)
