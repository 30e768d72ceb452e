"""One robot, followed: a pose at the newest correction, the gains of its wheels learnt on the way, commands since.

An extended Kalman filter over (x, y, heading, gain of the left wheel, gain of the right): the gains differ from robot
to robot and with its batteries, and a prediction over 80 ms of dead time needs them.
"""

from collections import deque
from math import cos, hypot, inf, pi, sin, sqrt, tau

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.drivetrain import STEP, Drivetrain, Rolling
from pigaming_app.hardware.signals import Fix
from pigaming_app.sim.angles import wrap
from pigaming_app.sim.plant import Sighting, Twist

Matrix = NDArray[np.float64]

FASTEST = 1000.0  # mm/s: a 3pi flat out
LEEWAY = 30.0  # mm a marker may jump beyond that (HARDWARE.md)
PATIENCE = 3  # rejections that agree with each other, after which the robot is believed to be there
MEMORY = 2.0  # s for which commands are kept
FIX_PX, FIX_RAD = 0.8, 0.015  # noise of a fix, standard deviations
SLIP_PX, SLIP_RAD = 25.0, 0.35  # per s and root of the frame's share: what the model does not know of
GAIN_START, GAIN_WALK = 0.1, 0.01  # of the wheels' gains: at the beginning, and per root of a second
GAIN_LIMITS = 0.6, 1.4


class Follower:
    """The filter of one robot; `mm`: of one arena px."""

    def __init__(self, train: Drivetrain, mm: float) -> None:
        self.train, self.base, self.mm = train, train.base / mm, mm
        self._told: deque[tuple[float, float, float]] = deque([(-inf, 0.0, 0.0)])  # when it acts, wheels in px/s
        self._rolling = Rolling(0.0, 0.0, 0.0)
        self._gains = (train.left, train.right)
        self._spread = np.zeros((5, 5))
        self._time = -inf  # of the newest correction
        self._rejected: list[Fix] = []

    def told(self, time: float, twist: Twist) -> None:
        """Remember what was sent to the robot."""
        turn = 0.5 * self.base * twist[1]
        self._told.append((time + self.train.dead, twist[0] + turn, twist[0] - turn))
        while len(self._told) > 1 and self._told[1][0] < max(self._time, time - MEMORY):
            self._told.popleft()

    def unseen(self, now: float) -> float:
        """Seconds since it was seen."""
        return min(now - self._time, 1e9)

    def at(self, now: float) -> Sighting:
        """Where it is at a time, by the commands sent since it was seen."""
        rolling = self._rolling.copy()
        if self._time > -inf:
            self._replay(rolling, self._time, now)
        return Sighting(rolling.x, rolling.y, wrap(rolling.heading % tau), self.unseen(now))

    def correct(self, fix: Fix) -> bool:
        """Take in where the camera saw it; false if that is not believed."""
        if self._time == -inf:
            self._begin(fix)
            return True
        dt = fix.captured - self._time
        if dt <= 0.0:
            return False
        rolling = self._rolling.copy()
        flow = self._replay(rolling, self._time, fix.captured)
        away = hypot(fix.x - rolling.x, fix.y - rolling.y)
        if away * self.mm > FASTEST * dt + LEEWAY:
            return self._reject(fix)
        self._rejected.clear()
        self._time, self._rolling = fix.captured, rolling
        self._blend(fix, flow, dt)
        return True

    def _replay(self, rolling: Rolling, since: float, until: float) -> Matrix:
        """Move a robot by the commands that acted in this time; how its pose there depends on its state before."""
        flow = np.eye(5)
        told = self._told
        for i, (acts, left, right) in enumerate(told):
            end = told[i + 1][0] if i + 1 < len(told) else inf
            begin, end = max(acts, since), min(end, until)
            while begin < end - 1e-9:
                dt = min(STEP, end - begin)
                self._roll(rolling, left, right, dt, flow)
                begin += dt
        return flow

    def _roll(self, rolling: Rolling, left: float, right: float, dt: float, flow: Matrix) -> None:
        x, y = rolling.x, rolling.y
        rolling.roll(left, right, self._gains, self.base, self.train.lag, dt)
        dx, dy = rolling.x - x, rolling.y - y
        half_c, half_s = 0.5 * dt * cos(rolling.heading), 0.5 * dt * sin(rolling.heading)
        step = np.eye(5)
        step[0, 2], step[1, 2] = -dy, dx
        step[0, 3], step[0, 4] = half_c * rolling.left, half_c * rolling.right
        step[1, 3], step[1, 4] = half_s * rolling.left, half_s * rolling.right
        step[2, 3], step[2, 4] = rolling.left / self.base * dt, -rolling.right / self.base * dt
        flow[:] = step @ flow

    def _begin(self, fix: Fix) -> None:
        """It is there, standing."""
        self._rolling = Rolling(fix.x, fix.y, fix.heading)
        self._time = fix.captured
        self._spread = np.diag([FIX_PX**2, FIX_PX**2, FIX_RAD**2, GAIN_START**2, GAIN_START**2])
        self._rejected.clear()

    def _reject(self, fix: Fix) -> bool:
        """Not believed, unless that is the third time that it was seen about there: then it begins anew."""
        if self._rejected:
            last = self._rejected[-1]
            way = hypot(fix.x - last.x, fix.y - last.y) * self.mm
            if way > FASTEST * (fix.captured - last.captured) + LEEWAY:
                self._rejected.clear()
        self._rejected.append(fix)
        if len(self._rejected) < PATIENCE:
            return False
        self._begin(fix)
        return True

    def _blend(self, fix: Fix, flow: Matrix, dt: float) -> None:
        """Kalman's correction of the pose and the gains."""
        spread = flow @ self._spread @ flow.T
        slip, turn = (SLIP_PX * sqrt(dt) * 0.2) ** 2, (SLIP_RAD * sqrt(dt) * 0.2) ** 2
        spread += np.diag([slip, slip, turn, GAIN_WALK**2 * dt, GAIN_WALK**2 * dt])
        rolling = self._rolling
        miss = np.array([fix.x - rolling.x, fix.y - rolling.y, (fix.heading - rolling.heading + pi) % tau - pi])
        known = spread[:3, :3] + np.diag([FIX_PX**2, FIX_PX**2, FIX_RAD**2])
        share = spread[:, :3] @ np.linalg.inv(known)
        change = share @ miss
        rolling.x += change[0]
        rolling.y += change[1]
        rolling.heading += change[2]
        low, high = GAIN_LIMITS
        self._gains = (
            min(max(self._gains[0] + change[3], low), high),
            min(max(self._gains[1] + change[4], low), high),
        )
        self._spread = spread - share @ spread[:3, :]
