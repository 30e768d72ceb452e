"""People who walk: a flow field leads them round walls; they stop for robots, and step round whoever stands still.

A walker is any record with x, y, heading, walking (1: on the move), side (on which it goes round somebody: -1, 0 or 1)
and an `errand` (see `navigate`).
"""

from math import atan2, cos, sin, sqrt
from typing import Any

from pigaming_app.sim.angles import turn_to, wrap
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.navigate import find_way
from pigaming_app.sim.robots import RADIUS
from pigaming_app.sim.world import DT

THERE = 6.0  # px from the goal that count as there
NEARLY = 70.0  # px that do, if somebody stands in the way
ROOM, CLOSE = 34.0, 8.0  # px that a walker keeps from a robot that drives, and from one that stands
DRIVING = 20.0  # px/s
AHEAD = 0.5  # s that it looks ahead at how a robot drives
TURN = 8.0  # rad/s


@kernel
def send(walker: Any, x: float, y: float) -> None:
    """Send a walker to a place."""
    errand = walker.errand
    errand.wanted, errand.goal_x, errand.goal_y = 1, x, y


@kernel
def walk(world: Any, walker: Any, speed: float, radius: float) -> int:
    """One tick on the way; 1 if the walker is where it was sent, or as near as those who stand there let it."""
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
    pace = min(left, speed * DT)
    if step(world, walker, pace * ux, pace * uy, radius):
        walker.side = 0
        return 0
    if walker.side == 0:
        walker.side = 1
    for _ in range(2):  # round what is in the way, on one side as long as that leads on
        if step(world, walker, -pace * walker.side * uy, pace * walker.side * ux, radius):
            return 0
        walker.side = -walker.side
    return 1 if left < NEARLY else 0


@kernel
def step(world: Any, walker: Any, dx: float, dy: float, radius: float) -> bool:
    """Take a step, if neither a robot nor a wall is in the way."""
    x, y = walker.x + dx, walker.y + dy
    if not free_of_robots(world, walker, x, y, radius) or in_wall(world, x, y):
        return False
    look(walker, dx, dy)
    walker.x, walker.y, walker.walking = x, y, 1
    return True


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
def free_of_robots(world: Any, walker: Any, x: float, y: float, radius: float) -> bool:
    """Whether no robot is, or will soon be, in the way of a step to (x, y). Stepping away from one is always free."""
    for robot in world.robots:
        if not robot.present:
            continue
        drives = robot.linear > DRIVING or robot.linear < -DRIVING
        reach = RADIUS + radius + (ROOM if drives else CLOSE)
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
