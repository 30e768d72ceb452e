"""Conformance of a driver: each promise tried on a stand, in simulated time.

Robots are driven by the link alone, without the safety of a match: what is measured here is what stops them when
everything else has failed.
"""

from collections.abc import Iterator, Sequence
from math import inf
from random import Random
from statistics import median
from typing import NamedTuple

from pigaming_app.hardware.drivers.driver import LONGEST_SILENCE, RobotDriver
from pigaming_app.hardware.drivers.stand import RobotStand
from pigaming_app.hardware.radio.link import BEAT
from pigaming_app.hardware.signals import WheelCommand

SLICE = 0.002  # s
SETTLE, FOUND = 1.0, 6.0  # s: for steady speeds; until all robots report
TRIES = 6  # of each measurement in time
AHEAD, TURN, REST = WheelCommand(0.6, 0.6), WheelCommand(0.6, -0.6), WheelCommand(0.0, 0.0)
STEPS = (0.2, 0.4, 0.6, 0.8, 1.0)  # shares of full speed
STANDING = 0.02  # share of full speed up to which a wheel stands
STEADY = 0.12  # error of a speed, as a share of full speed
TOLERANCE = 0.015  # s, error of the declared dead time
LOSS, DRIVEN, UNINTERRUPTED = 0.3, 8.0, 0.99  # share of what is lost; s; share of that time under power
REPORTED = 0.9  # share of reports that must arrive
NEVER = 2.0  # s after which a robot counts as one that does not stop


class Finding(NamedTuple):
    """A promise, what was declared and measured, and whether it holds; None: it could not be tried."""

    promise: str
    declared: str
    measured: str
    holds: bool | None


class Conformance:
    """A run over a driver's promises."""

    def __init__(self, driver: RobotDriver, stand: RobotStand, seed: int = 1) -> None:
        self.driver, self.stand, self._random = driver, stand, Random(f"conformance {seed}")
        self._everybody = range(stand.robots)
        self._beat = 1.0 / driver.rate
        stand.link.pace(driver.rate)

    def run(self) -> Iterator[Finding]:
        """Try each promise in turn. The stand is of no use afterwards: the last one closes the link."""
        found = self._reports()
        yield found
        if not found.holds:
            return
        yield from (self._dead_time(), self._steps(), self._stop(), self._silence(), self._loss())
        yield from (self._restart(), self._other_arcade(), self._end())

    def falls_silent(self) -> bool:
        """Whether all robots report, drive, and stop by themselves as declared, and in time for matches."""
        return self._reports().holds is True and self._silence().holds is True

    def _reports(self) -> Finding:
        """Telemetry of every robot."""
        self._drive(FOUND, REST)
        link = self.stand.link
        shares = [link.quality(robot).share if robot in link.telemetry else 0.0 for robot in self._everybody]
        good = sum(share >= REPORTED for share in shares)
        every = self.stand.robots
        return Finding("reports", f"of {every} robots", f"of {good}, {100 * min(shares):.0f} %", good == every)

    def _dead_time(self) -> Finding:
        times = [time for _ in range(TRIES) for time in self._reaction(AHEAD, True)]
        found, declared = median(times), self.driver.dead_time
        told = f"{_ms(declared)}, at {self.driver.rate:g} commands a second"
        fits = abs(found - self.driver.delay) <= TOLERANCE and max(times) < declared + self._beat + 2.0 * TOLERANCE
        return Finding("dead time", told, f"{_ms(found)}, at most {_ms(max(times))}", fits)

    def _steps(self) -> Finding:
        """Speeds ahead, back and in turns follow the command."""
        worst = 0.0
        for left, right in (*((step, step) for step in STEPS), (-0.6, -0.6), TURN, (-0.3, 0.8)):
            self._drive(SETTLE, WheelCommand(left, right))
            for robot in self._everybody:
                seen = self.stand.speeds(robot)
                worst = max(worst, abs(seen.left - left), abs(seen.right - right))
        self._rest()
        return Finding("steps", f"within {100 * STEADY:.0f} %", f"within {100 * worst:.0f} %", worst <= STEADY)

    def _stop(self) -> Finding:
        """A commanded stop."""
        latest = max(time for _ in range(TRIES) for time in self._reaction(REST, False))
        longest = self.driver.dead_time + self._beat + 2.0 * TOLERANCE
        return Finding("stop", f"within {_ms(longest)}", _ms(latest), latest <= longest)

    def _silence(self) -> Finding:
        """The robots stop by themselves when the computer falls silent."""
        own, latest = self.driver.silence, 0.0
        declared = f"{_ms(own) if own else 'never'}, by {self.driver.stopped_by}"
        for _ in range(TRIES):
            self._drive(SETTLE + self._random.random() * self._beat, self._random.choice((AHEAD, TURN)))
            if not all(map(self.stand.powered, self._everybody)):
                return Finding("silence", declared, "not tried: they do not drive", False)
            latest = max(latest, *self._until_off(pumped=False))
        promised = LONGEST_SILENCE if own is None else own + self.driver.dead_time + self._beat
        holds = own is not None and latest <= min(promised, LONGEST_SILENCE)
        return Finding("silence", declared, _ms(latest) if latest < NEVER else "never", holds)

    def _loss(self) -> Finding:
        """A lossy radio does not make the robots stutter."""
        self._drive(SETTLE, AHEAD)
        self.stand.lose(LOSS)
        powered = steps = 0
        for _ in self._passing(DRIVEN, AHEAD):
            powered += sum(map(self.stand.powered, self._everybody))
            steps += self.stand.robots
        self.stand.lose(0.0)
        self._rest()
        share = powered / steps
        return Finding(
            f"loss of {100 * LOSS:.0f} %", "they drive on", f"{100 * share:.1f} % of the time", share >= UNINTERRUPTED
        )

    def _restart(self) -> Finding:
        """A robot that was off does not drive on by itself, and obeys again."""
        self._drive(SETTLE, AHEAD)
        self.stand.switch(0, False)
        self._drive(SETTLE, AHEAD)
        self._drive(SETTLE, REST)
        self.stand.switch(0, True)
        alone = any(self.stand.powered(0) for _ in self._passing(2.0 * SETTLE, REST, pumped=False))
        self._drive(FOUND, AHEAD)
        obeys = self.stand.powered(0)
        self._rest()
        told = "it drives by itself" if alone else "it stands, and obeys again" if obeys else "it does not obey again"
        return Finding("restart", "it stands, and obeys again", told, obeys and not alone)

    def _other_arcade(self) -> Finding:
        """Another arcade moves nobody, and does not stop those that drive."""
        moved = stopped = 0
        tried = self.stand.interfere(TURN)
        for ours in (REST, AHEAD):
            self._drive(SETTLE, ours)
            for number, _ in enumerate(self._passing(2.0 * SETTLE, ours)):
                if number % round(BEAT / SLICE) == 0:
                    self.stand.interfere(TURN)
                for robot in self._everybody:
                    moved += ours is REST and self.stand.powered(robot)
                    stopped += ours is AHEAD and min(self.stand.speeds(robot)) < 0.5 * AHEAD.left
        self._rest()
        told = "not tried" if not tried else "it moves them" if moved else "it stops them" if stopped else "no effect"
        return Finding("two arcades", "no effect", told, None if not tried else not (moved or stopped))

    def _end(self) -> Finding:
        """The end of the program."""
        self._drive(SETTLE, AHEAD)
        self.stand.link.close()
        latest = max(self._until_off(pumped=False))
        return Finding("end of the program", f"within {_ms(LONGEST_SILENCE)}", _ms(latest), latest <= LONGEST_SILENCE)

    def _reaction(self, wheels: WheelCommand, on: bool) -> list[float]:
        """Seconds until each robot obeys a command for all, sent at a random phase of the link's beat."""
        self._drive(SETTLE + self._random.random() * self._beat, REST if on else AHEAD)
        began, times = self.stand.clock(), [inf] * self.stand.robots
        for _ in self._passing(0.5 * SETTLE, wheels):
            for robot in self._everybody:
                if self.stand.powered(robot) == on:
                    times[robot] = min(times[robot], self.stand.clock() - began)
        self._rest()
        return times

    def _until_off(self, pumped: bool) -> list[float]:
        """Seconds from now until the motors of each robot are off for good."""
        began, last = self.stand.clock(), [0.0] * self.stand.robots
        for _ in self._passing(NEVER, AHEAD, pumped):
            for robot in self._everybody:
                if self.stand.powered(robot):
                    last[robot] = self.stand.clock() - began
        return last

    def _rest(self) -> None:
        self._drive(SETTLE, REST)

    def _drive(self, seconds: float, wheels: WheelCommand) -> None:
        for _ in self._passing(seconds, wheels):
            pass

    def _passing(self, seconds: float, wheels: WheelCommand, pumped: bool = True) -> Iterator[None]:
        """Let time pass in slices; while `pumped`, the link runs and gets this command for all robots."""
        stand, end = self.stand, self.stand.clock() + seconds - 0.5 * SLICE
        commands: Sequence[WheelCommand] = [wheels] * stand.robots
        while stand.clock() < end:
            if pumped:
                stand.link.send(commands)
                stand.link.pump()
            stand.advance(SLICE)
            yield


def _ms(seconds: float) -> str:
    return f"{1000 * seconds:.0f} ms"
