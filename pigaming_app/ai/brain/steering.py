"""How a brain without a view of its own drives along its route; the frozen machine relies on it as it is."""

from math import atan2, pi, sqrt
from typing import Any

from pigaming_app.sim.action import set_action
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.flow_field import update_route
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.robot import LAG
from pigaming_app.sim.world import DT


@kernel
def bearing(robot: Any, x: float, y: float) -> float:
    """The direction of a point, relative to the own heading."""
    return turn_to(atan2(y - robot.y, x - robot.x) - robot.heading)


@kernel
def turn_stick(angle: float, angular: float, turn_rate: float, period: int) -> float:
    """The stick that turns by `angle` within `period` ticks, as far as the motors can; they turn by `angular` now."""
    return float(0.75 * (angle - LAG * angular) / (turn_rate * period * DT))


@kernel
def approach(angle: float, distance: float) -> tuple[float, float]:
    """How to get to a point: the angle to turn by, and the stick ahead; backwards where that saves a long turn."""
    ahead = 1.0
    if abs(angle) > 2.2 and distance < 200.0:
        angle, ahead = turn_to(angle + pi), -1.0
    if abs(angle) > 0.9:
        return angle, 0.0
    return angle, 0.5 * ahead if abs(angle) > 0.4 else ahead


@kernel
def follow(match: Any, seat: int, route: Any, period: int) -> None:
    """Drive on along the way for `period` ticks."""
    robot = match.robots[seat]
    update_route(match, route, robot.x, robot.y)
    dx, dy = route.way_x - robot.x, route.way_y - robot.y
    gap = sqrt(dx * dx + dy * dy)
    angle, speed = approach(bearing(robot, route.way_x, route.way_y), gap)
    if route.straight and gap < 70.0:
        speed *= 0.3 + 0.7 * gap / 70.0
    set_action(match.actions[seat], speed, turn_stick(angle, robot.angular, match.rules.turn_rate, period), 0, 0)
