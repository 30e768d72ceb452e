"""Encoding and decoding of our radio packets and of the XBee API frames that carry them.

Pure functions and stream decoders, without ports or clocks. In our packets every byte but the first holds 7 bits, so
any byte from 80 (hex) up starts a packet. The frames are those of XBee 802.15.4 (Digi's manual, "API").
"""

import re
from collections.abc import Sequence
from typing import NamedTuple

from pigaming_app.hardware.signals import WheelCommand

ROBOTS = 4
STOP = 63  # the middle of the speed codes 0 to 126
DRIVE, REPORT = 0xD0, 0xD4
LENGTHS = {DRIVE: 3 + 2 * ROBOTS + 1, REPORT: 7}  # bytes, including the check
SEQUENCE = 128  # sequence numbers run from 0 to 127 and wrap

DEADMAN, LOW, EMPTY, RESTARTED = 1, 2, 4, 8  # flags of a report, see RobotReport

BROADCAST = 0xFFFF
DELIMITER, ESCAPE = 0x7E, 0x7D
ESCAPED = frozenset((DELIMITER, ESCAPE, 0x11, 0x13))
ESCAPES = re.compile(rb"\x7d(.?)", re.DOTALL)  # the escaped byte may still be missing at the end of the buffer
LONGEST = 128  # limit of a frame's data, bytes; the longest real frame has 100 bytes of payload after 11 of header


class RobotReport(NamedTuple):
    """Status report of a robot."""

    address: int  # 1 to 4
    seq: int  # sequence number of the last drive packet received
    flags: int  # DEADMAN: stopped by it; LOW battery; EMPTY battery, motors off; RESTARTED by the watchdog
    millivolts: int


class TransmitRequest(NamedTuple):
    """To the radio: transmit `data` to the 16-bit address. Number 0 suppresses the TransmitStatus."""

    number: int
    address: int
    data: bytes
    options: int = 0


class ReceivedPacket(NamedTuple):
    """From the radio: `data` received from the 16-bit address."""

    source: int
    strength: int  # dBm, negative
    options: int
    data: bytes


class TransmitStatus(NamedTuple):
    """From the radio: result of a transmission. 0 success, 1 no acknowledgement, 2 channel never clear, 3 purged."""

    number: int
    status: int


class ATCommand(NamedTuple):
    """To the radio: a two-letter AT command; without a value it queries the parameter."""

    number: int
    command: str
    value: bytes = b""


class ATResponse(NamedTuple):
    """From the radio: result of an AT command. Status 0 is success."""

    number: int
    command: str
    status: int
    value: bytes


class ModemStatus(NamedTuple):
    """From the radio: 0 hardware reset, 1 watchdog reset."""

    status: int


Message = TransmitRequest | ReceivedPacket | TransmitStatus | ATCommand | ATResponse | ModemStatus


def crc8(data: bytes) -> int:
    """8-bit CRC with polynomial 07 and initial value 0 (CRC-8/SMBUS: crc8(b"123456789") is F4)."""
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ (0x07 if crc & 0x80 else 0)) & 0xFF
    return crc


def drive_packet(seq: int, wheels: Sequence[WheelCommand | None]) -> bytes:
    """Broadcast packet for robots 0 to 3, disabled where None or missing. Raises ValueError for a fifth robot."""
    if len(wheels) > ROBOTS:
        raise ValueError(f"{len(wheels)} robots; the packet has room for {ROBOTS}")
    commands = [*wheels, *[None] * (ROBOTS - len(wheels))]
    enabled = sum(1 << robot for robot, command in enumerate(commands) if command is not None)
    speeds = [_speed(share) for command in commands for share in command or (0.0, 0.0)]
    return _checked(bytes((DRIVE, seq % SEQUENCE, enabled, *speeds)))


def report_from(packet: bytes) -> RobotReport:
    """Parse a report packet that a PacketDecoder has validated."""
    return RobotReport(packet[1], packet[2], packet[3], packet[4] | packet[5] << 7)


def _speed(share: float) -> int:
    """Speed code of a share of full speed, clipped to [-1, 1]; NaN stops."""
    return STOP + round(STOP * max(-1.0, min(1.0, share))) if share == share else STOP


def _checked(packet: bytes) -> bytes:
    return packet + bytes((crc8(packet) & 0x7F,))


class PacketDecoder:
    """Stream decoder of our packets, for chunks of any size; discards other bytes."""

    def __init__(self) -> None:
        self.garbage = 0  # bytes discarded so far
        self._buffer = bytearray()

    def feed(self, received: bytes) -> list[bytes]:
        """Packets that these bytes complete, in order."""
        self._buffer += received
        complete = []
        while self._buffer:
            length = LENGTHS.get(self._buffer[0], 0)
            packet = bytes(self._buffer[:length])
            broken = next((at for at, byte in enumerate(packet) if at and byte >= 0x80), 0)
            if length and not broken and len(packet) < length:
                break
            good = length > 0 and not broken and _checked(packet[:-1]) == packet
            if good:
                complete.append(packet)
            else:
                self.garbage += broken or 1
            del self._buffer[: length if good else broken or 1]
        return complete


def frame(data: bytes, escaped: bool) -> bytes:
    """API frame around the data: AP=2 if `escaped`, else AP=1."""
    body = len(data).to_bytes(2, "big") + data + bytes((0xFF - (sum(data) & 0xFF),))
    if escaped:
        body = b"".join(bytes((ESCAPE, byte ^ 0x20)) if byte in ESCAPED else bytes((byte,)) for byte in body)
    return bytes((DELIMITER,)) + body


class FrameDecoder:
    """Stream decoder of API frames, for chunks of any size; discards other bytes.

    With AP=2 a delimiter always starts a frame. With AP=1 it may also be data, so after an invalid frame the search
    resumes right behind its delimiter, and a valid frame inside a broken one is not lost.
    """

    def __init__(self, escaped: bool) -> None:
        self.garbage = 0  # bytes discarded so far
        self._escaped = escaped
        self._buffer = bytearray()

    def feed(self, received: bytes) -> list[bytes]:
        """Data of the frames that these bytes complete, in order."""
        self._buffer += received
        complete = []
        while self._seek():
            end = self._buffer.find(DELIMITER, 1) if self._escaped else -1
            body = self._body(end)
            size = int.from_bytes(body[:2], "big") if len(body) > 1 else 1
            possible = 1 <= size <= LONGEST
            if possible and len(body) < size + 3 and end < 0:
                break
            good = possible and len(body) >= size + 3 and sum(body[2 : size + 3]) & 0xFF == 0xFF
            if good:
                complete.append(body[2 : size + 2])
            else:
                self.garbage += 1
            del self._buffer[: len(frame(complete[-1], self._escaped)) if good else 1]
        return complete

    def _seek(self) -> bool:
        """Discard everything before the first delimiter; True if there is one."""
        start = self._buffer.find(DELIMITER)
        skipped = len(self._buffer) if start < 0 else start
        self.garbage += skipped
        del self._buffer[:skipped]
        return start >= 0

    def _body(self, end: int) -> bytes:
        """Unescaped bytes after the delimiter, up to the next delimiter at `end` if `end` >= 0."""
        if not self._escaped:
            return bytes(self._buffer[1 : LONGEST + 4])
        raw = bytes(self._buffer[1 : end if end >= 0 else None])
        return ESCAPES.sub(lambda escape: bytes(byte ^ 0x20 for byte in escape[1]), raw)


def encode(message: Message) -> bytes:
    """Frame data of the message."""
    match message:
        case TransmitRequest(number, address, data, options):
            return bytes((0x01, number)) + address.to_bytes(2, "big") + bytes((options,)) + data
        case ReceivedPacket(source, strength, options, data):
            return b"\x81" + source.to_bytes(2, "big") + bytes((-strength, options)) + data
        case TransmitStatus(number, status):
            return bytes((0x89, number, status))
        case ATCommand(number, command, value):
            return bytes((0x08, number)) + command.encode("ascii") + value
        case ATResponse(number, command, status, value):
            return bytes((0x88, number)) + command.encode("ascii") + bytes((status,)) + value
        case ModemStatus(status):
            return bytes((0x8A, status))


def decode(data: bytes) -> Message | None:
    """Message in a frame's data; None for unsupported types and for data too short for its type."""
    match data[:1], list(data[1:]):
        case b"\x01", [number, high, low, options, *rest]:
            return TransmitRequest(number, high << 8 | low, bytes(rest), options)
        case b"\x81", [high, low, strength, options, *rest]:
            return ReceivedPacket(high << 8 | low, -strength, options, bytes(rest))
        case b"\x89", [number, status]:
            return TransmitStatus(number, status)
        case b"\x08", [number, _, _, *rest]:
            return ATCommand(number, data[2:4].decode("latin-1"), bytes(rest))
        case b"\x88", [number, _, _, status, *rest]:
            return ATResponse(number, data[2:4].decode("latin-1"), status, bytes(rest))
        case b"\x8a", [status]:
            return ModemStatus(status)
    return None
