"""Serial protocol of an XBee 802.15.4 radio: API frames, plain or escaped, as in its manual.

An independent implementation for the emulator alone, so that the arcade's frames are checked by code it does not share.
"""

START, ESCAPE = 0x7E, 0x7D
ESCAPED = (0x7E, 0x7D, 0x11, 0x13)
TX16, AT, RX16, AT_ANSWER, TX_STATUS = 0x01, 0x08, 0x81, 0x88, 0x89
BROADCAST = 0xFFFF
LONGEST = 110  # bytes, maximum length of a frame


def framed(data: bytes, escaped: bool) -> bytes:
    """Frame data for the serial line."""
    plain = len(data).to_bytes(2, "big") + data + bytes([0xFF - (sum(data) & 0xFF)])
    if not escaped:
        return bytes([START]) + plain
    out = bytearray([START])
    for byte in plain:
        out += bytes([ESCAPE, byte ^ 0x20]) if byte in ESCAPED else bytes([byte])
    return bytes(out)


class FrameReceiver:
    """Parses bytes one by one and returns the data of each frame with a valid checksum."""

    def __init__(self, escaped: bool) -> None:
        self.escaped = escaped
        self.broken = 0  # frames with a wrong checksum or length
        self._bytes: bytearray | None = None
        self._next_escaped = False

    def feed(self, byte: int) -> bytes | None:
        """Parse a byte; the data of a frame that ends with it, or None."""
        if byte == START and (self.escaped or self._bytes is None):
            self._bytes, self._next_escaped = bytearray(), False
            return None
        if self._bytes is None:
            return None
        if self.escaped and byte == ESCAPE and not self._next_escaped:
            self._next_escaped = True
            return None
        self._bytes.append(byte ^ 0x20 if self._next_escaped else byte)
        self._next_escaped = False
        return self._ended(self._bytes)

    def _ended(self, frame: bytearray) -> bytes | None:
        if len(frame) < 2:
            return None
        length = frame[0] * 256 + frame[1]
        if not 0 < length <= LONGEST:
            self._bytes, self.broken = None, self.broken + 1
            return None
        if len(frame) < length + 3:
            return None
        self._bytes = None
        if sum(frame[2:]) & 0xFF != 0xFF:
            self.broken += 1
            return None
        return bytes(frame[2:-1])
