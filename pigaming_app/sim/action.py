"""Setting a seat's action for one tick, with the stick quantised to 64ths."""

from math import floor

from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import Action

STEPS = 64.0  # stick steps from centre to edge: replay files store them exactly, as whole numbers


@kernel
def set_action(action: Action, linear: float, angular: float, fire: int, turbo: int) -> None:
    """Set an action without an aim; the stick is clamped to [-1, 1] and rounded to 64ths."""
    action.linear = quantise(linear)
    action.angular = quantise(angular)
    action.fire = 1 if fire else 0
    action.turbo = 1 if turbo else 0
    action.aim = 0


@kernel
def quantise(value: float) -> float:
    """A stick position clamped to [-1, 1] and rounded to 64ths; NaN counts as the centre."""
    if value >= 1.0:
        return 1.0
    if value <= -1.0:
        return -1.0
    if value != value:
        return 0.0
    return floor(value * STEPS + 0.5) / STEPS
