"""Does a robot do as it is told? The motion that its commands explain is compared with the motion that the camera sees.

Everything is judged wheel by wheel, in px: how far a wheel must have turned follows from the commands really sent, so
walls and safety have clipped them already; how far it has turned, from two sights of the robot. The drivetrain is known
only roughly: a wheel may be weaker or stronger, and hear earlier or later, than the model (GAINS, LATENESS). What no
such wheel does is a contradiction:

- astray: a wheel turns the wrong way, or though it was told to stand, or much too fast. So do swapped lids, reversed
  or swapped motors, and a robot that is pushed.
- stuck: a wheel that must turn for LONG seconds stands. So does a robot that is held, or pushes against something.
"""

from bisect import bisect_right
from collections import deque
from collections.abc import Sequence
from math import cos, exp, pi, sin, tau
from typing import NamedTuple

from pigaming_app.hardware.signals import Fix
from pigaming_app.sim.drivetrain import Drivetrain
from pigaming_app.sim.plant import Twist
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.world import HEIGHT, WIDTH

SHORT, LONG = 0.15, 0.4  # s over which motion is compared: to find a robot astray, and to find it stuck
LATENESS = (-0.03, 0.0, 0.03, 0.07)  # s by which a command may act later than the drivetrain's dead time
STRONGEST = 1.5  # gain of a wheel
SLACK, SHARE = 4.0, 0.2  # px, and share of the way of the faster wheel: errors of sight, of the wheel base, and slip
UNEVEN = 0.15  # share of the ways of both wheels that they may differ by, once the tracker has learnt their gains
SIDEWAYS = 7.0  # px in SHORT: no wheel can do that
WEAK = 40.0  # px/s that friction may take from a wheel, on top of the deadband
CLEAR, STANDS = 8.0, 0.2  # px that a wheel must have turned in LONG, and the share of it below which it is stuck
SOON = 0.08  # s over which it is found to leave the arena
STRONG, NUDGE = 1.3, 3.0  # share of the way outwards that it was told, and px, beyond which it leaves by itself
STEADY = 0.6  # share of what a wheel must have turned at most, below which it depends too much on how late it hears
COASTS = 0.3  # s of motion still to come when a stop is decided: dead time of camera and radio, and the motors' lag
EDGES = (((-1.0, 0.0), 0.0), ((1.0, 0.0), WIDTH), ((0.0, -1.0), 0.0), ((0.0, 1.0), HEIGHT))  # outwards, px
SETTLES = 0.3  # s from the first command until motion can come from it alone
GAP = 0.2  # s without a sight after which motion is judged anew
MEMORY = 1.5  # s for which commands are kept
EASE = 0.5  # of the time astray that is forgiven for every second in which nothing can be judged


class MotionMismatch(NamedTuple):
    """How a robot's motion contradicts its commands."""

    astray: float = 0.0  # s for which it has moved as no command explains
    stuck: float = 0.0  # s for which it has stood though it must have moved
    leaving: bool = False  # astray, and on its way out of the arena: there is no time to wait


class WheelTravel(NamedTuple):
    """Up to a time: how far the model of each wheel has turned (px), and how far the weakest such wheel has."""

    time: float
    left: float
    right: float
    weak_left: float
    weak_right: float


class PoseSample(NamedTuple):
    """Where a robot was seen; the heading without jumps."""

    time: float
    x: float
    y: float
    heading: float


class MotionCheck:
    """Judges all robots by what they are told (`sent`) and where they are seen (`seen`)."""

    def __init__(self, drivetrains: Sequence[Drivetrain]) -> None:
        self._watches = [RobotMotionCheck(one) for one in drivetrains]

    def sent(self, now: float, twists: Sequence[Twist | None]) -> None:
        """The wheels are told from now on what comes to these twists, px/s and rad/s; None: off."""
        for watch, twist in zip(self._watches, twists, strict=True):
            watch.sent(now, twist or (0.0, 0.0))

    def seen(self, fixes: Sequence[Fix]) -> None:
        """The robots were seen here."""
        for fix in fixes:
            self._watches[fix.robot].seen(fix)

    def forget(self, robot: int | None = None) -> None:
        """What follows is commanded by somebody else, or means other robots: judge this one, or all, anew."""
        for watch in self._watches if robot is None else [self._watches[robot]]:
            watch.forget()

    def contradiction(self, robot: int) -> MotionMismatch:
        """How its motion contradicts its commands now."""
        return self._watches[robot].contradiction


class RobotMotionCheck:
    """One robot."""

    def __init__(self, drivetrain: Drivetrain) -> None:
        self.drivetrain = drivetrain
        self.contradiction = MotionMismatch()
        self._told = (0.0, 0.0)  # px/s of the wheels
        self._turning = [0.0, 0.0]  # px/s: the model's wheels, lagged
        self._weak = [0.0, 0.0]
        self._sent: deque[WheelTravel] = deque()
        self._sights: deque[PoseSample] = deque()

    def sent(self, now: float, twist: Twist) -> None:
        """Remember a command; up to now the one before it held."""
        self._roll(now)
        half = 0.5 * self.drivetrain.base * twist[1]
        self._told = twist[0] + half, twist[0] - half

    def seen(self, fix: Fix) -> None:
        """Judge by a new sight."""
        sights = self._sights
        if not self._sent or fix.captured < self._sent[0].time + SETTLES:
            return
        if sights and not 0.0 < fix.captured - sights[-1].time < GAP:
            sights.clear()
            self.contradiction = MotionMismatch()
        heading = fix.heading
        if sights:
            heading = sights[-1].heading + (heading - sights[-1].heading + pi) % tau - pi
        sights.append(PoseSample(fix.captured, fix.x, fix.y, heading))
        while fix.captured - sights[0].time > LONG + 0.15:
            sights.popleft()
        if len(sights) > 2:
            self._judge()

    def forget(self) -> None:
        """Judge anew."""
        self.contradiction, self._told = MotionMismatch(), (0.0, 0.0)
        self._sights.clear()
        self._sent.clear()

    def _roll(self, now: float) -> None:
        """Let the model's wheels turn up to now."""
        if not self._sent:
            self._turning, self._weak = [0.0, 0.0], [0.0, 0.0]
            self._sent.append(WheelTravel(now, 0.0, 0.0, 0.0, 0.0))
            return
        last = self._sent[-1]
        dt = now - last.time
        if dt <= 0.0:
            return
        kept = exp(-dt / self.drivetrain.lag)
        ways = []
        for speeds, weaker in ((self._turning, 0.0), (self._weak, WEAK)):
            for wheel, told in enumerate(self._told):
                goal = max(0.0, abs(told) - weaker) * (1.0 if told > 0.0 else -1.0)
                ways.append(goal * dt + (speeds[wheel] - goal) * (1.0 - kept) * self.drivetrain.lag)
                speeds[wheel] = goal + (speeds[wheel] - goal) * kept
        self._sent.append(WheelTravel(now, *(sum(pair) for pair in zip(last[1:], ways, strict=True))))
        while now - self._sent[1].time > MEMORY:
            self._sent.popleft()

    def _judge(self) -> None:
        newest, before = self._sights[-1], self._sights[-2]
        dt, old = newest.time - before.time, self.contradiction
        astray = self._astray(self._since(SHORT), newest)
        leaving = self._leaves(self._since(SOON), newest)
        held = self._since(LONG)
        stuck = newest.time - held.time if self._stuck(held, newest) else 0.0
        seconds = old.astray + dt if astray else 0.0 if astray is False else max(0.0, old.astray - EASE * dt)
        self.contradiction = MotionMismatch(seconds, stuck, leaving)

    def _since(self, seconds: float) -> PoseSample:
        """The sight that is about so old."""
        until = self._sights[-1].time - seconds + 1e-6
        return next((one for one in reversed(self._sights) if one.time <= until), self._sights[0])

    def _astray(self, since: PoseSample, now: PoseSample) -> bool | None:
        """Whether no wheel as they come goes this way; None: it hardly moved and hardly should have."""
        left, right, side = self._turned(since, now)
        ways = self._told_ways(since, now)
        most = max(abs(one) for way in ways for one in way[:2])
        if max(abs(left), abs(right)) < SLACK and most < 2.0 * SLACK:
            return None
        slack = SLACK + SHARE * max(most, 0.5 * abs(left + right))
        for wheel, way in enumerate((left, right)):
            told = [one[wheel] for one in ways]
            if not STRONGEST * min(0.0, *told) - slack <= way <= STRONGEST * max(0.0, *told) + slack:
                return True
        return abs(side) > SIDEWAYS + SHARE * most or _turned_against(left, right, ways)

    def _stuck(self, since: PoseSample, now: PoseSample) -> bool:
        """Whether a wheel stands that even the weakest would have turned."""
        turned = self._turned(since, now)
        ways = self._told_ways(since, now)
        for wheel in (0, 1):
            for sign in (1.0, -1.0):
                weak = [sign * one[2 + wheel] for one in ways]
                least = min(*weak, *(sign * one[wheel] for one in ways))  # friction can also shorten a way back
                if least > max(CLEAR, STEADY * max(weak)) and sign * turned[wheel] < STANDS * least:
                    return True
        return False

    def _leaves(self, since: PoseSample, now: PoseSample) -> bool:
        """Whether it goes out of the arena, or farther out, as no command explains, and soon could not stop before."""
        dt = now.time - since.time
        if dt <= 0.0:
            return False
        heading = 0.5 * (since.heading + now.heading)
        told_ways = self._told_ways(since, now)[:-1]
        ways = [0.5 * (way[0] + way[1]) for way in told_ways]
        nudge = NUDGE + 0.5 * UNEVEN * max(abs(way[0] - way[1]) for way in told_ways)  # uneven wheels spin off the spot
        for (out_x, out_y), edge in EDGES:
            gone = out_x * (now.x - since.x) + out_y * (now.y - since.y)
            told = max(0.0, *((out_x * cos(heading) + out_y * sin(heading)) * way for way in ways))
            over = out_x * now.x + out_y * now.y + RADIUS - edge
            if gone > STRONG * told + nudge and over + COASTS * gone / dt > 0.0:
                return True
        return False

    def _told_ways(self, since: PoseSample, now: PoseSample) -> list[tuple[float, float, float, float]]:
        """How far the wheels must have turned between two sights, by how late they hear."""
        lates = [self.drivetrain.dead_time + late for late in LATENESS]
        return [self._told_way(since.time - late, now.time - late) for late in lates]

    def _turned(self, since: PoseSample, now: PoseSample) -> tuple[float, float, float]:
        """How far the wheels have turned between two sights, and how far the robot went sideways, px."""
        dx, dy, turn = now.x - since.x, now.y - since.y, now.heading - since.heading
        middle = since.heading + 0.5 * turn
        chord = 1.0 if abs(turn) < 1e-3 else 0.5 * turn / sin(0.5 * turn)
        ahead, side = dx * cos(middle) + dy * sin(middle), dy * cos(middle) - dx * sin(middle)
        half = 0.5 * self.drivetrain.base * turn
        return chord * ahead + half, chord * ahead - half, side

    def _told_way(self, since: float, until: float) -> tuple[float, float, float, float]:
        """How far the model's wheels, and the weakest, turned in this time, px."""
        one, other = self._at(since), self._at(until)
        left, right, weak_left, weak_right = (b - a for a, b in zip(one, other, strict=True))
        return left, right, weak_left, weak_right

    def _at(self, time: float) -> tuple[float, ...]:
        """How far the model's wheels had turned by then; before the first command they stood."""
        sent = self._sent
        at = bisect_right(sent, time, key=lambda one: one.time)
        if at == 0:
            return sent[0][1:]
        if at == len(sent):
            return sent[-1][1:]
        before, after = sent[at - 1], sent[at]
        share = (time - before.time) / (after.time - before.time)
        return tuple(a + share * (b - a) for a, b in zip(before[1:], after[1:], strict=True))


def _turned_against(left: float, right: float, told: Sequence[tuple[float, ...]]) -> bool:
    """Whether it turned the other way than it was told, by far more than uneven wheels can make of that, px."""
    turns = [one[0] - one[1] for one in told]
    least, most = min(turns), max(turns)
    if least * most <= 0.0:
        return False
    sign, clear = (1.0, least) if least > 0.0 else (-1.0, -most)
    uneven = UNEVEN * max(abs(one[0]) + abs(one[1]) for one in told)
    return clear > 2.0 * SLACK and sign * (left - right) < -SLACK - uneven
