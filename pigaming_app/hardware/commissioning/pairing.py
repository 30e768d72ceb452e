"""Pairing of radios and markers: each radio's robot spins in turn, and the marker that turns belongs to it.

Pairing also detects swapped, duplicate and invisible markers and miswired motors, and measures the camera's delay. Call
`tick` every 1/50 s until it returns True; then `channels` is the mapping for a rig and `findings` the report for the
operator.
"""

from collections.abc import Sequence
from enum import StrEnum
from math import hypot, inf
from typing import NamedTuple

from pigaming_app.hardware.control.kinematics import spin_share
from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.run_writer import Recorder
from pigaming_app.hardware.signals import Fix, WheelCommand
from pigaming_app.hardware.tracking.motion_delay import motion_delay
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.world import DT, ROBOTS

REST, SPIN, BRAKE = 0.6, 1.3, 0.5  # s
TURNED = 1.2  # rad; a spinning robot's marker turns more than this
STILL = 0.4  # rad; every other marker turns less than this
ASTRAY = 25.0  # px; a robot that moves farther is driving off
SEEN = 0.3  # s, largest age of a usable fix


class PairingCase(StrEnum):
    """Result of spinning one radio's robot. The texts are fleet.case_CASE."""

    FITS = "fits"  # the marker has the radio's own number
    SWAPPED = "swapped"  # another marker turned; this radio drives it from now on
    NONE = "none"  # no marker turned
    SEVERAL = "several"  # more than one turned
    TWICE = "twice"  # the marker is seen twice, or already belongs to another radio
    WIRED = "wired"  # a robot turned the other way or drove off: its motors are miswired
    ABSENT = "absent"  # no telemetry from this radio


class PairingFinding(NamedTuple):
    """Result for one radio."""

    channel: int  # the radio, from 0
    marker: int | None
    case: PairingCase


class Pairing(Recorder):
    """Spins the robots of these radios; by default of all that send telemetry."""

    def __init__(self, rig: Rig, channels: Sequence[int] | None = None) -> None:
        self.rig = rig
        self.findings: list[PairingFinding] = []
        present = [channel for channel in range(ROBOTS) if channel in rig.link.telemetry]
        self._todo = list(present if channels is None else channels)
        absent = [channel for channel in range(ROBOTS) if channel not in self._todo]
        self.findings += [PairingFinding(channel, None, PairingCase.ABSENT) for channel in absent if channels is None]
        self._ticks = 0
        self._turned = [0.0] * ROBOTS
        self._duplicates: set[int] = set()
        self._before: list[float | None] = [None] * ROBOTS
        self._began: dict[int, tuple[float, float]] = {}  # px, positions at the start of this spin
        self._astray: int | None = None  # a robot that drives off instead of spinning
        self._sent: list[tuple[float, float, float]] = []  # s, shares of both wheels, of this spin
        self._seen: list[Fix] = []
        self._delays: dict[int, float] = {}  # s from commands to seen motion without the network's, by robot
        rig.recorder = self

    @property
    def spinning(self) -> int | None:
        """Radio whose robot spins now or next; None once done."""
        return self._todo[0] if self._todo else None

    @property
    def channels(self) -> tuple[int, ...]:
        """Radio of every marker; unpaired markers keep their own radio if free, else get a remaining one."""
        paired = {finding.marker: finding.channel for finding in self.findings if finding.marker is not None}
        left = [channel for channel in range(ROBOTS) if channel not in paired.values()]
        own = [marker for marker in range(ROBOTS) if marker not in paired and marker in left]
        paired |= {marker: marker for marker in own}
        rest = [channel for channel in left if channel not in own]
        return tuple(paired[marker] if marker in paired else rest.pop(0) for marker in range(ROBOTS))

    def tick(self) -> bool:
        """Run 1/50 s; True once done, with all robots stopped."""
        self.rig.pump()
        if not self._todo:
            self.rig.recorder = None
            return True
        self._ticks += 1
        time = self._ticks * DT
        self._watch(counts=time > REST)
        if self._astray is not None and time < REST + SPIN:
            self._ticks, time = round((REST + SPIN) / DT), REST + SPIN + DT
        share = self._share if REST < time <= REST + SPIN else 0.0
        wheels = WheelCommand(share, -share)
        self._sent.append((self.rig.clock(), *wheels))
        self.rig.send_to_channel(self._todo[0], wheels)
        if time >= REST + SPIN + BRAKE:
            self.findings.append(self._classify(self._todo.pop(0)))
            self._ticks, self._turned, self._duplicates = 0, [0.0] * ROBOTS, set()
            self._began, self._astray, self._sent, self._seen = {}, None, [], []
            if not self._todo:
                self.rig.recorder = None
                self.rig.measure_camera_delay(self._delays)
        return not self._todo

    def record_fixes(self, now: float, captured: float, fixes: Sequence[Fix]) -> None:
        self._seen += fixes

    @property
    def _share(self) -> float:
        """Share of full speed of the robot that spins, taken for the one that its radio drove so far."""
        return spin_share(self.rig.kinematics[self.rig.channels.index(self._todo[0])].drivetrain)

    def _measure(self, channel: int, robot: int) -> None:
        """Note how much later than commanded a robot moved."""
        seen = [fix for fix in self._seen if fix.robot == robot]
        fit = motion_delay(self._sent, seen, self.rig.kinematics[robot].drivetrain.base)
        if fit.error < inf:
            self._delays[robot] = fit.seconds - self.rig.network_delay(robot, channel)

    def _watch(self, counts: bool) -> None:
        """Accumulate the turn of every marker."""
        self._duplicates |= self.rig.tracker.duplicates()
        for robot, seen in enumerate(self.rig.sense()):
            before, self._before[robot] = self._before[robot], None
            if seen.age < SEEN:
                self._before[robot] = seen.heading
                if counts and before is not None:
                    self._turned[robot] += turn_to(seen.heading - before)
                    x, y = self._began.setdefault(robot, (seen.x, seen.y))
                    if hypot(seen.x - x, seen.y - y) > ASTRAY:
                        self._astray = robot

    def _classify(self, channel: int) -> PairingFinding:
        turned = [robot for robot in range(ROBOTS) if self._turned[robot] > TURNED]
        moved = [robot for robot in range(ROBOTS) if abs(self._turned[robot]) > STILL]
        if self._duplicates:
            return PairingFinding(channel, None, PairingCase.TWICE)
        if len(moved) > 1:
            return PairingFinding(channel, None, PairingCase.SEVERAL)
        if self._astray is not None or (moved and not turned):
            return PairingFinding(channel, moved[0] if self._astray is None else self._astray, PairingCase.WIRED)
        if not turned:
            return PairingFinding(channel, None, PairingCase.NONE)
        if turned[0] in [finding.marker for finding in self.findings]:
            return PairingFinding(channel, None, PairingCase.TWICE)
        self._measure(channel, turned[0])
        return PairingFinding(channel, turned[0], PairingCase.FITS if turned[0] == channel else PairingCase.SWAPPED)
