"""Robots that obey lines of text at 115200 baud, and their emulation for `robots check lines`.

`2 -500 1000` drives the wheels of robot 2, in thousandths of full speed; `2 4950` is its report in mV, five times a
second. A robot stops by itself 200 ms after its last line.
"""

from collections import deque
from collections.abc import Mapping, Sequence
from random import Random

from pigaming_app.api.robots import Link, LinkQuality, LinkSite, Misfit, RobotDriver, Telemetry, WheelCommand

BAUD, ROBOTS = 115200, 4
SILENCE, REPORT, DELAY, STEP = 0.2, 0.2, 0.01, 0.002  # s
KNOWN = 2.0  # s over which reports are counted


class Lines:
    """A RadioProtocol: commands to lines, and lines to telemetry."""

    misfits: Mapping[int, Misfit] = {}
    boards: Mapping[int, int] = {}

    def __init__(self) -> None:
        self.telemetry: dict[int, Telemetry] = {}
        self._times = [deque[float](maxlen=round(KNOWN / REPORT)) for _ in range(ROBOTS)]
        self._rest, self._heard = b"", 0.0

    def open(self, now: float) -> bytes:
        self._rest, self._heard = b"", now
        return b"\n"

    def command(self, wheels: Sequence[WheelCommand | None], now: float) -> bytes:
        shares = [each or WheelCommand(0.0, 0.0) for each in wheels]
        return b"".join(b"%d %d %d\n" % (i, 1000 * left, 1000 * right) for i, (left, right) in enumerate(shares, 1))

    def receive(self, received: bytes, now: float) -> None:
        *lines, self._rest = (self._rest + received).split(b"\n")
        for line in lines:
            match line.split():
                case [robot, volts] if robot.isdigit() and volts.isdigit() and 1 <= int(robot) <= ROBOTS:
                    number, self._heard = int(robot) - 1, now
                    self.telemetry[number] = Telemetry(number, int(volts) / 1000, 0, now)
                    self._times[number].append(now)

    def quality(self, robot: int, now: float) -> LinkQuality:
        lately = sum(now - time < KNOWN for time in self._times[robot])
        return LinkQuality(lately * REPORT / KNOWN, None, None)

    def fault(self, now: float) -> tuple[str, str] | None:
        return ("mute", "") if now - self._heard > 1.0 else None


def connect(site: LinkSite) -> Link:
    """The link over the serial port of the settings."""
    assert site.open_port is not None
    return Link(site.open_port(BAUD), site.clock, Lines(), site.port)


class Emulated:
    """The emulated robots and their serial line: a RobotStand and a SerialPort."""

    robots = ROBOTS

    def __init__(self, seed: int) -> None:
        self._now, self._loss, self._random = 0.0, 0.0, Random(seed)
        self._lines: deque[tuple[float, bytes]] = deque()  # on their way to the robots
        self._reports, self._due = b"", [REPORT * i / ROBOTS for i in range(ROBOTS)]
        self._driven = [float("-inf")] * ROBOTS  # s, time of each robot's last line
        self._shares = [WheelCommand(0.0, 0.0)] * ROBOTS
        self._on = [True] * ROBOTS
        self.link = connect(LinkSite(1, self.clock, "emulated", open_port=lambda _: lambda: self))

    def clock(self) -> float:
        return self._now

    def advance(self, seconds: float) -> None:
        for _ in range(round(seconds / STEP)):
            self._now += STEP
            while self._lines and self._lines[0][0] <= self._now:
                self._obey(self._lines.popleft()[1])
            for robot in range(ROBOTS):
                if self._now - self._driven[robot] >= SILENCE or not self._on[robot]:
                    self._shares[robot] = WheelCommand(0.0, 0.0)
                if self._now >= self._due[robot]:
                    self._due[robot] += REPORT
                    if self._on[robot] and not self._lost():
                        self._reports += b"%d 4950\n" % (robot + 1)

    def _obey(self, line: bytes) -> None:
        robot, left, right = (int(word) for word in line.split())
        if self._on[robot - 1]:
            self._driven[robot - 1] = self._now
            self._shares[robot - 1] = WheelCommand(left / 1000, right / 1000)

    def _lost(self) -> bool:
        return self._random.random() < self._loss

    def powered(self, robot: int) -> bool:
        return any(self._shares[robot])

    def speeds(self, robot: int) -> WheelCommand:
        return self._shares[robot]

    def lose(self, share: float) -> None:
        self._loss = share

    def switch(self, robot: int, on: bool) -> None:
        self._on[robot] = on

    def interfere(self, wheels: WheelCommand) -> bool:
        return False  # it is a cable

    @property
    def in_waiting(self) -> int:
        return len(self._reports)

    def read(self, size: int = 1) -> bytes:
        data, self._reports = self._reports[:size], self._reports[size:]
        return data

    def write(self, data: bytes) -> int:
        self._lines.extend((self._now + DELAY, line) for line in data.split(b"\n") if line and not self._lost())
        return len(data)

    def close(self) -> None:
        pass


DRIVER = RobotDriver(
    name="lines",
    title="Lines of text",
    open=connect,
    silence=SILENCE,
    stopped_by="a timer of the robot",
    dead_time=0.02,
    stand=Emulated,
)
