"""Steering towards points and along routes; frozen, because the results of `classic` depend on it."""

from math import atan2, pi, sqrt
from typing import Protocol

from pigaming_app.games.simple import MatchState
from pigaming_app.sim.action import set_action
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.flow_field import Route, update_route
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.robot import LAG
from pigaming_app.sim.world import DT


class Posed(Protocol):
    """A robot, or an observation of one's own: px, px, rad."""

    x: float
    y: float
    heading: float


@kernel
def bearing(robot: Posed, x: float, y: float) -> float:
    """Direction of a point (arena px) relative to the robot's heading, rad."""
    return turn_to(atan2(y - robot.y, x - robot.x) - robot.heading)


@kernel
def turn_stick(angle: float, angular: float, turn_rate: float, period: int) -> float:
    """Stick deflection that turns by `angle` rad within `period` ticks, motor limits permitting.

    `angular` is the present turn rate and `turn_rate` the highest, rad/s.
    """
    return float(0.75 * (angle - LAG * angular) / (turn_rate * period * DT))


@kernel
def approach(angle: float, distance: float) -> tuple[float, float]:
    """Angle to turn by (rad) and forward stick to reach a point `distance` px away; reverses to avoid a long turn."""
    ahead = 1.0
    if abs(angle) > 2.2 and distance < 200.0:
        angle, ahead = turn_to(angle + pi), -1.0
    if abs(angle) > 0.9:
        return angle, 0.0
    return angle, 0.5 * ahead if abs(angle) > 0.4 else ahead


@kernel
def follow(match: MatchState, seat: int, route: Route, period: int) -> None:
    """Set the action that follows `route` for the next `period` ticks."""
    robot = match.robots[seat]
    update_route(match, route, robot.x, robot.y)
    dx, dy = route.waypoint_x - robot.x, route.waypoint_y - robot.y
    gap = sqrt(dx * dx + dy * dy)
    angle, speed = approach(bearing(robot, route.waypoint_x, route.waypoint_y), gap)
    if route.straight and gap < 70.0:
        speed *= 0.3 + 0.7 * gap / 70.0
    set_action(match.actions[seat], speed, turn_stick(angle, robot.angular, match.rules.turn_rate, period), 0, 0)
