"""The serial side of an XBee 802.15.4 radio, as its manual has it: API frames, plain or escaped.

Written from HARDWARE.md's tables, and for the emulator alone: what the arcade sends must be understood by somebody who
does not share its code.
"""

START, ESCAPE = 0x7E, 0x7D
ESCAPED = (0x7E, 0x7D, 0x11, 0x13)
TX16, AT, RX16, AT_ANSWER, TX_STATUS = 0x01, 0x08, 0x81, 0x88, 0x89
BROADCAST = 0xFFFF
LONGEST = 110  # bytes of a frame that the radio still takes


def framed(data: bytes, escaped: bool) -> bytes:
    """A frame around data, ready for the line."""
    plain = len(data).to_bytes(2, "big") + data + bytes([0xFF - (sum(data) & 0xFF)])
    if not escaped:
        return bytes([START]) + plain
    out = bytearray([START])
    for byte in plain:
        out += bytes([ESCAPE, byte ^ 0x20]) if byte in ESCAPED else bytes([byte])
    return bytes(out)


class FrameReceiver:
    """Hears bytes one by one and gives the data of each frame whose checksum is right."""

    def __init__(self, escaped: bool) -> None:
        self.escaped = escaped
        self.broken = 0  # frames with a wrong checksum or length
        self._bytes: bytearray | None = None
        self._next_escaped = False

    def hear(self, byte: int) -> bytes | None:
        """The data of the frame that ends with this byte, or None."""
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

    def _ended(self, heard: bytearray) -> bytes | None:
        if len(heard) < 2:
            return None
        length = heard[0] * 256 + heard[1]
        if not 0 < length <= LONGEST:
            self._bytes, self.broken = None, self.broken + 1
            return None
        if len(heard) < length + 3:
            return None
        self._bytes = None
        if sum(heard[2:]) & 0xFF != 0xFF:
            self.broken += 1
            return None
        return bytes(heard[2:-1])
