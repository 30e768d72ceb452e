"""The robots' side of our packets, which the program itself does not need: drive packets read, reports written."""

from typing import NamedTuple

from pigaming_app.hardware.radio.packets import REPORT, ROBOTS, STOP, RobotReport, _checked
from pigaming_app.hardware.signals import WheelCommand


class Drive(NamedTuple):
    """What all robots are told at once. A robot whose place is None has its motors off."""

    seq: int
    wheels: tuple[WheelCommand | None, ...]


def drive_from(packet: bytes) -> Drive:
    """What a drive packet says that a PacketDecoder found good. The speed 127, which nobody sends, is a stop."""
    speeds = [0.0 if byte > 2 * STOP else (byte - STOP) / STOP for byte in packet[3 : 3 + 2 * ROBOTS]]
    wheels = (WheelCommand(*speeds[2 * robot : 2 * robot + 2]) for robot in range(ROBOTS))
    return Drive(packet[1], tuple(one if packet[2] >> robot & 1 else None for robot, one in enumerate(wheels)))


def report_packet(report: RobotReport) -> bytes:
    """A robot's report as it goes over the air; the battery is cut to 14 bits."""
    low, high = report.millivolts & 0x7F, report.millivolts >> 7 & 0x7F
    return _checked(bytes((REPORT, report.address & 0x7F, report.seq & 0x7F, report.flags & 0x7F, low, high)))
