"""Which radio drives which marker: every radio's robot spins in turn, and the marker that turns is its own.

That also shows markers that were swapped, that two robots wear, or that nobody can see. `tick` every 1/50 s until it
says that all is done; `channels` is then what a rig needs, and `findings` what to tell the operator.
"""

from collections.abc import Sequence
from enum import StrEnum
from math import hypot
from typing import NamedTuple

from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.signals import WheelCommand
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.world import DT, ROBOTS

REST, SPIN, BRAKE = 0.6, 1.3, 0.5  # s
SHARE = 0.14  # of full speed, forth and back: about 2.5 rad/s
TURNED = 1.2  # rad that the marker of the robot that spins turns at least
STILL = 0.4  # rad that the others turn at most
ASTRAY = 25.0  # px that a robot may move while it spins
SEEN = 0.3  # s within which a marker must have been seen


class PairingCase(StrEnum):
    """What came of spinning the robot of one radio. The texts are fleet.case_CASE."""

    FITS = "fits"  # the marker has the radio's own number
    SWAPPED = "swapped"  # another marker turned: it is driven by this radio from now on
    NONE = "none"  # no marker turned
    SEVERAL = "several"  # more than one turned
    TWICE = "twice"  # the marker that turned is seen twice, or was another radio's already
    WIRED = "wired"  # a robot turned the other way, or drove off: its motors are not connected as they should be
    ABSENT = "absent"  # nobody was heard at this radio


class PairingFinding(NamedTuple):
    """What came of one radio."""

    channel: int  # the radio, from 0
    marker: int | None
    case: PairingCase


class Pairing:
    """Spins the robots of these radios, by default all that are heard."""

    def __init__(self, rig: Rig, channels: Sequence[int] | None = None) -> None:
        self.rig = rig
        self.findings: list[PairingFinding] = []
        heard = [one for one in range(ROBOTS) if one in rig.link.telemetry]
        self._todo = list(heard if channels is None else channels)
        absent = [one for one in range(ROBOTS) if one not in self._todo]
        self.findings += [PairingFinding(channel, None, PairingCase.ABSENT) for channel in absent if channels is None]
        self._ticks = 0
        self._turned = [0.0] * ROBOTS
        self._doubled: set[int] = set()
        self._before: list[float | None] = [None] * ROBOTS
        self._began: dict[int, tuple[float, float]] = {}  # px: where each robot was when this spin began
        self._astray: int | None = None  # the robot that drives off instead of spinning

    @property
    def spinning(self) -> int | None:
        """The radio whose robot spins now, or is about to; None: all is done."""
        return self._todo[0] if self._todo else None

    @property
    def channels(self) -> tuple[int, ...]:
        """For every marker, the radio that drives it; what was not found keeps the radio that is left."""
        found = {one.marker: one.channel for one in self.findings if one.marker is not None}
        left = [channel for channel in range(ROBOTS) if channel not in found.values()]
        own = [marker for marker in range(ROBOTS) if marker not in found and marker in left]
        found |= {marker: marker for marker in own}
        rest = [channel for channel in left if channel not in own]
        return tuple(found[marker] if marker in found else rest.pop(0) for marker in range(ROBOTS))

    def tick(self) -> bool:
        """1/50 s of it; whether all is done. Then all stand."""
        self.rig.pump()
        if not self._todo:
            return True
        self._ticks += 1
        time = self._ticks * DT
        self._watch(counts=time > REST)
        if self._astray is not None and time < REST + SPIN:
            self._ticks, time = round((REST + SPIN) / DT), REST + SPIN + DT
        self.rig.tell_one(
            self._todo[0], WheelCommand(SHARE, -SHARE) if REST < time <= REST + SPIN else WheelCommand(0.0, 0.0)
        )
        if time >= REST + SPIN + BRAKE:
            self.findings.append(self._judged(self._todo.pop(0)))
            self._ticks, self._turned, self._doubled = 0, [0.0] * ROBOTS, set()
            self._began, self._astray = {}, None
        return not self._todo

    def _watch(self, counts: bool) -> None:
        """Add up how far every marker turns."""
        self._doubled |= self.rig.tracker.doubled()
        for robot, seen in enumerate(self.rig.sense()):
            before, self._before[robot] = self._before[robot], None
            if seen.age < SEEN:
                self._before[robot] = seen.heading
                if counts and before is not None:
                    self._turned[robot] += turn_to(seen.heading - before)
                    x, y = self._began.setdefault(robot, (seen.x, seen.y))
                    if hypot(seen.x - x, seen.y - y) > ASTRAY:
                        self._astray = robot

    def _judged(self, channel: int) -> PairingFinding:
        turned = [robot for robot in range(ROBOTS) if self._turned[robot] > TURNED]
        moved = [robot for robot in range(ROBOTS) if abs(self._turned[robot]) > STILL]
        if self._doubled:
            return PairingFinding(channel, None, PairingCase.TWICE)
        if len(moved) > 1:
            return PairingFinding(channel, None, PairingCase.SEVERAL)
        if self._astray is not None or (moved and not turned):
            return PairingFinding(channel, moved[0] if self._astray is None else self._astray, PairingCase.WIRED)
        if not turned:
            return PairingFinding(channel, None, PairingCase.NONE)
        if turned[0] in [one.marker for one in self.findings]:
            return PairingFinding(channel, None, PairingCase.TWICE)
        return PairingFinding(channel, turned[0], PairingCase.FITS if turned[0] == channel else PairingCase.SWAPPED)
