"""Motion model of a robot with its drivetrain, in plain floats: the tracker's prediction."""

from math import copysign, cos, exp, sin
from typing import NamedTuple


class WheelCorrection(NamedTuple):
    """Deviation of a robot's wheels from their drivetrain."""

    left: float  # gain
    right: float
    turning: float  # gain: nominal over true wheel base
    late: float  # s on top of the dead time
    stiction: float  # px/s lost to friction; slower commands do not turn a wheel


class MotionState:
    """Pose in arena px and rad; wheel speeds in px/s before gains; lagged signs of the wheels' motion."""

    __slots__ = ("heading", "left", "left_way", "right", "right_way", "x", "y")

    def __init__(self, x: float, y: float, heading: float) -> None:
        self.x, self.y, self.heading = x, y, heading
        self.left = self.right = self.left_way = self.right_way = 0.0

    def copy(self) -> "MotionState":
        other = MotionState(self.x, self.y, self.heading)
        other.left, other.right, other.left_way, other.right_way = self.left, self.right, self.left_way, self.right_way
        return other

    def roll(self, left: float, right: float, correction: WheelCorrection, base: float, lag: float, dt: float) -> None:
        """Advance by `dt` s with wheel commands `left`, `right` in px/s; `base` in px, `lag` in s.

        Exact for the motors; the path is an arc at the mean speeds of the step.
        """
        decay = exp(-dt / lag)
        mean = (1.0 - decay) * lag / dt
        goal_left, goal_right = _beyond(left, correction.stiction), _beyond(right, correction.stiction)
        v_left = correction.left * (goal_left + (self.left - goal_left) * mean)
        v_right = correction.right * (goal_right + (self.right - goal_right) * mean)
        self.left = goal_left + (self.left - goal_left) * decay
        self.right = goal_right + (self.right - goal_right) * decay
        way_left, way_right = _sign(goal_left), _sign(goal_right)
        self.left_way = way_left + (self.left_way - way_left) * decay
        self.right_way = way_right + (self.right_way - way_right) * decay
        turn = (v_left - v_right) * correction.turning / base * dt
        way, middle = 0.5 * (v_left + v_right) * dt, self.heading + 0.5 * turn
        self.x += way * cos(middle)
        self.y += way * sin(middle)
        self.heading += turn


def _beyond(speed: float, stiction: float) -> float:
    over = abs(speed) - stiction
    return copysign(over, speed) if speed and over > 0.0 else 0.0


def _sign(speed: float) -> float:
    return copysign(1.0, speed) if speed else 0.0
