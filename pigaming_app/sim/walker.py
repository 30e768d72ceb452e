"""People who walk: a flow field leads them round walls; they stop for robots, and step round whoever stands still.

A walker is any record with x, y, heading, walking (1: on the move) and an `errand` (see `navigate`).
"""

from math import atan2, cos, sin, sqrt
from typing import Any

from pigaming_app.sim.angles import turn_to, wrap
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.navigate import find_way
from pigaming_app.sim.robots import RADIUS
from pigaming_app.sim.world import DT, HEIGHT, WIDTH

THERE = 6.0  # px from the goal that count as there
ROOM = 34.0  # px that a walker keeps from a robot beside its own radius
AHEAD = 0.5  # s that it looks ahead at how a robot drives
TURN = 8.0  # rad/s


@kernel
def send(walker: Any, x: float, y: float) -> None:
    """Send a walker to a place."""
    errand = walker.errand
    errand.wanted, errand.goal_x, errand.goal_y = 1, x, y


@kernel
def walk(world: Any, walker: Any, speed: float, radius: float) -> int:
    """One tick on the way; 1 if the walker is where it was sent."""
    errand = walker.errand
    dx, dy = errand.goal_x - walker.x, errand.goal_y - walker.y
    left = sqrt(dx * dx + dy * dy)
    walker.walking = 0
    if left < THERE:
        return 1
    find_way(world, errand, walker.x, walker.y)
    dx, dy = errand.way_x - walker.x, errand.way_y - walker.y
    gap = sqrt(dx * dx + dy * dy)
    if gap < 1e-6:
        return 0
    ux, uy = dx / gap, dy / gap
    pace = speed * DT
    if left < pace:
        pace = left
    for side in range(3):  # straight on, else to the right, else to the left
        turn = 0.0 if side == 0 else (1.0 if side == 1 else -1.0)
        vx, vy = ux * (1.0 - abs(turn)) - uy * turn, uy * (1.0 - abs(turn)) + ux * turn
        x, y = walker.x + pace * vx, walker.y + pace * vy
        if free_of_robots(world, walker, x, y, radius) and inside(x, y) and (side == 0 or not in_wall(world, x, y)):
            look(walker, vx, vy)
            walker.x, walker.y, walker.walking = x, y, 1
            return 0
    return 0


@kernel
def look(walker: Any, vx: float, vy: float) -> None:
    """Turn the way it walks, not at once."""
    turn = turn_to(atan2(vy, vx) - walker.heading)
    most = TURN * DT
    if turn > most:
        turn = most
    elif turn < -most:
        turn = -most
    walker.heading = wrap(walker.heading + turn)


@kernel
def inside(x: float, y: float) -> bool:
    """Whether a walker may stand there at all."""
    return bool(RADIUS <= x <= WIDTH - RADIUS and RADIUS <= y <= HEIGHT - RADIUS)


@kernel
def free_of_robots(world: Any, walker: Any, x: float, y: float, radius: float) -> bool:
    """Whether no robot is, or will soon be, in the way of a step to (x, y). Stepping away from one is always free."""
    reach = RADIUS + radius + ROOM
    for robot in world.robots:
        if not robot.present:
            continue
        ahead = AHEAD * robot.linear
        vx, vy = ahead * cos(robot.heading), ahead * sin(robot.heading)
        for half in range(3):
            rx, ry = robot.x + 0.5 * half * vx, robot.y + 0.5 * half * vy
            dx, dy = x - rx, y - ry
            gap = dx * dx + dy * dy
            if gap < reach * reach:
                ox, oy = walker.x - rx, walker.y - ry
                if gap < ox * ox + oy * oy:
                    return False
    return True
