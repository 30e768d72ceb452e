"""How a seat says what it wants in this tick."""

from math import floor
from typing import Any

from pigaming_app.sim.kernel import kernel

STEPS = 64.0  # of a stick, from its middle to its edge: a file keeps it as a whole number, exactly


@kernel
def set_action(action: Any, linear: float, angular: float, fire: int, turbo: int) -> None:
    """Set an action that makes for nothing: the stick is held within [-1, 1] and rounded to 64ths."""
    action.linear = quantise(linear)
    action.angular = quantise(angular)
    action.fire = 1 if fire else 0
    action.turbo = 1 if turbo else 0
    action.aim = 0


@kernel
def quantise(value: float) -> float:
    """A stick's way in [-1, 1], rounded to 64ths; what is not a number counts as the middle."""
    if value >= 1.0:
        return 1.0
    if value <= -1.0:
        return -1.0
    if value != value:
        return 0.0
    return floor(value * STEPS + 0.5) / STEPS
