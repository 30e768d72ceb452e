"""Drivers of robots: what one declares, the link that it opens, and emulated robots for `robots check`."""

from pigaming_app.hardware.drivers.driver import Driver, LinkSite
from pigaming_app.hardware.drivers.stand import Stand
from pigaming_app.hardware.radio.link import CommandLink, Link
from pigaming_app.hardware.radio.protocol import LinkQuality, Misfit, RadioProtocol
from pigaming_app.hardware.robot_kinds import RobotKind
from pigaming_app.hardware.signals import Telemetry, WheelCommand

__all__ = [
    "CommandLink",
    "Driver",
    "Link",
    "LinkQuality",
    "LinkSite",
    "Misfit",
    "RadioProtocol",
    "RobotKind",
    "Stand",
    "Telemetry",
    "WheelCommand",
]
