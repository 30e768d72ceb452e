"""Firmware of an emulated robot: parses drive packets byte by byte, sets the motors, has a deadman, and reports.

Drive: `D0 seq enable L1 R1 L2 R2 L3 R3 L4 R4 chk`, speeds 0..126 with 63 for stop. Telemetry, five times a second:
`D4 addr seq flags mvLo7 mvHi7 chk`. The checksum is a CRC-8 of all bytes before it, without its top bit.
"""

from pigaming_app.hardware.emulator.robots import EmulatedRobot

DRIVE, REPORT = 0xD0, 0xD4
DRIVE_BYTES = 12
MIDDLE = 63
DEADMAN = 0.250  # s
REPORT_EVERY, SLOT = 0.200, 0.010  # s
WARN, STOP = 4.4, 4.0  # V
STOPPED, LOW, EMPTY = 1, 2, 4  # flags


class Firmware:
    """The controller of one robot. `address` is 1 to 4."""

    def __init__(self, robot: EmulatedRobot, address: int) -> None:
        self.robot, self.address = robot, address
        self.mute = False  # True if its reports get lost
        self.last_packet = -1e9  # s, end of the last valid packet
        self.packets = self.rejected = 0
        self._packet = bytearray()
        self._seq = 0
        self._phase = 0.0  # s, start of the report schedule
        self._reported = -1
        self._empty = False  # motors are off until the battery is back at WARN

    @property
    def stopped(self) -> bool:
        """True if both motors are off."""
        return not (self.robot.left or self.robot.right)

    def receive(self, data: bytes, now: float) -> None:
        """Receive bytes from the radio at `now` (s)."""
        if not self.robot.alive:
            return
        for byte in data:
            if byte >= 0x80:
                self._packet.clear()
                if byte == DRIVE:
                    self._packet.append(byte)
            elif self._packet:
                self._packet.append(byte)
                if len(self._packet) == DRIVE_BYTES:
                    self._obey(bytes(self._packet), now)
                    self._packet.clear()

    def tick(self, now: float) -> bytes:
        """Apply the deadman; returns the report due now, or b""."""
        robot = self.robot
        if not robot.alive:
            self.last_packet = -1e9
            return b""
        self._empty = robot.battery < STOP or (self._empty and robot.battery < WARN)
        if now - self.last_packet >= DEADMAN or self._empty:
            robot.left = robot.right = 0.0
        due = int((now - self._phase - SLOT * (self.address - 1)) // REPORT_EVERY)
        if due <= self._reported:
            return b""
        self._reported = due
        return b"" if self.mute else self._report(now)

    def _obey(self, packet: bytes, now: float) -> None:
        if check(packet[:-1]) != packet[-1]:
            self.rejected += 1
            return
        self.packets += 1
        self.last_packet, self._seq = now, packet[1]
        if self._seq % 10 == 0:
            self._phase, self._reported = now, -1
        left, right = packet[1 + 2 * self.address], packet[2 + 2 * self.address]
        enabled = packet[2] >> (self.address - 1) & 1 and not self._empty
        self.robot.left = _share(left) if enabled else 0.0
        self.robot.right = _share(right) if enabled else 0.0

    def _report(self, now: float) -> bytes:
        battery = self.robot.battery
        flags = STOPPED if now - self.last_packet >= DEADMAN else 0
        flags |= (LOW if battery < WARN else 0) | (EMPTY if self._empty else 0)
        millivolts = round(1000 * battery)
        report = bytes([REPORT, self.address, self._seq, flags, millivolts & 0x7F, millivolts >> 7 & 0x7F])
        return report + bytes([check(report)])


def check(packet: bytes) -> int:
    """The lower seven bits of a CRC-8 with the polynomial x^8 + x^2 + x + 1."""
    crc = 0
    for byte in packet:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ 0x07) & 0xFF if crc & 0x80 else crc << 1
    return crc & 0x7F


def _share(speed: int) -> float:
    """Share of full speed, in [-1, 1]."""
    return min(speed, 2 * MIDDLE) / MIDDLE - 1.0
