"""Encoding and decoding of the API frames of XBee 802.15.4 radios (Digi's manual, "API").

Pure functions and a stream decoder, without ports or clocks.
"""

import re
from typing import NamedTuple

CHANNELS = range(0x0B, 0x1B)  # of an XBee; an XBee-PRO takes 0C to 17
BROADCAST = 0xFFFF
DELIMITER, ESCAPE = 0x7E, 0x7D
ESCAPED = frozenset((DELIMITER, ESCAPE, 0x11, 0x13))
ESCAPES = re.compile(rb"\x7d(.?)", re.DOTALL)  # the escaped byte may still be missing at the end of the buffer
LONGEST = 128  # limit of a frame's data, bytes; the longest real frame has 100 bytes of payload after 11 of header


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
