"""Extended Kalman filter of one robot: its pose and the five parameters of its `WheelCorrection`.

Wheels differ between robots and with battery voltage, and the prediction over 80 ms of dead time depends on them. The
filter keeps the pose at the newest correction and the commands sent since.
"""

from collections import deque
from collections.abc import Iterator, Sequence
from math import cos, hypot, inf, pi, sin, tau

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.signals import Fix
from pigaming_app.hardware.tracking.motion_model import MotionState, WheelCorrection
from pigaming_app.sim.angles import wrap
from pigaming_app.sim.drivetrain import Drivetrain
from pigaming_app.sim.plant import Sighting, Twist

FASTEST = 1000.0  # mm/s, top speed of a 3pi
TOLERANCE = 30.0  # mm, tolerance of the check that a robot can have driven to a fix
PATIENCE = 3  # consistent implausible fixes after which the pose is reset to them
MEMORY = 2.0  # s of commands to keep
COAST = 1.0  # s of prediction without a fix; after that it takes PATIENCE fixes to resume
STEP = 0.02  # s, longest step of a prediction
NEVER = 1e9  # age of the fix of a robot that was never seen, s

FIX_PX, FIX_RAD = 0.6, 0.008  # noise of a fix, standard deviations
SLIP_PX, SLIP_RAD = 6.0, 0.1  # process noise of the pose: random walk, per root of a second
STATES = 8  # dimension of the state
INITIAL_COVARIANCE = np.diag(np.square([FIX_PX, FIX_PX, FIX_RAD, 0.1, 0.1, 0.1, 0.02, 20.0]))
PROCESS_NOISE = np.diag(np.square([SLIP_PX, SLIP_PX, SLIP_RAD, 0.005, 0.005, 0.005, 0.001, 0.5]))  # per second
NEW = WheelCorrection(1.0, 1.0, 1.0, 0.0, 0.0)
LOW, HIGH = WheelCorrection(0.6, 0.6, 0.6, -0.06, -30.0), WheelCorrection(1.4, 1.4, 1.4, 0.25, 60.0)
GATE = 36.0  # squared Mahalanobis distance of an innovation, beyond which it is an outlier: a push, a lift
STUCK = 0.4  # share of the predicted motion below which the robot counts as blocked
CLEAR_PX, CLEAR_RAD = 1.5, 0.03  # smallest predicted motions for that test
OUTLIER_PAUSE = 0.25  # s without updates of the wheels after an outlier or a block
MEASUREMENT_NOISE = np.diag(np.square([FIX_PX, FIX_PX, FIX_RAD]))

Matrix = NDArray[np.float64]


class PoseFilter:
    """Filter of one robot. `mm`: mm of the mat per arena px."""

    def __init__(self, drivetrain: Drivetrain, mm: float) -> None:
        self.drivetrain, self.mm = drivetrain, mm
        self._commands: deque[tuple[float, float, float]] = deque()  # time sent, left and right wheel in px/s
        self._motion = MotionState(0.0, 0.0, 0.0)
        self.correction = NEW
        self._covariance = INITIAL_COVARIANCE.copy()
        self._seen = self._outlier_at = -inf
        self._implausible: list[Fix] = []  # fixes rejected lately, consistent with each other

    def record_command(self, time: float, twist: Twist) -> None:
        """Record a command: the twist (px/s, rad/s) sent to the robot at `time`."""
        turn = 0.5 * self.drivetrain.base * twist[1]
        self._commands.append((time, twist[0] + turn, twist[0] - turn))
        oldest = min(max(self._seen, time - MEMORY), time) - self.drivetrain.dead_time - HIGH.late
        while len(self._commands) > 1 and self._commands[1][0] <= oldest:
            self._commands.popleft()

    def unseen(self, now: float) -> float:
        """Age of the newest accepted fix, s; NEVER if there is none."""
        return min(now - self._seen, NEVER)

    def at(self, now: float) -> Sighting:
        """Pose predicted for a time from the commands since the newest fix."""
        return self.along((now,))[0]

    def along(self, times: Sequence[float]) -> list[Sighting]:
        """Poses predicted for these times (s, in rising order), in one pass."""
        motion, at, poses = self._motion.copy(), self._seen, []
        for time in times:
            if self._seen > -inf:
                until = min(time, self._seen + COAST)
                for left, right, dt in self._acting(at, until):
                    motion.roll(left, right, self.correction, self.drivetrain.base, self.drivetrain.lag, dt)
                at = max(at, until)
            poses.append(Sighting(motion.x, motion.y, wrap(motion.heading % tau), self.unseen(time)))
        return poses

    def correct(self, fix: Fix) -> bool:
        """Update the filter with a fix; False if the fix is rejected."""
        dt = fix.captured - self._seen
        if dt == inf:
            self._begin(fix)
            return True
        if dt <= 0.0:
            return False
        if dt > COAST:
            return self._reacquire(fix)
        motion = self._motion.copy()
        jacobian = self._predict(motion, fix.captured)
        if hypot(fix.x - motion.x, fix.y - motion.y) * self.mm > FASTEST * dt + TOLERANCE:
            return self._reacquire(fix)
        self._implausible.clear()
        if _stuck(self._motion, motion, fix):
            self._outlier_at = fix.captured
        self._seen, self._motion = fix.captured, motion
        self._update(fix, jacobian @ self._covariance @ jacobian.T + PROCESS_NOISE * dt)
        return True

    def shift(self, seconds: float) -> None:
        """Take all fixes so far for `seconds` later."""
        self._seen, self._outlier_at = self._seen + seconds, self._outlier_at + seconds
        self._implausible = [fix._replace(captured=fix.captured + seconds) for fix in self._implausible]

    def add_lateness(self, seconds: float) -> None:
        """Take the robot for `seconds` later to act."""
        late = min(HIGH.late, max(LOW.late, self.correction.late + seconds))
        self.correction = self.correction._replace(late=late)

    def _acting(self, since: float, until: float) -> Iterator[tuple[float, float, float]]:
        """Commands in effect during this time, as (left px/s, right px/s, duration s) of at most STEP s each."""
        dead, commands = self.drivetrain.dead_time + self.correction.late, self._commands
        at = since
        for i in range(-1, len(commands)):
            left, right = commands[i][1:] if i >= 0 else (0.0, 0.0)
            end = min(commands[i + 1][0] + dead, until) if i + 1 < len(commands) else until
            while at < end - 1e-9:
                dt = min(STEP, end - at)
                yield left, right, dt
                at += dt

    def _predict(self, motion: MotionState, until: float) -> Matrix:
        """Advance `motion` to a time; returns the Jacobian of the state (8, 8) since the newest correction."""
        rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        for row in rows:
            row += [0.0] * len(self.correction)
        for left, right, dt in self._acting(self._seen, until):
            before = motion.copy()
            motion.roll(left, right, self.correction, self.drivetrain.base, self.drivetrain.lag, dt)
            self._step(rows, before, motion, dt)
        jacobian = np.eye(STATES)
        jacobian[:3] = rows
        return jacobian

    def _step(self, rows: list[list[float]], before: MotionState, after: MotionState, dt: float) -> None:
        """Propagate the Jacobian rows of x, y and heading through one step, to first order in `dt`."""
        correction, way = self.correction, 0.5 * dt
        left, right = way * (before.left + after.left), way * (before.right + after.right)
        faster_left, faster_right = (
            correction.left * (after.left - before.left),
            correction.right * (after.right - before.right),
        )
        stuck_left, stuck_right = (
            correction.left * after.left_way * dt,
            correction.right * after.right_way * dt,
        )
        ahead = (left, right, 0.0, -faster_left - faster_right, -stuck_left - stuck_right)
        turn = (left, -right, 0.0, faster_right - faster_left, stuck_right - stuck_left)
        c, s, t = 0.5 * cos(before.heading), 0.5 * sin(before.heading), correction.turning / self.drivetrain.base
        dx, dy = after.x - before.x, after.y - before.y
        x, y, heading = rows
        for i in range(2, STATES):
            x[i] -= dy * heading[i]
            y[i] += dx * heading[i]
        for i, (forward, sideways) in enumerate(zip(ahead, turn, strict=True), 3):
            x[i] += c * forward
            y[i] += s * forward
            heading[i] += t * sideways
        heading[5] += (after.heading - before.heading) / correction.turning

    def _begin(self, fix: Fix) -> None:
        """Reset the pose to a fix, at rest; the wheel parameters are kept."""
        self._motion, self._seen = MotionState(fix.x, fix.y, fix.heading), fix.captured
        self._forget_pose()
        self._implausible.clear()

    def _reacquire(self, fix: Fix) -> bool:
        """Collect an implausible fix; after PATIENCE consistent ones reset the pose to it and return True."""
        if self._implausible:
            last = self._implausible[-1]
            way = hypot(fix.x - last.x, fix.y - last.y) * self.mm
            if way > FASTEST * (fix.captured - last.captured) + TOLERANCE:
                self._implausible.clear()
        self._implausible.append(fix)
        if len(self._implausible) < PATIENCE:
            return False
        self._begin(fix)
        return True

    def _update(self, fix: Fix, covariance: Matrix) -> None:
        """Kalman update; after an outlier or a block only the pose is set."""
        motion = self._motion
        turned = _turn_to(motion.heading, fix.heading)
        innovation = np.array((fix.x - motion.x, fix.y - motion.y, turned))
        information = np.linalg.inv(covariance[:3, :3] + MEASUREMENT_NOISE)
        if innovation @ information @ innovation > GATE:
            self._outlier_at = fix.captured
        if fix.captured - self._outlier_at < OUTLIER_PAUSE:
            motion.x, motion.y, motion.heading = fix.x, fix.y, motion.heading + turned
            self._forget_pose()
            return
        gain = covariance[:, :3] @ information
        change = gain @ innovation
        x, y, heading = change[:3].tolist()
        motion.x, motion.y, motion.heading = motion.x + x, motion.y + y, motion.heading + heading
        self.correction = WheelCorrection(*np.clip(change[3:] + self.correction, LOW, HIGH).tolist())
        self._covariance = covariance - gain @ covariance[:3, :]

    def _forget_pose(self) -> None:
        """Reset the covariance of the pose to that of a fix, uncorrelated with the wheels."""
        self._covariance[:3, :], self._covariance[:, :3] = 0.0, 0.0
        self._covariance[:3, :3] = MEASUREMENT_NOISE


def _stuck(before: MotionState, predicted: MotionState, fix: Fix) -> bool:
    """True if the robot moved or turned much less than predicted: blocked, held, battery empty or out of reach."""
    dx, dy = predicted.x - before.x, predicted.y - before.y
    turn = predicted.heading - before.heading
    way = hypot(dx, dy)
    went = (fix.x - before.x) * dx + (fix.y - before.y) * dy
    turned = _turn_to(before.heading, fix.heading)
    return (way > CLEAR_PX and went < STUCK * way * way) or (abs(turn) > CLEAR_RAD and turned / turn < STUCK)


def _turn_to(heading: float, other: float) -> float:
    """Shortest signed turn from one heading to another, rad."""
    return (other - heading + pi) % tau - pi
