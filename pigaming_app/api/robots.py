"""Drivers of robots: what one declares, the link that it opens, and emulated robots for `robots check`."""

from pigaming_app.hardware.drivers.driver import LinkSite, RobotDriver
from pigaming_app.hardware.drivers.stand import RobotStand
from pigaming_app.hardware.radio.link import CommandLink, Link
from pigaming_app.hardware.radio.protocol import LinkQuality, Misfit, RadioProtocol
from pigaming_app.hardware.robot_kinds import RobotKind
from pigaming_app.hardware.signals import Telemetry, WheelCommand

__all__ = [
    "CommandLink",
    "Link",
    "LinkQuality",
    "LinkSite",
    "Misfit",
    "RadioProtocol",
    "RobotDriver",
    "RobotKind",
    "RobotStand",
    "Telemetry",
    "WheelCommand",
]
