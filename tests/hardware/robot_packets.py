"""The robots' side of the packet protocol: parses drive packets and encodes reports."""

from typing import NamedTuple

from pigaming_app.hardware.radio.packets import REPORT, ROBOTS, STOP, RobotReport, _checked
from pigaming_app.hardware.signals import WheelCommand


class Drive(NamedTuple):
    """Commands of all robots; None: motors off."""

    seq: int
    wheels: tuple[WheelCommand | None, ...]


def drive_from(packet: bytes) -> Drive:
    """Parse a drive packet validated by PacketDecoder. The unused speed 127 is a stop."""
    speeds = [0.0 if byte > 2 * STOP else (byte - STOP) / STOP for byte in packet[3 : 3 + 2 * ROBOTS]]
    wheels = (WheelCommand(*speeds[2 * robot : 2 * robot + 2]) for robot in range(ROBOTS))
    return Drive(packet[1], tuple(pair if packet[2] >> robot & 1 else None for robot, pair in enumerate(wheels)))


def report_packet(report: RobotReport) -> bytes:
    """Encode a robot's report; the battery voltage is truncated to 14 bits."""
    low, high = report.millivolts & 0x7F, report.millivolts >> 7 & 0x7F
    return _checked(bytes((REPORT, report.address & 0x7F, report.seq & 0x7F, report.flags & 0x7F, low, high)))
