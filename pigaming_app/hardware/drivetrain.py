"""What is assumed of a robot's wheels: gains, motor lag, the time until a command acts, and the distance of the wheels.

`Drivetrain` is what `fidelity` finds and the tracker uses; `Rolling` is a robot in motion by that model.
"""

from dataclasses import dataclass
from math import cos, exp, sin

from pigaming_app.sim.robots import LAG

BASE = 82.0  # mm between the wheels of a 3pi, to be identified (HARDWARE.md)
STEP = 0.02  # s, the longest step of a prediction


@dataclass(frozen=True)
class Drivetrain:
    """One robot. A wheel told to run at v runs, once its motor has followed, at gain * v."""

    left: float = 1.0
    right: float = 1.0
    lag: float = LAG  # s, time constant of the motors
    dead: float = 0.02  # s from sending a command to the motors hearing it: tick, serial line, air
    base: float = BASE  # mm


class Rolling:
    """A pose in arena px and rad, and how fast the wheels turn, in px/s before their gains."""

    __slots__ = ("heading", "left", "right", "x", "y")

    def __init__(self, x: float, y: float, heading: float, left: float = 0.0, right: float = 0.0) -> None:
        self.x, self.y, self.heading, self.left, self.right = x, y, heading, left, right

    def copy(self) -> "Rolling":
        """Another one like this."""
        return Rolling(self.x, self.y, self.heading, self.left, self.right)

    def roll(self, left: float, right: float, gains: tuple[float, float], base: float, lag: float, dt: float) -> None:
        """Drive for `dt` s with the wheels told to run at `left`, `right` px/s; `base` in px.

        Exact for the motors; the way is an arc with the mean speeds of the step.
        """
        kept = exp(-dt / lag) if lag > 1e-6 else 0.0
        mean = (1.0 - kept) * lag / dt
        v_left = gains[0] * (left + (self.left - left) * mean)
        v_right = gains[1] * (right + (self.right - right) * mean)
        self.left = left + (self.left - left) * kept
        self.right = right + (self.right - right) * kept
        linear, turn = 0.5 * (v_left + v_right) * dt, (v_left - v_right) / base * dt
        middle = self.heading + 0.5 * turn
        self.x += linear * cos(middle)
        self.y += linear * sin(middle)
        self.heading += turn
