"""The link to the robots: the newest command goes out 50 times a second, and what they say comes in.

Whoever drives puts a command into the mailbox; only the newest counts. When none came for a tenth of a second, the link
sends stop by itself, and when it ends, for whatever reason, it sends stop five times. What the bytes look like is the
dialect's affair (`air`: our robots; `stock`: a robot as it is sold). `start()` runs the link in a thread; without it,
whoever calls `pump()` often enough runs all of it, in any time the clock tells.
"""

import atexit
import threading
from collections.abc import Sequence
from typing import Self

from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.radio.packets import ROBOTS
from pigaming_app.hardware.radio.protocol import LinkQuality, RadioProtocol
from pigaming_app.hardware.radio.serial_line import OpenPort, SerialLine, radio_message
from pigaming_app.hardware.radio.xbee_protocol import XBeeProtocol
from pigaming_app.hardware.signals import Clock, Telemetry, WheelCommand

BEAT = 0.02  # s between two commands on the air
PATIENCE = 0.1  # s without a new command until the link sends stop
FAREWELLS = 5  # stops that are sent at the end
NOBODY: tuple[WheelCommand | None, ...] = (None,) * ROBOTS


class Link:
    """The robots at the other end of a serial line. Use it in a `with`, or close it."""

    def __init__(
        self, open_port: OpenPort, clock: Clock, dialect: RadioProtocol | None = None, name: str = "the serial port"
    ) -> None:
        self._line = SerialLine(open_port, clock, name)
        self._dialect = dialect or XBeeProtocol()
        self._clock = clock
        self._mail: tuple[float, Sequence[WheelCommand | None]] = (float("-inf"), NOBODY)
        self._due = float("-inf")  # s, when to send again
        self._listened = float("-inf")  # s: silence since then is this computer's, not the radio's
        self._thread: threading.Thread | None = None
        self._closing = threading.Event()

    def send(self, wheels: Sequence[WheelCommand | None]) -> None:
        """Tell the robots 0, 1, ... what to do from now on; None, or no entry, stops. Raises ValueError for a fifth."""
        if len(wheels) > ROBOTS:
            raise ValueError(f"{len(wheels)} robots; there are at most {ROBOTS}")
        self._mail = self._clock(), (*wheels, *NOBODY[len(wheels) :])

    @property
    def telemetry(self) -> dict[int, Telemetry]:
        """What every robot that was ever heard said last, by robot."""
        return dict(self._dialect.telemetry)

    def quality(self, robot: int) -> LinkQuality:
        """How well a robot is heard."""
        return self._dialect.quality(robot, self._clock())

    @property
    def trouble(self) -> OperatorMessage | None:
        """What is wrong with the link; None if nothing is."""
        if self._thread is not None and not self._thread.is_alive() and not self._closing.is_set():
            return radio_message("program", self._line.name)
        if self._line.trouble is not None or not self._line.is_open:
            return self._line.trouble
        told = self._dialect.trouble(self._listened)
        return radio_message(told[0], self._line.name, told[1]) if told else None

    def pump(self) -> None:
        """Open the line if need be, take in what came, and send if the time has come. Never waits, never raises."""
        if self._closing.is_set():
            return
        if self._line.open():
            self._line.write(self._dialect.open(self._clock()))
        now = self._clock()
        self._dialect.hear(self._line.read(), now)
        self._listened = now
        if now >= self._due:
            self._due = self._due + BEAT if now < self._due + BEAT else now + BEAT
            posted, wheels = self._mail
            self._line.write(self._dialect.command(wheels if now - posted <= PATIENCE else NOBODY, now))

    def start(self) -> Self:
        """Run in a thread of its own until close(); the clock must be one of real time."""
        self._thread = threading.Thread(target=self._run, name="link", daemon=True)
        atexit.register(self.close)
        self._thread.start()
        return self

    def close(self) -> None:
        """Stop all robots, five times, and close the line. May be called again."""
        if self._closing.is_set():
            return
        self._closing.set()
        if self._thread is None:
            self._part()
        else:
            atexit.unregister(self.close)
            self._thread.join(timeout=1.0)  # longer only if the system is stuck in opening a port

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _run(self) -> None:
        try:
            while not self._closing.wait(max(0.0, min(BEAT, self._due - self._clock()))):
                self.pump()
        finally:
            self._part()

    def _part(self) -> None:
        for _ in range(FAREWELLS):
            self._line.write(self._dialect.command(NOBODY, self._clock()))
        self._line.close()
