"""How the link talks to one 3pi as it is sold, with Pololu's serial-slave program, at 115200 baud: for the bench only.

**This program has no deadman.** The motors hold what they were told last, also when the cable is pulled, this computer
dies or the program is killed. The link still sends stop when nobody gives commands, and at its end, but that is all.
Put the robot on blocks; in a match use our own firmware (hardware/firmware/).
"""

from collections.abc import Mapping, Sequence

from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.radio.protocol import LinkQuality
from pigaming_app.hardware.signals import Telemetry, WheelCommand

BAUD = 115200
SIGNATURE, BATTERY = 0x81, 0xB1  # commands; asking for the signature also stops the motors
FORWARD, BACK = (0xC1, 0xC5), (0xC2, 0xC6)  # commands of the left motor, M1, and of the right one, M2
FULL = 127  # means 255 of 255; every other n means 2n
ASK_EVERY = 0.2  # s between two questions for the battery
PATIENCE = 0.5  # s for an answer
NO_DEADMAN = OperatorMessage("radio_stock")
NAME = b"3pi"  # what the signature begins with: 3pi1.1 and the like
NAME_LENGTH, BATTERY_LENGTH = 6, 2  # bytes of the answers


def motors(wheels: WheelCommand | None) -> bytes:
    """The commands that set both motors; None stops them."""
    shares = wheels or WheelCommand(0.0, 0.0)
    return b"".join(_motor(*pair) for pair in zip(shares, FORWARD, BACK, strict=True))


def _motor(share: float, forward: int, back: int) -> bytes:
    speed = round(255 * min(1.0, abs(share))) if share == share else 0
    return bytes((back if share < 0 else forward, FULL if speed == 255 else speed // 2))


class StockProtocol:
    """The dialect of the serial-slave program, for the robot at the other end of this line."""

    def __init__(self, robot: int = 0) -> None:
        self._robot = robot
        self._telemetry: dict[int, Telemetry] = {}
        self._waiting, self._expected = bytearray(), 0  # bytes that came, bytes that an answer will have
        self.open(0.0)

    def open(self, now: float) -> bytes:
        """Stop the motors and ask who is there."""
        self._name = b""
        self._asked = self._answered = now
        self._questions = self._answers = 0  # for and about the battery
        return self._question(now)

    @property
    def telemetry(self) -> Mapping[int, Telemetry]:
        return self._telemetry

    def command(self, wheels: Sequence[WheelCommand | None], now: float) -> bytes:
        """Both motors, and from time to time a question for the battery or, until it is known, the name."""
        asks = now - self._asked >= (ASK_EVERY if self._is_stock else PATIENCE)
        return (self._question(now) if asks else b"") + motors(wheels[self._robot])

    def hear(self, heard: bytes, now: float) -> None:
        """Take in the answer; it carries no mark, so it is known by the question before it."""
        self._waiting += heard
        if len(self._waiting) < self._expected or not self._expected:
            return
        answer, self._expected, self._answered = bytes(self._waiting[: self._expected]), 0, now
        if len(answer) == NAME_LENGTH:
            self._name = answer
        else:
            self._answers += 1
            self._telemetry[self._robot] = Telemetry(self._robot, int.from_bytes(answer, "little") / 1000, 0, now)

    def quality(self, robot: int, now: float) -> LinkQuality:
        """The share is of all questions for the battery since the line was opened."""
        share = self._answers / self._questions if self._questions and robot == self._robot else 0.0
        return LinkQuality(share, None, None)

    def trouble(self, now: float) -> tuple[str, str] | None:
        """Something else answers, or nothing."""
        if self._name and not self._is_stock:
            return "stranger", ascii(self._name.decode("latin-1"))
        return ("mute", "") if now - self._answered > 2 * PATIENCE else None

    @property
    def _is_stock(self) -> bool:
        return self._name.startswith(NAME)

    def _question(self, now: float) -> bytes:
        """Ask for the battery, or for the name as long as it is unknown."""
        self._asked, self._waiting = now, bytearray()
        self._expected = BATTERY_LENGTH if self._is_stock else NAME_LENGTH
        self._questions += self._is_stock
        return bytes((BATTERY if self._is_stock else SIGNATURE,))
