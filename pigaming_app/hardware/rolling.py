"""A robot in motion, by the model of its drivetrain: what the tracker predicts with, in pure floats."""

from math import cos, exp, sin


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
        kept = exp(-dt / lag)
        mean = (1.0 - kept) * lag / dt
        v_left = gains[0] * (left + (self.left - left) * mean)
        v_right = gains[1] * (right + (self.right - right) * mean)
        self.left = left + (self.left - left) * kept
        self.right = right + (self.right - right) * kept
        turn = (v_left - v_right) / base * dt
        way, middle = 0.5 * (v_left + v_right) * dt, self.heading + 0.5 * turn
        self.x += way * cos(middle)
        self.y += way * sin(middle)
        self.heading += turn
