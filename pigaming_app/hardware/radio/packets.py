"""Encoding and decoding of our radio packets, version 2 of the protocol (docs/hardware.md, section Protocol).

Pure functions and a stream decoder, without ports or clocks. Every byte but the first holds 7 bits, so any byte from 80
(hex) up starts a packet. Every packet names its arena, so that two arenas on one radio channel ignore each other, and
ends with a CRC-32.
"""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple
from zlib import crc32

if TYPE_CHECKING:
    from pigaming_app.hardware.signals import WheelCommand

ROBOTS = 4
STOP = 63  # the middle of the speed codes 0 to 126
DRIVE, REPORT = 0xD1, 0xD5
OLD_REPORT = 0xD4  # report of firmware 1, which does not know D1 packets; decoded only to name such a robot
CRC_BYTES = 5  # 32 bits in 7-bit bytes
LENGTHS = {DRIVE: 5 + 2 * ROBOTS + CRC_BYTES, REPORT: 9 + CRC_BYTES, OLD_REPORT: 7}  # bytes
START = re.compile(rb"[\x80-\xff]")  # first byte of a packet
SEQUENCE = 128  # sequence numbers run from 0 to 127 and wrap; robots ignore a packet with an unchanged one
NO_ARENA, LAST_ARENA = 0, 16383  # ids of arenas are 1 to LAST_ARENA; a robot without one neither drives nor is driven
VERSION = 2  # of firmware that speaks this protocol

DEADMAN, LOW, EMPTY, RESTARTED, PARKED = 1, 2, 4, 8, 16  # flags of a report, see RobotReport


class RobotReport(NamedTuple):
    """Status report of a robot."""

    arena: int  # NO_ARENA: the robot was flashed without one
    address: int  # 1 to 4
    version: int  # of the firmware
    seq: int  # sequence number of the last drive packet received
    flags: int  # DEADMAN: stopped by it; LOW battery; EMPTY battery, motors off; RESTARTED by the watchdog;
    # PARKED by the button on it, motors off
    millivolts: int


def drive_packet(arena: int, seq: int, wheels: "Sequence[WheelCommand | None]") -> bytes:
    """Packet for robots 0 to 3 of an arena, disabled where None or missing.

    Raises ValueError for a fifth robot and for an id that no arena has.
    """
    if len(wheels) > ROBOTS:
        raise ValueError(f"{len(wheels)} robots; the packet has room for {ROBOTS}")
    if not NO_ARENA < arena <= LAST_ARENA:
        raise ValueError(f"arena {arena}; ids are 1 to {LAST_ARENA}")
    commands = [*wheels, *[None] * (ROBOTS - len(wheels))]
    enabled = sum(1 << robot for robot, command in enumerate(commands) if command is not None)
    speeds = [_speed(share) for command in commands for share in command or (0.0, 0.0)]
    return with_crc(bytes((DRIVE, *in_7_bits(arena, 2), seq % SEQUENCE, enabled, *speeds)))


def report_from(packet: bytes) -> RobotReport:
    """Parse a REPORT packet that a PacketDecoder has validated."""
    address, version, seq, flags = packet[3:7]
    return RobotReport(from_7_bits(packet[1:3]), address, version, seq, flags, from_7_bits(packet[7:9]))


def in_7_bits(number: int, count: int) -> bytes:
    """The lowest 7 * `count` bits of a number, low first."""
    return bytes(number >> 7 * place & 0x7F for place in range(count))


def from_7_bits(data: bytes) -> int:
    """The number in 7-bit bytes, low first."""
    return sum(byte << 7 * place for place, byte in enumerate(data))


def with_crc(packet: bytes) -> bytes:
    """The packet with the CRC-32 (IEEE) of all its bytes appended."""
    return packet + in_7_bits(crc32(packet), CRC_BYTES)


def crc8(data: bytes) -> int:
    """8-bit CRC with polynomial 07 and initial value 0 (CRC-8/SMBUS), whose low 7 bits end an OLD_REPORT."""
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ (0x07 if crc & 0x80 else 0)) & 0xFF
    return crc


def _speed(share: float) -> int:
    """Speed code of a share of full speed, clipped to [-1, 1]; NaN stops."""
    return STOP + round(STOP * max(-1.0, min(1.0, share))) if share == share else STOP


def _is_valid(packet: bytes) -> bool:
    """True if the check at the end of a whole packet holds."""
    if packet[0] == OLD_REPORT:
        return crc8(packet[:-1]) & 0x7F == packet[-1]
    one, two, three, four, five = packet[-CRC_BYTES:]
    return crc32(packet[:-CRC_BYTES]) == one | two << 7 | three << 14 | four << 21 | five << 28


class PacketDecoder:
    """Stream decoder of our packets, for chunks of any size; discards other bytes."""

    def __init__(self) -> None:
        self.garbage = 0  # bytes discarded so far
        self._buffer = bytearray()

    def feed(self, received: bytes) -> list[bytes]:
        """Packets that these bytes complete, in order."""
        buffer, begin, complete = self._buffer, 0, []
        buffer += received
        while begin < len(buffer):
            length = LENGTHS.get(buffer[begin], 0)
            following = START.search(buffer, begin + 1)
            end = following.start() if following else len(buffer)
            if following is None and end - begin < length:
                break
            if 0 < length <= end - begin and _is_valid(packet := bytes(buffer[begin : begin + length])):
                complete.append(packet)
                end = begin + length
            else:
                self.garbage += end - begin
            begin = end
        del buffer[:begin]
        return complete
