"""What goes over the air and over the wire to the radio, as bytes: our packets, and the XBee API frames round them.

Only functions and decoders of bytes; nothing here opens a port or knows the time. Our packets hold 7 bits in every byte
but the first, so that any byte from 80 on begins anew. The frames are those of XBee 802.15.4 (Digi's manual, "API").
"""

import re
from collections.abc import Sequence
from typing import NamedTuple

from pigaming_app.hardware.signals import WheelCommand

ROBOTS = 4
STOP = 63  # the middle of the speeds 0 to 126
DRIVE, REPORT = 0xD0, 0xD4
LENGTHS = {DRIVE: 3 + 2 * ROBOTS + 1, REPORT: 7}  # bytes, the check included
SEQUENCE = 128  # sequence numbers count from 0 to 127 and begin again

DEADMAN, LOW, EMPTY, RESTARTED = 1, 2, 4, 8  # what the flags of a report mean: see Report

BROADCAST = 0xFFFF
DELIMITER, ESCAPE = 0x7E, 0x7D
ESCAPED = frozenset((DELIMITER, ESCAPE, 0x11, 0x13))
ESCAPES = re.compile(rb"\x7d(.?)", re.DOTALL)  # at the end of what has come, the escaped byte may be missing
LONGEST = 128  # bytes of a frame's data; the longest that comes holds 100 bytes from the air and 11 before them


class RobotReport(NamedTuple):
    """What a robot says of itself."""

    address: int  # 1 to 4
    seq: int  # of the drive packet that it heard last
    flags: int  # DEADMAN stopped it; battery LOW; battery EMPTY, motors refused; RESTARTED by its watchdog
    millivolts: int


class TransmitRequest(NamedTuple):
    """To the radio: send this to the 16-bit address. With number 0 the radio does not say how it went."""

    number: int
    address: int
    data: bytes
    options: int = 0


class ReceivedPacket(NamedTuple):
    """From the radio: this came from the 16-bit address."""

    source: int
    strength: int  # dBm, negative
    options: int
    data: bytes


class TransmitStatus(NamedTuple):
    """From the radio: how sending went. 0 well, 1 nobody acknowledged, 2 the air was never free, 3 purged."""

    number: int
    status: int


class ATCommand(NamedTuple):
    """To the radio: an AT command of two letters; without a value it asks for the value."""

    number: int
    command: str
    value: bytes = b""


class ATResponse(NamedTuple):
    """From the radio: what became of an AT command. Status 0 is well."""

    number: int
    command: str
    status: int
    value: bytes


class ModemStatus(NamedTuple):
    """From the radio: what happened to it. 0 it started, 1 its watchdog restarted it."""

    status: int


Message = TransmitRequest | ReceivedPacket | TransmitStatus | ATCommand | ATResponse | ModemStatus


def crc8(data: bytes) -> int:
    """The CRC of 8 bits with polynomial 07, starting from 0 (CRC-8/SMBUS: crc8(b"123456789") is F4)."""
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ (0x07 if crc & 0x80 else 0)) & 0xFF
    return crc


def drive_packet(seq: int, wheels: Sequence[WheelCommand | None]) -> bytes:
    """The broadcast for the robots 0 to 3; those without an entry are off. Raises ValueError for a fifth robot."""
    if len(wheels) > ROBOTS:
        raise ValueError(f"{len(wheels)} robots; the packet has room for {ROBOTS}")
    everyone = [*wheels, *[None] * (ROBOTS - len(wheels))]
    enabled = sum(1 << robot for robot, one in enumerate(everyone) if one is not None)
    speeds = [_speed(share) for one in everyone for share in one or (0.0, 0.0)]
    return _checked(bytes((DRIVE, seq % SEQUENCE, enabled, *speeds)))


def report_from(packet: bytes) -> RobotReport:
    """What a report says that a PacketDecoder found good."""
    return RobotReport(packet[1], packet[2], packet[3], packet[4] | packet[5] << 7)


def _speed(share: float) -> int:
    """The byte for a share of full speed in [-1, 1]; beyond is cut, what is no number stops."""
    return STOP + round(STOP * max(-1.0, min(1.0, share))) if share == share else STOP


def _checked(packet: bytes) -> bytes:
    return packet + bytes((crc8(packet) & 0x7F,))


class PacketDecoder:
    """Finds our packets in what comes, in pieces of any size, and throws away whatever else stands between them."""

    def __init__(self) -> None:
        self.garbage = 0  # bytes thrown away so far
        self._line = bytearray()

    def feed(self, heard: bytes) -> list[bytes]:
        """The packets that these bytes complete, in their order."""
        self._line += heard
        found = []
        while self._line:
            length = LENGTHS.get(self._line[0], 0)
            packet = bytes(self._line[:length])
            broken = next((at for at, byte in enumerate(packet) if at and byte >= 0x80), 0)
            if length and not broken and len(packet) < length:
                break
            good = length > 0 and not broken and _checked(packet[:-1]) == packet
            if good:
                found.append(packet)
            else:
                self.garbage += broken or 1
            del self._line[: length if good else broken or 1]
        return found


def frame(data: bytes, escaped: bool) -> bytes:
    """An API frame round the data: AP=2 if `escaped`, else AP=1."""
    body = len(data).to_bytes(2, "big") + data + bytes((0xFF - (sum(data) & 0xFF),))
    if escaped:
        body = b"".join(bytes((ESCAPE, byte ^ 0x20)) if byte in ESCAPED else bytes((byte,)) for byte in body)
    return bytes((DELIMITER,)) + body


class FrameDecoder:
    """Finds API frames in what comes, in pieces of any size, and throws away whatever else stands between them.

    With AP=2 a delimiter always begins a frame. With AP=1 it may also be data, so after a frame that turns out to be
    none the search goes on right behind its delimiter: a frame swallowed by a broken one is still found.
    """

    def __init__(self, escaped: bool) -> None:
        self.garbage = 0  # bytes thrown away so far
        self._escaped = escaped
        self._line = bytearray()

    def feed(self, heard: bytes) -> list[bytes]:
        """The data of the frames that these bytes complete, in their order."""
        self._line += heard
        found = []
        while self._seek():
            end = self._line.find(DELIMITER, 1) if self._escaped else -1
            body = self._body(end)
            size = int.from_bytes(body[:2], "big") if len(body) > 1 else 1
            possible = 1 <= size <= LONGEST
            if possible and len(body) < size + 3 and end < 0:
                break
            good = possible and len(body) >= size + 3 and sum(body[2 : size + 3]) & 0xFF == 0xFF
            if good:
                found.append(body[2 : size + 2])
            else:
                self.garbage += 1
            del self._line[: len(frame(found[-1], self._escaped)) if good else 1]
        return found

    def _seek(self) -> bool:
        """Whether there is a delimiter; what stands before it is thrown away."""
        start = self._line.find(DELIMITER)
        passed = len(self._line) if start < 0 else start
        self.garbage += passed
        del self._line[:passed]
        return start >= 0

    def _body(self, end: int) -> bytes:
        """What follows the delimiter, up to the next one at `end` if that is 0 or more, as it was before escaping."""
        if not self._escaped:
            return bytes(self._line[1 : LONGEST + 4])
        raw = bytes(self._line[1 : end if end >= 0 else None])
        return ESCAPES.sub(lambda escape: bytes(byte ^ 0x20 for byte in escape[1]), raw)


def encode(message: Message) -> bytes:
    """The message as the data of a frame."""
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
    """What a frame's data says; None for a kind that is not ours or data too short for its kind."""
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
