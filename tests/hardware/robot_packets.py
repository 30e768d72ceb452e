"""The robots' side of the packet protocol: parses drive packets and encodes reports."""

from typing import NamedTuple

from pigaming_app.hardware.radio.packets import OLD_REPORT, REPORT, ROBOTS, STOP, RobotReport, crc8, with_crc
from pigaming_app.hardware.signals import WheelCommand

ARENA = 4711  # of the tests


class Drive(NamedTuple):
    """Commands of all robots; None: motors off."""

    arena: int
    seq: int
    wheels: tuple[WheelCommand | None, ...]


def drive_from(packet: bytes) -> Drive:
    """Parse a drive packet validated by PacketDecoder. The unused speed 127 is a stop."""
    speeds = [0.0 if byte > 2 * STOP else (byte - STOP) / STOP for byte in packet[5 : 5 + 2 * ROBOTS]]
    wheels = (WheelCommand(*speeds[2 * robot : 2 * robot + 2]) for robot in range(ROBOTS))
    enabled = (pair if packet[4] >> robot & 1 else None for robot, pair in enumerate(wheels))
    return Drive(packet[1] | packet[2] << 7, packet[3], tuple(enabled))


def report_packet(report: RobotReport) -> bytes:
    """Encode a robot's report; the battery voltage is truncated to 14 bits."""
    arena, address, version, seq, flags, millivolts = report
    fields = (arena, arena >> 7, address, version, seq, flags, millivolts, millivolts >> 7)
    return with_crc(bytes((REPORT, *(field & 0x7F for field in fields))))


def old_report(address: int, millivolts: int = 5000) -> bytes:
    """A report of firmware 1, whose motors are stopped."""
    packet = bytes((OLD_REPORT, address, 0, 1, millivolts & 0x7F, millivolts >> 7))
    return packet + bytes((crc8(packet) & 0x7F,))
