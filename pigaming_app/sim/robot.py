"""How a robot drives: two wheels, first-order motor lag, and a turbo meter."""

from math import cos, exp, sin
from typing import Any

from pigaming_app.sim.angles import wrap
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import DT

RADIUS = 36.0
LAG = 0.08  # s, time constant of the motors
GAIN = 1.0 - exp(-DT / LAG)


@kernel
def integrate(robot: Any) -> None:
    """One tick of driving on an empty floor: the motors follow what is asked, the robot follows the motors.

    The middle of the arc gives its direction: exact for a straight line, and to 1e-4 px for the tightest bend.
    """
    robot.linear += (robot.ask_linear - robot.linear) * robot.gain
    robot.angular += (robot.ask_angular - robot.angular) * robot.gain
    middle = robot.heading + 0.5 * DT * robot.angular
    robot.x += DT * robot.linear * cos(middle)
    robot.y += DT * robot.linear * sin(middle)
    robot.heading = wrap(robot.heading + DT * robot.angular)


@kernel
def use_turbo(robot: Any, wanted: int, drain: float, refill: float) -> None:
    """One tick of the turbo meter: it empties while turbo is on and fills while the button is up.

    An empty meter cuts out until the button has been released.
    """
    if wanted and robot.turbo >= drain and (robot.boosting or robot.turbo >= 10.0 * drain):
        robot.turbo -= drain
        robot.boosting = 1
        return
    robot.boosting = 0
    if not wanted:
        robot.turbo += refill
        if robot.turbo > 1.0:
            robot.turbo = 1.0


@kernel
def stop(robot: Any) -> None:
    """Ask a robot to stand."""
    robot.ask_linear, robot.ask_angular, robot.boosting = 0.0, 0.0, 0


@kernel
def stop_all(world: Any) -> None:
    """Ask every robot to stand."""
    for robot in world.robots:
        stop(robot)
