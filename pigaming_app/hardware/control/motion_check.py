"""Motion check: compares the commanded motion of a robot with the motion that the camera observes.

Each wheel is judged separately, in px: its expected travel follows from the commands sent (already clipped by walls
and safety), its true travel from two observed poses. The drivetrain is known only roughly: a wheel may be weaker or
stronger, and act earlier or later, than the model (STRONGEST, WEAK, LATENESS). Motion outside these tolerances is a
mismatch:

- astray: a wheel turns the wrong way, without a command, or much too fast. Causes: swapped lids, reversed or swapped
  motors, a robot that is pushed.
- stuck: a wheel that must turn stands for LONG seconds. Causes: a robot that is held or blocked.
"""

from bisect import bisect_right
from collections import deque
from collections.abc import Iterable, Sequence
from itertools import chain, repeat
from math import cos, exp, inf, pi, sin, tau
from typing import NamedTuple

from pigaming_app.hardware.signals import Fix
from pigaming_app.sim.drivetrain import Drivetrain
from pigaming_app.sim.plant import Twist
from pigaming_app.sim.world import HEIGHT, RADIUS, WIDTH

SHORT, LONG = 0.15, 0.33  # s, windows of comparison: for a robot astray, and for one that is stuck
LATENESS = (-0.03, 0.0, 0.03, 0.07)  # s, tolerated delays on top of the drivetrain's dead time
STRONGEST = 1.5  # tolerated gain of a wheel
SLACK, SHARE = 4.0, 0.2  # px, and share of the faster wheel's travel: errors of poses and wheel base, and slip
UNEVEN = 0.15  # tolerated difference of the wheels, as a share of their travel, with gains estimated by the tracker
KNOWN, AVERAGED = 2.0, 5.0  # s of driving until the difference is known, and over which it is averaged
FAST = 160.0  # px/s of both wheels together, from which it is averaged
AGAINST, SURELY = 4.0, 8.0  # px of a turn against the command, beyond uneven wheels, and its weight
SIDEWAYS = 7.0  # px in SHORT, beyond any motion by wheels
WEAK = 40.0  # px/s, tolerated loss to friction on top of the deadband
CLEAR, STANDS = 8.0, 0.2  # px, least expected travel in LONG, and the share of it below which a wheel is stuck
SOON = 0.08  # s, window of comparison for a robot that leaves the arena
STRONG, NUDGE = 1.3, 3.0  # factor of the commanded outward travel, and px, beyond which a robot leaves by itself
STEADY = 0.6  # share of the greatest expected travel below which the expectation depends too much on the delay
COASTS = 0.3  # s of motion after a stop is decided: dead time of camera and radio, and the motors' lag
EDGES = (((-1.0, 0.0), 0.0), ((1.0, 0.0), WIDTH), ((0.0, -1.0), 0.0), ((0.0, 1.0), HEIGHT))  # outwards, px
SETTLES = 0.3  # s after the first command, before which earlier motion may persist
GAP = 0.2  # s without a pose, after which the history is reset
MEMORY = 1.5  # s of commands
OBEYED = 0.2  # s of clear motion as commanded, after which a robot counts as wired correctly
ALIKE = 100.0  # px/s, difference of wheels up to which the motion of one robot may be that of another: SLACK in SHORT
EASE = 0.5  # s of time astray forgiven per second without a verdict


class MotionMismatch(NamedTuple):
    """Contradiction between a robot's motion and its commands."""

    astray: float = 0.0  # s of motion that no command explains
    stuck: float = 0.0  # s at rest despite a command to move
    leaving: bool = False  # astray and about to leave the arena: stop at once


class WheelTravel(NamedTuple):
    """Cumulative travel of the model's wheels up to a time (s), and of the weakest tolerated wheels, px."""

    time: float
    left: float
    right: float
    weak_left: float
    weak_right: float


class PoseSample(NamedTuple):
    """An observed pose: px, and the unwrapped heading in rad."""

    time: float
    x: float
    y: float
    heading: float


class RobotMotionCheck:
    """The motion check of one robot."""

    def __init__(self, drivetrain: Drivetrain) -> None:
        self.drivetrain = drivetrain
        self.radius = RADIUS  # px, of its body
        self.contradiction = MotionMismatch()
        self._command = (0.0, 0.0)  # px/s of the wheels
        self._speeds = [0.0, 0.0]  # px/s: speeds of the model's wheels
        self._weak_speeds = [0.0, 0.0]
        self._sent: deque[WheelTravel] = deque()
        self._poses: deque[PoseSample] = deque()
        self._delays = self._tolerated(0.0)  # s
        self._ends: list[tuple[float, ...]] = []  # travel at the newest pose, px, for each delay
        self._obeyed = 0.0  # s of clear motion as commanded
        self._alike = -inf  # s, when another robot that had not yet obeyed was last commanded alike
        self._uneven = self._known = 0.0  # mean turn beyond the commanded one, as a share of the travel; s of it
        self._against: list[float] = []  # px turned against the command, for each delay

    @property
    def obeys(self) -> bool:
        """True if it has moved as it alone was commanded since it was last out of sight, or its history was reset."""
        return self._obeyed > OBEYED

    def expect_lateness(self, late: float) -> None:
        """Tolerate a delay that was measured on top of the robot's dead time, s, e.g. of a slow network."""
        self._delays = self._tolerated(late)

    def _tolerated(self, late: float) -> list[float]:
        """Delays by which motion may follow commands, s: those without `late`, and later ones."""
        later = [late + more for more in LATENESS if late + more > LATENESS[-1]]
        return [self.drivetrain.dead_time + more for more in (*LATENESS, *later)]

    def record_command(self, now: float, twist: Twist | None) -> None:
        """Note a command (px/s, rad/s) in force from `now` on; None: motors off."""
        self._roll(now)
        twist = twist or (0.0, 0.0)
        half = 0.5 * self.drivetrain.base * twist[1]
        self._command = twist[0] + half, twist[0] - half

    def compare_commands(self, others: Iterable["RobotMotionCheck"]) -> None:
        """Note whether another robot, whose lid this one may wear, is commanded alike."""
        unproven = [other._command for other in others if other is not self and not other.obeys]
        if any(max(abs(a - b) for a, b in zip(self._command, command, strict=True)) < ALIKE for command in unproven):
            self._alike = self._sent[-1].time

    def record_fix(self, fix: Fix) -> None:
        """Note an observed pose and judge by it."""
        poses = self._poses
        if not self._sent or fix.captured < self._sent[0].time + SETTLES:
            return
        if poses and not 0.0 < fix.captured - poses[-1].time < GAP:
            poses.clear()
            self.contradiction, self._obeyed, self._against = MotionMismatch(), 0.0, []
        heading = fix.heading
        if poses:
            heading = poses[-1].heading + (heading - poses[-1].heading + pi) % tau - pi
        poses.append(PoseSample(fix.captured, fix.x, fix.y, heading))
        while fix.captured - poses[0].time > LONG + 0.15:
            poses.popleft()
        if len(poses) > 2:
            self._judge()

    def forget(self) -> None:
        """Reset the history: the next commands come from elsewhere, or concern other robots."""
        self.contradiction, self._command, self._obeyed = MotionMismatch(), (0.0, 0.0), 0.0
        self._against, self._known = [], 0.0
        self._poses.clear()
        self._sent.clear()

    def _roll(self, now: float) -> None:
        """Advance the model's wheels to `now`."""
        if not self._sent:
            self._speeds, self._weak_speeds = [0.0, 0.0], [0.0, 0.0]
            self._sent.append(WheelTravel(now, 0.0, 0.0, 0.0, 0.0))
            return
        last = self._sent[-1]
        dt = now - last.time
        if dt <= 0.0:
            return
        decay = exp(-dt / self.drivetrain.lag)
        travel = []
        for speeds, weaker in ((self._speeds, 0.0), (self._weak_speeds, WEAK)):
            for wheel, command in enumerate(self._command):
                goal = max(0.0, abs(command) - weaker) * (1.0 if command > 0.0 else -1.0)
                travel.append(goal * dt + (speeds[wheel] - goal) * (1.0 - decay) * self.drivetrain.lag)
                speeds[wheel] = goal + (speeds[wheel] - goal) * decay
        self._sent.append(WheelTravel(now, *(sum(pair) for pair in zip(last[1:], travel, strict=True))))
        while now - self._sent[1].time > MEMORY:
            self._sent.popleft()

    def _judge(self) -> None:
        newest, before = self._poses[-1], self._poses[-2]
        dt, old = newest.time - before.time, self.contradiction
        self._ends = [self._at(newest.time - delay) for delay in self._delays]
        astray = SURELY if self._turns_against(before, newest) else self._astray(self._since(SHORT), newest)
        leaving = self._leaves(self._since(SOON), newest)
        held = self._since(LONG)
        stuck = newest.time - held.time if self._stuck(held, newest) else 0.0
        if astray is not None:
            alone = newest.time - SHORT - self._delays[-1] > self._alike
            self._obeyed = 0.0 if astray else self._obeyed + dt * alone
        seconds = max(0.0, old.astray - EASE * dt) if astray is None else astray and old.astray + astray * dt
        self.contradiction = MotionMismatch(seconds, stuck, leaving)

    def _since(self, seconds: float) -> PoseSample:
        """The newest pose at least `seconds` old."""
        until = self._poses[-1].time - seconds + 1e-6
        return next((pose for pose in reversed(self._poses) if pose.time <= until), self._poses[0])

    def _astray(self, since: PoseSample, now: PoseSample) -> float | None:
        """1 if no tolerated wheel moves like this, else 0; None if hardly any motion was expected or observed."""
        left, right, side = self._travelled(since, now)
        options = self._expected(since)
        longest = max(abs(travel) for option in options for travel in option[:2])
        if max(abs(left), abs(right)) < SLACK and longest < 2.0 * SLACK:
            return None
        slack = SLACK + SHARE * max(longest, 0.5 * abs(left + right))
        for wheel, travel in enumerate((left, right)):
            expected = [option[wheel] for option in options]
            if not STRONGEST * min(0.0, *expected) - slack <= travel <= STRONGEST * max(0.0, *expected) + slack:
                return 1.0
        return float(abs(side) > SIDEWAYS + SHARE * longest)

    def _turns_against(self, before: PoseSample, now: PoseSample) -> bool:
        """True if it has turned against its command by more than uneven wheels explain, whatever its delay.

        A cumulative sum for each delay: every picture adds the turn against the command, at most as much as was
        commanded, and subtracts a turn as commanded.
        """
        left, right, _ = self._travelled(before, now)
        options = self._expected(before)
        known = self._known > KNOWN and abs(self._uneven) < UNEVEN
        turn = left - right - known * self._uneven * (left + right)
        sums = []
        for so_far, (one, other, *_) in zip(chain(self._against, repeat(0.0)), options, strict=False):
            against = min(-turn if one > other else turn, abs(one - other))
            explained = 0.0 if known else UNEVEN * (abs(one) + abs(other))
            sums.append(max(0.0, so_far + against - explained))
        self._against = sums
        self._learn_uneven(left - right, options[1], now.time - before.time)
        return min(sums) > AGAINST

    def _learn_uneven(self, turn: float, expected: Sequence[float], dt: float) -> None:
        """Average how much a robot turns beyond what is expected, as a share of the travel. Turns in px."""
        travel = expected[0] + expected[1]
        if abs(travel) > FAST * dt:
            self._known += dt
            beyond = (turn - expected[0] + expected[1]) / travel
            self._uneven += (beyond - self._uneven) * dt / min(self._known, AVERAGED)

    def _stuck(self, since: PoseSample, now: PoseSample) -> bool:
        """True if a wheel stands although even the weakest tolerated one would have turned."""
        travelled = self._travelled(since, now)
        options = self._expected(since)
        for wheel in (0, 1):
            for sign in (1.0, -1.0):
                weak = [sign * option[2 + wheel] for option in options]
                least = min(*weak, *(sign * option[wheel] for option in options))  # friction also shortens travel back
                if least > max(CLEAR, STEADY * max(weak)) and sign * travelled[wheel] < STANDS * least:
                    return True
        return False

    def _leaves(self, since: PoseSample, now: PoseSample) -> bool:
        """True if it moves out of the arena without a command that explains it, and can hardly stop before the edge."""
        dt = now.time - since.time
        if dt <= 0.0:
            return False
        heading = 0.5 * (since.heading + now.heading)
        options = self._expected(since)[:-1]
        ahead = [0.5 * (left + right) for left, right, *_ in options]
        nudge = NUDGE + 0.5 * UNEVEN * max(abs(left - right) for left, right, *_ in options)  # uneven wheels spin off
        for (out_x, out_y), edge in EDGES:
            gone = out_x * (now.x - since.x) + out_y * (now.y - since.y)
            expected = max(0.0, *((out_x * cos(heading) + out_y * sin(heading)) * travel for travel in ahead))
            over = out_x * now.x + out_y * now.y + self.radius - edge
            if gone > STRONG * expected + nudge and over + COASTS * gone / dt > 0.0:
                return True
        return False

    def _expected(self, since: PoseSample) -> list[tuple[float, float, float, float]]:
        """Expected travel of the wheels, and of the weakest tolerated ones, from a pose to the newest one, px.

        One for each tolerated delay.
        """
        expected = []
        for delay, after in zip(self._delays, self._ends, strict=True):
            before = self._at(since.time - delay)
            expected.append((after[0] - before[0], after[1] - before[1], after[2] - before[2], after[3] - before[3]))
        return expected

    def _travelled(self, since: PoseSample, now: PoseSample) -> tuple[float, float, float]:
        """Travel of both wheels between two poses, and the sideways motion, px."""
        dx, dy, turn = now.x - since.x, now.y - since.y, now.heading - since.heading
        middle = since.heading + 0.5 * turn
        chord = 1.0 if abs(turn) < 1e-3 else 0.5 * turn / sin(0.5 * turn)
        ahead, side = dx * cos(middle) + dy * sin(middle), dy * cos(middle) - dx * sin(middle)
        half = 0.5 * self.drivetrain.base * turn
        return chord * ahead + half, chord * ahead - half, side

    def _at(self, time: float) -> tuple[float, ...]:
        """Cumulative travel at a time, interpolated; constant before the first command."""
        sent = self._sent
        at = bisect_right(sent, (time, inf))
        if at == 0:
            return sent[0][1:]
        if at == len(sent):
            return sent[-1][1:]
        before, after = sent[at - 1], sent[at]
        share = (time - before.time) / (after.time - before.time)
        return (
            before.left + share * (after.left - before.left),
            before.right + share * (after.right - before.right),
            before.weak_left + share * (after.weak_left - before.weak_left),
            before.weak_right + share * (after.weak_right - before.weak_right),
        )
