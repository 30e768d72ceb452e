"""Protocol of a 3pi with factory firmware (Pololu's serial-slave program) at 115200 baud: for bench tests only.

**The factory firmware has no deadman.** The motors keep their last command when the cable is unplugged, this computer
crashes or the program is killed. The only protection is the link, which sends stop without new commands and at its end.
Put the robot on blocks; for matches use our firmware (hardware/firmware/).
"""

from collections.abc import Mapping, Sequence

from pigaming_app.hardware.radio.protocol import LinkQuality, Misfit
from pigaming_app.hardware.signals import Telemetry, WheelCommand

BAUD = 115200
SIGNATURE, BATTERY = 0x81, 0xB1  # commands; the signature query also stops the motors
FORWARD, BACK = (0xC1, 0xC5), (0xC2, 0xC6)  # commands of the left motor (M1) and the right motor (M2)
FULL = 127  # means speed 255 of 255; any other n means 2n
ASK_EVERY = 0.2  # s between two battery queries
PATIENCE = 0.5  # timeout of a reply, s
NAME = b"3pi"  # prefix of the signature, e.g. 3pi1.1
NAME_LENGTH, BATTERY_LENGTH = 6, 2  # bytes of the replies


def motors(wheels: WheelCommand | None) -> bytes:
    """Commands that set both motors; None: stop."""
    shares = wheels or WheelCommand(0.0, 0.0)
    return b"".join(_motor(*pair) for pair in zip(shares, FORWARD, BACK, strict=True))


def _motor(share: float, forward: int, back: int) -> bytes:
    speed = round(255 * min(1.0, abs(share))) if share == share else 0
    return bytes((back if share < 0 else forward, FULL if speed == 255 else speed // 2))


class StockProtocol:
    """RadioProtocol of the serial-slave program, for the only robot on this line."""

    misfits: Mapping[int, Misfit] = {}
    boards: Mapping[int, int] = {}

    def __init__(self, robot: int = 0) -> None:
        self._robot = robot
        self._telemetry: dict[int, Telemetry] = {}
        self._buffer, self._expected = bytearray(), 0  # bytes received, and length of the expected reply
        self.open(0.0)

    def open(self, now: float) -> bytes:
        """Query the signature, which also stops the motors."""
        self._name = b""
        self._asked = self._answered = now
        self._queries = self._replies = 0  # of the battery
        return self._query(now)

    @property
    def telemetry(self) -> Mapping[int, Telemetry]:
        return self._telemetry

    def command(self, wheels: Sequence[WheelCommand | None], now: float) -> bytes:
        """Commands of both motors, and a periodic query of the battery, or of the signature while it is unknown."""
        asks = now - self._asked >= (ASK_EVERY if self._is_stock else PATIENCE)
        return (self._query(now) if asks else b"") + motors(wheels[self._robot])

    def receive(self, received: bytes, now: float) -> None:
        """Process the reply to the last query; replies carry no type of their own."""
        self._buffer += received
        if len(self._buffer) < self._expected or not self._expected:
            return
        reply, self._expected, self._answered = bytes(self._buffer[: self._expected]), 0, now
        if len(reply) == NAME_LENGTH:
            self._name = reply
        else:
            self._replies += 1
            self._telemetry[self._robot] = Telemetry(self._robot, int.from_bytes(reply, "little") / 1000, 0, now)

    def quality(self, robot: int, now: float) -> LinkQuality:
        """Quality whose share is that of answered battery queries since the line was opened."""
        share = self._replies / self._queries if self._queries and robot == self._robot else 0.0
        return LinkQuality(share, None, None)

    def fault(self, now: float) -> tuple[str, str] | None:
        """A foreign device, or no replies."""
        if self._name and not self._is_stock:
            return "stranger", ascii(self._name.decode("latin-1"))
        return ("mute", "") if now - self._answered > 2 * PATIENCE else None

    @property
    def _is_stock(self) -> bool:
        return self._name.startswith(NAME)

    def _query(self, now: float) -> bytes:
        """Query of the battery, or of the signature while it is unknown."""
        self._asked, self._buffer = now, bytearray()
        self._expected = BATTERY_LENGTH if self._is_stock else NAME_LENGTH
        self._queries += self._is_stock
        return bytes((BATTERY if self._is_stock else SIGNATURE,))
