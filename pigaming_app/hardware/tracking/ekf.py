"""One robot, followed: its pose at the newest correction, what its wheels make of commands, and the commands since.

An extended Kalman filter over the pose and the five numbers of `WheelCorrection`: wheels differ from robot to robot
and with their batteries, and a prediction over 80 ms of dead time depends on it.
"""

from collections import deque
from collections.abc import Iterator, Sequence
from math import cos, hypot, inf, pi, sin, tau

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.control.motion_model import MotionState, WheelCorrection
from pigaming_app.hardware.signals import Fix
from pigaming_app.sim.angles import wrap
from pigaming_app.sim.drivetrain import Drivetrain
from pigaming_app.sim.plant import Sighting, Twist

FASTEST = 1000.0  # mm/s: a 3pi flat out
LEEWAY = 30.0  # mm by which a marker may be further than that (HARDWARE.md)
PATIENCE = 3  # sights elsewhere that agree with each other, after which the robot is believed to be there
MEMORY = 2.0  # s for which commands are kept
COAST = 1.0  # s for which a robot that is not seen is predicted; then it takes PATIENCE sights to believe again
STEP = 0.02  # s, the longest step of a prediction
NEVER = 1e9  # s since a robot was seen that never was

FIX_PX, FIX_RAD = 0.6, 0.008  # noise of a fix, standard deviations
SLIP_PX, SLIP_RAD = 6.0, 0.1  # what the model does not know of: random walk, per root of a second
NUMBERS = 8  # in the filter
START = np.diag(np.square([FIX_PX, FIX_PX, FIX_RAD, 0.1, 0.1, 0.1, 0.02, 20.0]))
WALK = np.diag(np.square([SLIP_PX, SLIP_PX, SLIP_RAD, 0.005, 0.005, 0.005, 0.001, 0.5]))  # per second
NEW = WheelCorrection(1.0, 1.0, 1.0, 0.0, 0.0)
LOW, HIGH = WheelCorrection(0.6, 0.6, 0.6, -0.06, -30.0), WheelCorrection(1.4, 1.4, 1.4, 0.12, 60.0)
SURPRISE = 36.0  # squared standard deviations: beyond, it was pushed or lifted, which teaches nothing about wheels
STUCK = 0.4  # of the way or turn that was predicted, below which it does not do as it is told
CLEAR_PX, CLEAR_RAD = 1.5, 0.03  # ways and turns from which that can be said
UNTAUGHT = 0.25  # s after such a surprise in which nothing is learnt
NOISE = np.diag(np.square([FIX_PX, FIX_PX, FIX_RAD]))

Matrix = NDArray[np.float64]


class PoseFilter:
    """The filter of one robot; `mm` of the mat to an arena px."""

    def __init__(self, drivetrain: Drivetrain, mm: float) -> None:
        self.drivetrain, self.mm = drivetrain, mm
        self._told: deque[tuple[float, float, float]] = deque()  # when it was sent, wheels in px/s
        self._rolling = MotionState(0.0, 0.0, 0.0)
        self.wear = NEW
        self._spread = START.copy()
        self._seen = self._surprised = -inf
        self._elsewhere: list[Fix] = []  # where it was seen and not believed

    def told(self, time: float, twist: Twist) -> None:
        """Remember what was sent to the robot."""
        turn = 0.5 * self.drivetrain.base * twist[1]
        self._told.append((time, twist[0] + turn, twist[0] - turn))
        oldest = min(max(self._seen, time - MEMORY), time) - self.drivetrain.dead_time - HIGH.late
        while len(self._told) > 1 and self._told[1][0] <= oldest:
            self._told.popleft()

    def unseen(self, now: float) -> float:
        """Seconds since it was seen and believed; NEVER if it never was."""
        return min(now - self._seen, NEVER)

    def at(self, now: float) -> Sighting:
        """Where it is at a time, by the commands sent since it was seen."""
        return self.along((now,))[0]

    def along(self, times: Sequence[float]) -> list[Sighting]:
        """Where it is at these times (s, in rising order): one prediction that goes on from each to the next."""
        rolling, at, found = self._rolling.copy(), self._seen, []
        for time in times:
            if self._seen > -inf:
                until = min(time, self._seen + COAST)
                for left, right, dt in self._acting(at, until):
                    rolling.roll(left, right, self.wear, self.drivetrain.base, self.drivetrain.lag, dt)
                at = max(at, until)
            found.append(Sighting(rolling.x, rolling.y, wrap(rolling.heading % tau), self.unseen(time)))
        return found

    def correct(self, fix: Fix) -> bool:
        """Take in where the camera saw it; false if that is not believed."""
        dt = fix.captured - self._seen
        if dt == inf:
            self._begin(fix)
            return True
        if dt <= 0.0:
            return False
        if dt > COAST:
            return self._again(fix)
        rolling = self._rolling.copy()
        flow = self._predict(rolling, fix.captured)
        if hypot(fix.x - rolling.x, fix.y - rolling.y) * self.mm > FASTEST * dt + LEEWAY:
            return self._again(fix)
        self._elsewhere.clear()
        if _stuck(self._rolling, rolling, fix):
            self._surprised = fix.captured
        self._seen, self._rolling = fix.captured, rolling
        self._blend(fix, flow @ self._spread @ flow.T + WALK * dt)
        return True

    def _acting(self, since: float, until: float) -> Iterator[tuple[float, float, float]]:
        """What the wheels were told in this time (px/s, px/s) and for how long: steps of at most STEP."""
        dead, told = self.drivetrain.dead_time + self.wear.late, self._told
        at = since
        for i in range(-1, len(told)):
            left, right = told[i][1:] if i >= 0 else (0.0, 0.0)
            end = min(told[i + 1][0] + dead, until) if i + 1 < len(told) else until
            while at < end - 1e-9:
                dt = min(STEP, end - at)
                yield left, right, dt
                at += dt

    def _predict(self, rolling: MotionState, until: float) -> Matrix:
        """Move it to a time; how the numbers of the filter there depend on those of the newest correction."""
        rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        for row in rows:
            row += [0.0] * len(self.wear)
        for left, right, dt in self._acting(self._seen, until):
            before = rolling.copy()
            rolling.roll(left, right, self.wear, self.drivetrain.base, self.drivetrain.lag, dt)
            self._step(rows, before, rolling, dt)
        flow = np.eye(NUMBERS)
        flow[:3] = rows
        return flow

    def _step(self, rows: list[list[float]], before: MotionState, after: MotionState, dt: float) -> None:
        """Take a step, to first order in `dt`, into how x, y and heading depend on the numbers before."""
        wear, way = self.wear, 0.5 * dt
        left, right = way * (before.left + after.left), way * (before.right + after.right)
        faster_left, faster_right = wear.left * (after.left - before.left), wear.right * (after.right - before.right)
        stuck_left, stuck_right = wear.left * after.left_way * dt, wear.right * after.right_way * dt
        ahead = (left, right, 0.0, -faster_left - faster_right, -stuck_left - stuck_right)
        turn = (left, -right, 0.0, faster_right - faster_left, stuck_right - stuck_left)
        c, s, t = 0.5 * cos(before.heading), 0.5 * sin(before.heading), wear.turning / self.drivetrain.base
        dx, dy = after.x - before.x, after.y - before.y
        x, y, heading = rows
        for i in range(2, NUMBERS):
            x[i] -= dy * heading[i]
            y[i] += dx * heading[i]
        for i, (forward, sideways) in enumerate(zip(ahead, turn, strict=True), 3):
            x[i] += c * forward
            y[i] += s * forward
            heading[i] += t * sideways
        heading[5] += (after.heading - before.heading) / wear.turning

    def _begin(self, fix: Fix) -> None:
        """It is there, standing; what was learnt about its wheels stays."""
        self._rolling, self._seen = MotionState(fix.x, fix.y, fix.heading), fix.captured
        self._forget_pose()
        self._elsewhere.clear()

    def _again(self, fix: Fix) -> bool:
        """It was seen where it cannot have driven: believed the third time that it is about there, else not."""
        if self._elsewhere:
            last = self._elsewhere[-1]
            way = hypot(fix.x - last.x, fix.y - last.y) * self.mm
            if way > FASTEST * (fix.captured - last.captured) + LEEWAY:
                self._elsewhere.clear()
        self._elsewhere.append(fix)
        if len(self._elsewhere) < PATIENCE:
            return False
        self._begin(fix)
        return True

    def _blend(self, fix: Fix, spread: Matrix) -> None:
        """Kalman's correction; one that surprises too much moves the pose only."""
        rolling = self._rolling
        turned = _turn_to(rolling.heading, fix.heading)
        miss = np.array((fix.x - rolling.x, fix.y - rolling.y, turned))
        doubt = np.linalg.inv(spread[:3, :3] + NOISE)
        if miss @ doubt @ miss > SURPRISE:
            self._surprised = fix.captured
        if fix.captured - self._surprised < UNTAUGHT:
            rolling.x, rolling.y, rolling.heading = fix.x, fix.y, rolling.heading + turned
            self._forget_pose()
            return
        share = spread[:, :3] @ doubt
        change = share @ miss
        x, y, heading = change[:3].tolist()
        rolling.x, rolling.y, rolling.heading = rolling.x + x, rolling.y + y, rolling.heading + heading
        self.wear = WheelCorrection(*np.clip(change[3:] + self.wear, LOW, HIGH).tolist())
        self._spread = spread - share @ spread[:3, :]

    def _forget_pose(self) -> None:
        """What is known of the pose is the newest fix, and nothing that ties it to the wheels."""
        self._spread[:3, :], self._spread[:, :3] = 0.0, 0.0
        self._spread[:3, :3] = NOISE


def _stuck(before: MotionState, predicted: MotionState, fix: Fix) -> bool:
    """Whether a robot went or turned much less than predicted: it is blocked, held, empty, or does not hear."""
    dx, dy = predicted.x - before.x, predicted.y - before.y
    turn = predicted.heading - before.heading
    way = hypot(dx, dy)
    went = (fix.x - before.x) * dx + (fix.y - before.y) * dy
    turned = _turn_to(before.heading, fix.heading)
    return (way > CLEAR_PX and went < STUCK * way * way) or (abs(turn) > CLEAR_RAD and turned / turn < STUCK)


def _turn_to(heading: float, other: float) -> float:
    """The turn from one heading to another, the short way round."""
    return (other - heading + pi) % tau - pi
