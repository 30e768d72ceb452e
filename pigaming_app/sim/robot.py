"""Motion of a simulated robot: differential drive with first-order motor lag, and a turbo meter."""

from math import cos, exp, sin

from pigaming_app.sim.angles import wrap
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import DT, Robot, World

LAG = 0.08  # s, time constant of the motors
GAIN = 1.0 - exp(-DT / LAG)  # share of the speed error that the motors remove in one tick


@kernel
def integrate(robot: Robot) -> None:
    """One tick of motion without contact: the motors approach the requested speeds, the robot follows the motors.

    Midpoint rule: exact on a straight line, and to 1e-4 px in the tightest bend.
    """
    robot.linear += (robot.requested_linear - robot.linear) * robot.gain
    robot.angular += (robot.requested_angular - robot.angular) * robot.gain
    middle = robot.heading + 0.5 * DT * robot.angular
    robot.x += DT * robot.linear * cos(middle)
    robot.y += DT * robot.linear * sin(middle)
    robot.heading = wrap(robot.heading + DT * robot.angular)


@kernel
def use_turbo(robot: Robot, wanted: int, drain: float, refill: float) -> None:
    """One tick of the turbo meter: it drains while turbo is on and refills while the button is up.

    Once the meter is empty, turbo stays off until the button has been released.
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
def stop(robot: Robot) -> None:
    """Request zero speed of a robot."""
    robot.requested_linear, robot.requested_angular, robot.boosting = 0.0, 0.0, 0


@kernel
def stop_all(world: World) -> None:
    """Request zero speed of every robot."""
    for robot in world.robots:
        stop(robot)


@kernel
def put_back(robot: Robot, x: float, y: float, heading: float) -> None:
    """Ask for a robot at rest at a pose, px and rad in 0..2 pi, before the next tick: a simulated one jumps there once
    the place is free of others, a real one drives there by itself. `robot.recover` is 1 until then.
    """
    robot.recover, robot.recover_x, robot.recover_y, robot.recover_heading = 1, x, y, heading
