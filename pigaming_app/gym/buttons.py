"""The meter of the turbo button, for masks of choices."""

from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import Robot


@kernel
def has_turbo(robot: Robot, drain: float) -> bool:
    """True if the button would turn turbo on, or keep it on: see `use_turbo` in sim/robot.py."""
    return bool(robot.turbo >= (drain if robot.boosting else 10.0 * drain))
