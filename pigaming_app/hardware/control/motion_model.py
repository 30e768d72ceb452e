"""A robot in motion, by the model of its drivetrain: what the tracker predicts with, in pure floats."""

from math import copysign, cos, exp, sin
from typing import NamedTuple


class WheelCorrection(NamedTuple):
    """What one robot's wheels make of what they are told, besides their drivetrain."""

    left: float  # gain
    right: float
    turning: float  # gain: the nominal base by the true one
    late: float  # s on top of the dead time
    stiction: float  # px/s that a wheel is slower than it is told, and below which it stands


class MotionState:
    """A pose in arena px and rad; how fast the wheels turn, in px/s before their gains; which way they turn, lagged."""

    __slots__ = ("heading", "left", "left_way", "right", "right_way", "x", "y")

    def __init__(self, x: float, y: float, heading: float) -> None:
        self.x, self.y, self.heading = x, y, heading
        self.left = self.right = self.left_way = self.right_way = 0.0

    def copy(self) -> "MotionState":
        """Another one like this."""
        other = MotionState(self.x, self.y, self.heading)
        other.left, other.right, other.left_way, other.right_way = self.left, self.right, self.left_way, self.right_way
        return other

    def roll(self, left: float, right: float, wear: WheelCorrection, base: float, lag: float, dt: float) -> None:
        """Drive for `dt` s with the wheels told to run at `left`, `right` px/s; `base` in px.

        Exact for the motors; the way is an arc with the mean speeds of the step.
        """
        kept = exp(-dt / lag)
        mean = (1.0 - kept) * lag / dt
        goal_left, goal_right = _beyond(left, wear.stiction), _beyond(right, wear.stiction)
        v_left = wear.left * (goal_left + (self.left - goal_left) * mean)
        v_right = wear.right * (goal_right + (self.right - goal_right) * mean)
        self.left = goal_left + (self.left - goal_left) * kept
        self.right = goal_right + (self.right - goal_right) * kept
        way_left, way_right = _sign(goal_left), _sign(goal_right)
        self.left_way = way_left + (self.left_way - way_left) * kept
        self.right_way = way_right + (self.right_way - way_right) * kept
        turn = (v_left - v_right) * wear.turning / base * dt
        way, middle = 0.5 * (v_left + v_right) * dt, self.heading + 0.5 * turn
        self.x += way * cos(middle)
        self.y += way * sin(middle)
        self.heading += turn


def _beyond(speed: float, stiction: float) -> float:
    over = abs(speed) - stiction
    return copysign(over, speed) if speed and over > 0.0 else 0.0


def _sign(speed: float) -> float:
    return copysign(1.0, speed) if speed else 0.0
