"""The link to the robots: sends the newest command 50 times a second and receives telemetry.

`send` puts a command into a mailbox that holds only the newest. Without a new command for 0.1 s the link sends stop,
and whenever it ends it sends stop five times. A RadioProtocol defines the bytes (`xbee_protocol`: our firmware;
`stock_protocol`: a robot with factory firmware). `start()` runs the link in a thread; without it the owner of the clock
calls `pump()`, in real or simulated time.
"""

import atexit
import threading
from collections.abc import Sequence
from typing import TYPE_CHECKING, Self

from pigaming_app.hardware.radio.packets import ROBOTS
from pigaming_app.hardware.radio.protocol import LinkQuality, Misfit, RadioProtocol
from pigaming_app.hardware.radio.serial_line import OpenPort, SerialLine, radio_message
from pigaming_app.hardware.signals import Clock, Telemetry, WheelCommand
from pigaming_app.storage.messages import OperatorMessage

if TYPE_CHECKING:
    from pigaming_app.hardware.radio.wifi import WifiNetwork

BEAT = 0.02  # s between two transmissions, unless a driver declares a lower rate
PATIENCE = 0.1  # s without a new command after which the link sends stop
FAREWELLS = 5  # stop commands sent when the link ends
HEARD = 1.0  # s for which a report counts
RECENT = 0.01  # share of the newest command in the mean of the waits
NOBODY: tuple[WheelCommand | None, ...] = (None,) * ROBOTS


class CommandLink:
    """A link to robots: a mailbox that a thread empties until `close`, and what has come back."""

    network: "WifiNetwork | None" = None  # of robots that have to be found first
    beat = BEAT  # s between two transmissions
    wait = 0.0  # s, recent mean from posting a command to its transmission

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._mail: tuple[float, Sequence[WheelCommand | None]] = (float("-inf"), NOBODY)
        self._thread: threading.Thread | None = None
        self._closing = threading.Event()

    @property
    def telemetry(self) -> dict[int, Telemetry]:
        """Newest telemetry of every robot received so far, by robot."""
        raise NotImplementedError

    @property
    def boards(self) -> dict[int, int]:
        """Board numbers that robots have announced, by robot."""
        return {}

    @property
    def fault(self) -> OperatorMessage | None:
        """Present fault of the link, or None."""
        raise NotImplementedError

    def misfit(self, robot: int) -> Misfit | None:
        """Why a robot that reports cannot be driven; None if it can, or has not reported for a while."""
        return None

    def quality(self, robot: int) -> LinkQuality:
        """Reception quality of a robot."""
        raise NotImplementedError

    def send(self, wheels: Sequence[WheelCommand | None]) -> None:
        """Post the wheel commands of robots 0, 1, ...; None or no entry: stop. Raises ValueError for a fifth entry."""
        if len(wheels) > ROBOTS:
            raise ValueError(f"{len(wheels)} robots; there are at most {ROBOTS}")
        self._mail = self._clock(), (*wheels, *NOBODY[len(wheels) :])

    def pace(self, rate: float) -> None:
        """Send so many commands a second from here on."""
        self.beat = 1.0 / rate

    def pump(self) -> None:
        """Read, and send every `beat` s. Never blocks, never raises."""
        raise NotImplementedError

    def start(self) -> Self:
        """Run in a thread until close(); needs a real-time clock."""
        self._thread = threading.Thread(target=self._run, name="link", daemon=True)
        atexit.register(self.close)
        self._thread.start()
        return self

    def close(self) -> None:
        """Send stop five times and close the line. Idempotent."""
        if self._closing.is_set():
            return
        self._closing.set()
        if self._thread is None:
            self._shut_down()
        else:
            atexit.unregister(self.close)
            self._thread.join(timeout=1.0)  # the thread may hang in opening a port

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def _dead(self) -> bool:
        """True if the thread has ended by an error."""
        return self._thread is not None and not self._thread.is_alive() and not self._closing.is_set()

    @property
    def _pause(self) -> float:
        """Time until the next `pump`, s."""
        return BEAT

    def _run(self) -> None:
        try:
            while not self._closing.wait(self._pause):
                self.pump()
        finally:
            self._shut_down()

    def _shut_down(self) -> None:
        """Send stop, and close the line."""
        raise NotImplementedError


class Link(CommandLink):
    """Connection to the robots over a serial line; a context manager."""

    def __init__(
        self, open_port: OpenPort, clock: Clock, protocol: RadioProtocol, name: str = "the serial port"
    ) -> None:
        super().__init__(clock)
        self._line = SerialLine(open_port, clock, name)
        self._protocol = protocol
        self.wait = 0.75 * BEAT
        self._posted = float("-inf")  # s, when the last command transmitted was posted
        self._due = float("-inf")  # s, time of the next transmission
        self._listened = float("-inf")  # s, time of the last read; silence since then is not the radio's fault

    @property
    def telemetry(self) -> dict[int, Telemetry]:
        return dict(self._protocol.telemetry)

    def misfit(self, robot: int) -> Misfit | None:
        """See CommandLink.

        A robot of another arena is no misfit while the robot of this arena with the same number reports.
        """
        misfit, report = self._protocol.misfits.get(robot), self._protocol.telemetry.get(robot)
        if misfit is None or self._clock() - misfit.received > HEARD:
            return None
        return None if report is not None and self._clock() - report.received <= HEARD else misfit

    @property
    def boards(self) -> dict[int, int]:
        return dict(self._protocol.boards)

    def quality(self, robot: int) -> LinkQuality:
        return self._protocol.quality(robot, self._clock())

    @property
    def fault(self) -> OperatorMessage | None:
        if self._dead:
            return radio_message("program", self._line.name)
        if self._line.fault is not None or not self._line.is_open:
            return self._line.fault
        fault = self._protocol.fault(self._listened)
        return radio_message(fault[0], self._line.name, fault[1]) if fault else None

    def pump(self) -> None:
        """Open the line if necessary, read, and send when due. Never blocks, never raises."""
        if self._closing.is_set():
            return
        if self._line.open():
            self._line.write(self._protocol.open(self._clock()))
        now = self._clock()
        self._protocol.receive(self._line.read(), now)
        self._listened = now
        if now >= self._due:
            self._due = self._due + self.beat if now < self._due + self.beat else now + self.beat
            posted, wheels = self._mail
            if posted > self._posted:
                self._posted = posted
                self.wait += RECENT * (now - posted - self.wait)
            self._line.write(self._protocol.command(wheels if now - posted <= PATIENCE else NOBODY, now))

    @property
    def _pause(self) -> float:
        return max(0.0, min(BEAT, self._due - self._clock()))

    def _shut_down(self) -> None:
        for _ in range(FAREWELLS):
            self._line.write(self._protocol.command(NOBODY, self._clock()))
        self._line.close()
