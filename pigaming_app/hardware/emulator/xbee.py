"""An XBee 802.15.4 radio (Series 1): its parameters, AT commands, and API frames, plain or escaped, as in its manual.

An independent implementation for the emulator alone, so that the arcade's frames are checked by code it does not share.
"""

from collections import deque
from typing import Self

from pigaming_app.hardware.signals import Clock

START, ESCAPE = 0x7E, 0x7D
ESCAPED = (0x7E, 0x7D, 0x11, 0x13)
TX16, AT, RX16, AT_ANSWER, TX_STATUS = 0x01, 0x08, 0x81, 0x88, 0x89
BROADCAST = 0xFFFF
LONGEST = 110  # bytes, maximum length of a frame
OK, ERROR, UNKNOWN, REFUSED = 0, 1, 2, 3  # status of an AT command
PARAMETERS = {  # lowest and highest value, bytes of an answer
    b"CH": (0x0B, 0x1A, 1),
    b"ID": (0, 0xFFFF, 2),
    b"MY": (0, 0xFFFF, 2),
    b"DH": (0, 0xFFFFFFFF, 4),
    b"DL": (0, 0xFFFFFFFF, 4),
    b"AP": (0, 2, 1),
    b"BD": (0, 7, 4),
}
MEASURED = {b"DB": b"\x28", b"VR": b"\x10\xec"}
RATES = (1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200)  # baud, by BD
GUARD = 1.0  # s of silence before and after +++
LINGER = 10.0  # s without a command that end the command mode


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


class Module:
    """Parameters of one XBee: in force, as `values`, and kept without power, as `saved`."""

    def __init__(self, mode: int, address: int, baud: int = 57600, top_channel: int = 0x1A) -> None:
        self.values = {b"CH": 0x0C, b"ID": 0x3332, b"MY": address, b"DH": 0, b"DL": 0, b"AP": mode}
        self.values[b"BD"] = RATES.index(baud) if baud in RATES else 6
        self.saved = dict(self.values)
        self.top_channel = top_channel  # 17 (hex) for an XBee-PRO

    @property
    def network(self) -> tuple[int, int]:
        """Channel and PAN."""
        return self.values[b"CH"], self.values[b"ID"]

    def command(self, name: bytes, given: bytes) -> tuple[int, bytes]:
        """Status and value of an AT command; `given` is big-endian, empty in a query."""
        if name == b"WR":
            self.saved = dict(self.values)
            return OK, b""
        if name in MEASURED:
            return OK, MEASURED[name]
        if name in (b"AC", b"CN"):
            return OK, b""
        if name not in PARAMETERS:
            return UNKNOWN, b""
        lowest, highest, size = PARAMETERS[name]
        if not given:
            return OK, self.values[name].to_bytes(size, "big")
        value = int.from_bytes(given, "big")
        if not lowest <= value <= (self.top_channel if name == b"CH" else highest):
            return REFUSED, b""
        self.values[name] = value
        return OK, b""

    def power_up(self) -> None:
        """Restore the saved parameters."""
        self.values = dict(self.saved)


class EmulatedCarrier:
    """A module on a USB carrier, a SerialPort: AT commands by API frames, or as text after +++ where AP is 0.

    `open` gives the port a baud rate; at another one than the module's it answers nothing.
    """

    def __init__(self, module: Module, clock: Clock) -> None:
        self.module, self.clock = module, clock
        self._baud = 0
        self._mode, self._rate = module.values[b"AP"], module.values[b"BD"]  # in force
        self._out: deque[int] = deque()
        self._text = bytearray()
        self._last = float("-inf")  # s, time of the last byte written
        self._plus = self._quiet = False  # +++ has come, after silence
        self._commanding: float | None = None  # s, time of the last text command; None outside the command mode
        self._receiver = FrameReceiver(self._mode == 2)

    def open(self, baud: int = 57600) -> Self:
        """Open the port."""
        self._baud = baud
        self._text.clear()
        return self

    @property
    def in_waiting(self) -> int:
        """Bytes to read."""
        if self._plus and self.clock() - self._last >= GUARD:
            self._plus, self._commanding = False, self.clock()
            self._text.clear()
            self._out += b"OK\r"
        return len(self._out)

    def read(self, size: int = 1) -> bytes:
        """Read at most `size` bytes without blocking."""
        return bytes(self._out.popleft() for _ in range(min(size, self.in_waiting)))

    def write(self, data: bytes) -> int:
        """Write bytes to the module."""
        now = self.clock()
        if self._baud == RATES[self._rate]:
            if self._commanding is not None and now - self._commanding > LINGER:
                self._leave()
            for byte in data:
                self._take(byte, now)
        return len(data)

    def close(self) -> None:
        """No effect: the module stays powered."""

    def _take(self, byte: int, now: float) -> None:
        if self._commanding is not None:
            self._text.append(byte)
            if byte == 13:
                self._say(bytes(self._text[:-1]), now)
                self._text.clear()
        elif self._mode:
            frame = self._receiver.feed(byte)
            if frame and frame[0] == AT and len(frame) >= 4:
                status, value = self.module.command(frame[2:4], frame[4:])
                self._out += framed(bytes([AT_ANSWER, frame[1], *frame[2:4], status]) + value, self._mode == 2)
                self._apply()
        else:
            if now - self._last >= GUARD:
                self._text.clear()
                self._quiet = True
            self._text.append(byte)
            self._plus = self._quiet and self._text == b"+++"
            self._quiet = self._quiet and b"+++".startswith(bytes(self._text))
        self._last = now

    def _say(self, line: bytes, now: float) -> None:
        """Execute a text command, such as ATCHC or ATWR."""
        self._commanding = now
        digits = line[4:].strip()
        known = (
            line[:2].upper() == b"AT" and len(line) >= 4 and all(digit in b"0123456789ABCDEFabcdef" for digit in digits)
        )
        given = int(digits, 16).to_bytes(8, "big") if known and digits else b""
        status, value = self.module.command(line[2:4].upper(), given) if known else (ERROR, b"")
        answer = b"%X" % int.from_bytes(value, "big") if value else b"OK"
        self._out += (answer if status == OK else b"ERROR") + b"\r"
        if line[2:4].upper() in (b"CN", b"AC"):
            self._apply()
        if line[2:4].upper() == b"CN":
            self._leave()

    def _leave(self) -> None:
        """End the command mode; all parameters come into force."""
        self._commanding = None
        self._text.clear()
        self._apply()

    def _apply(self) -> None:
        mode, self._rate = self.module.values[b"AP"], self.module.values[b"BD"]
        if mode != self._mode:
            self._mode, self._receiver = mode, FrameReceiver(mode == 2)
