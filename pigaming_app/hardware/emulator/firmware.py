"""Firmware of an emulated robot: parses drive packets byte by byte, sets the motors, has a deadman, and reports.

Drive: `D1 arenaLo7 arenaHi7 seq enable L1 R1 L2 R2 L3 R3 L4 R4 crc0..crc4`, speeds 0..126 with 63 for stop. Telemetry,
five times a second: `D5 arenaLo7 arenaHi7 addr version seq flags mvLo7 mvHi7 crc0..crc4`. The check is the CRC-32 of
all bytes before it in five 7-bit bytes, low first. A packet of another arena, or with the sequence number of the one
before it, is ignored. With version 1 the robot has the former firmware: `D0 seq enable L1 .. R4 chk` and
`D4 addr seq flags mvLo7 mvHi7 chk`, checked by the lower seven bits of a CRC-8.
"""

import re
from typing import NamedTuple

from pigaming_app.hardware.emulator.robots import EmulatedRobot

MIDDLE = 63
DEADMAN = 0.250  # s
REPORT_EVERY, SLOT = 0.200, 0.010  # s
STOPPED, LOW, EMPTY = 1, 2, 4  # flags


class Packets(NamedTuple):
    """Layout of the packets of one version."""

    drive: int  # first byte
    report: int
    length: int  # of a drive packet, bytes
    check: int  # bytes of them for the check


PARTS = re.compile(rb"[\x80-\xff][\x00-\x7f]*|[\x00-\x7f]+")  # from each first byte of a packet on
LAYOUTS = {1: Packets(0xD0, 0xD4, 12, 1), 2: Packets(0xD1, 0xD5, 18, 5)}


class Firmware:
    """The controller of one robot. `address` is 1 to 4, `arena` its arena id or 0, `warn` and `stop` limits in V."""

    def __init__(
        self, robot: EmulatedRobot, address: int, arena: int, version: int = 2, warn: float = 4.4, stop: float = 4.0
    ) -> None:
        self.robot, self.address, self.arena, self.version = robot, address, arena, version
        self.warn, self.stop = warn, stop
        self.mute = False  # True if its reports get lost
        self.last_packet = -1e9  # s, end of the last packet obeyed
        self.packets = self.rejected = self.ignored = 0
        self._packet = bytearray()
        self._seq: int | None = None  # of the last packet obeyed
        self._phase = 0.0  # s, start of the report schedule
        self._reported = -1
        self._empty = False  # motors are off until the battery is back at `warn`

    @property
    def stopped(self) -> bool:
        """True if both motors are off."""
        return not (self.robot.left or self.robot.right)

    def receive(self, data: bytes, now: float) -> None:
        """Receive bytes from the radio at `now` (s)."""
        if not self.robot.alive:
            return
        layout = LAYOUTS[self.version]
        for part in PARTS.findall(data):
            if part[0] >= 0x80:
                self._packet.clear()
            if self._packet or part[0] == layout.drive:
                self._packet += part
                if len(self._packet) >= layout.length:
                    self._obey(bytes(self._packet[: layout.length]), now)
                    self._packet.clear()

    def tick(self, now: float) -> bytes:
        """Apply the deadman; returns the report due now, or b""."""
        robot = self.robot
        if not robot.alive:
            self.last_packet, self._seq = -1e9, None
            return b""
        self._empty = robot.battery < self.stop or (self._empty and robot.battery < self.warn)
        if now - self.last_packet >= DEADMAN or self._empty:
            robot.left = robot.right = 0.0
        due = int((now - self._phase - SLOT * (self.address - 1)) // REPORT_EVERY)
        if due <= self._reported:
            return b""
        self._reported = due
        return b"" if self.mute else self._report(now)

    def _obey(self, packet: bytes, now: float) -> None:
        if self._check(packet[: -LAYOUTS[self.version].check]) != packet[-LAYOUTS[self.version].check :]:
            self.rejected += 1
            return
        arena, seq, enable, speeds = packet[1] + packet[2] * 128, packet[3], packet[4], packet[5:13]
        if self.version == 1:
            arena, seq, enable, speeds = self.arena, packet[1], packet[2], packet[3:11]
        if self.version > 1 and (arena != self.arena or arena == 0 or seq == self._seq):
            self.ignored += 1
            return
        self.packets += 1
        self.last_packet, self._seq = now, seq
        if seq % 10 == 0:
            self._phase, self._reported = now, -1
        left, right = speeds[2 * self.address - 2 : 2 * self.address]
        enabled = enable >> (self.address - 1) & 1 and not self._empty
        self.robot.left = _share(left) if enabled else 0.0
        self.robot.right = _share(right) if enabled else 0.0

    def _report(self, now: float) -> bytes:
        battery, layout = self.robot.battery, LAYOUTS[self.version]
        flags = STOPPED if now - self.last_packet >= DEADMAN else 0
        flags |= (LOW if battery < self.warn else 0) | (EMPTY if self._empty else 0)
        millivolts = round(1000 * battery)
        state = [self._seq or 0, flags, millivolts & 0x7F, millivolts >> 7 & 0x7F]
        place = (
            [self.address] if self.version == 1 else [self.arena & 0x7F, self.arena >> 7, self.address, self.version]
        )
        report = bytes([layout.report, *place, *state])
        return report + self._check(report)

    def _check(self, packet: bytes) -> bytes:
        return old_check(packet) if self.version == 1 else check(packet)


def _step(crc: int) -> int:
    """A CRC-32 after eight more bits, all zero."""
    for _ in range(8):
        crc = crc >> 1 ^ 0xEDB88320 if crc & 1 else crc >> 1
    return crc


STEPS = [_step(byte) for byte in range(256)]


def check(packet: bytes) -> bytes:
    """The CRC-32 of Ethernet in five 7-bit bytes, low first."""
    crc = 0xFFFFFFFF
    for byte in packet:
        crc = crc >> 8 ^ STEPS[(crc ^ byte) & 0xFF]
    crc ^= 0xFFFFFFFF
    return bytes([crc & 0x7F, crc >> 7 & 0x7F, crc >> 14 & 0x7F, crc >> 21 & 0x7F, crc >> 28])


def old_check(packet: bytes) -> bytes:
    """The lower seven bits of a CRC-8 with the polynomial x^8 + x^2 + x + 1."""
    crc = 0
    for byte in packet:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ 0x07) & 0xFF if crc & 0x80 else crc << 1
    return bytes([crc & 0x7F])


def _share(speed: int) -> float:
    """Share of full speed, in [-1, 1]."""
    return min(speed, 2 * MIDDLE) / MIDDLE - 1.0
