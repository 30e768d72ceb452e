"""People who walk: a flow field leads them round walls; they stop for robots, and step round whoever stands still.

A walker is any record with x, y, heading, walking (1: on the move), side (on which it goes round somebody: -1, 0 or 1),
an `route` (see `navigate`), and `least` and `held_up`, by which it is known whether it gets on. The world has a Motion
for each robot, brought up to date once a tick: people go by how robots move, not by how their motors turn.
"""

from math import atan2, exp, sqrt
from typing import Any

from pigaming_app.sim.angles import turn_to, wrap
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.flow_field import free_node, update_route
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.world import CELL, DT, HZ, ROBOTS

THERE = 6.0  # px from the goal that count as there
NEARLY = 70.0  # px that do, if somebody stands in the way
ROOM, CLOSE = 34.0, 8.0  # px that a walker keeps from a robot that drives, and from one that stands
PAST = 24.0  # px more than that, from which on it has come past somebody
DRIVING = 20.0  # px/s
AHEAD = 0.5  # s that it looks ahead at how a robot drives
SIGHT = 300.0  # px from which no robot comes near in that time
TURN = 8.0  # rad/s
NEARER = 10.0  # px that count as getting on
CARRIED = 40.0  # px in a tick: a robot that moved further was carried
SMOOTH = 1.0 - exp(-DT / 0.1)  # share of a velocity measured in one tick; to and fro within 0.1 s is no driving


@record
class Motion:
    """How a robot moves, by the poses at which it is found."""

    x: float  # px, on the tick before
    y: float
    vx: float  # px/s
    vy: float


@kernel
def track_motion(motion: Any, robot: Any) -> None:
    """Take in where a robot is now."""
    x, y = robot.x, robot.y
    dx, dy = x - motion.x, y - motion.y
    motion.x, motion.y = x, y
    if dx * dx + dy * dy > CARRIED * CARRIED:
        dx, dy = 0.0, 0.0
    motion.vx += (dx * HZ - motion.vx) * SMOOTH
    motion.vy += (dy * HZ - motion.vy) * SMOOTH


@kernel
def send(walker: Any, x: float, y: float) -> None:
    """Send a walker to a place."""
    route = walker.route
    route.wanted, route.goal_x, route.goal_y = 1, x, y
    walker.least, walker.held_up = 1e9, 0


@kernel
def walk(world: Any, walker: Any, speed: float, radius: float) -> int:
    """One tick on the way; 1 if the walker is where it was sent, or as near as those who stand there let it."""
    route = walker.route
    dx, dy = route.goal_x - walker.x, route.goal_y - walker.y
    left = sqrt(dx * dx + dy * dy)
    walker.walking = 0
    if left < THERE:
        return 1
    update_route(world, route, walker.x, walker.y)
    advance(world, walker, left)
    dx, dy = route.way_x - walker.x, route.way_y - walker.y
    gap = sqrt(dx * dx + dy * dy)
    if gap < 1e-6:
        return 0
    pace = min(left, speed * DT)
    ux, uy = pace * dx / gap, pace * dy / gap
    block = in_the_way(world, walker, walker.x + ux, walker.y + uy, radius)
    if block < 0 and step(world, walker, ux, uy, radius):
        if in_the_way(world, walker, walker.x + ux, walker.y + uy, radius + PAST) < 0:
            walker.side = 0
        return 0
    if block >= 0 and left < NEARLY and not is_driving(world.motions[block]):
        return 1
    go_round(world, walker, block, ux, uy, radius)
    return 0


@kernel
def advance(world: Any, walker: Any, left: float) -> None:
    """Count the ticks since a walker last came nearer to its goal, by the way that it has to go."""
    route = walker.route
    if not route.straight:
        left = CELL * route.reach[free_node(world, walker.x, walker.y)]
    if left < walker.least - NEARER:
        walker.least, walker.held_up = left, 0
    else:
        walker.held_up += 1


@kernel
def go_round(world: Any, walker: Any, block: int, ux: float, uy: float, radius: float) -> None:
    """A step along the rim of robot `block` (of a wall if that is negative), on one side as long as that leads on."""
    ox, oy = -ux, -uy
    if block >= 0:
        ox, oy = walker.x - world.robots[block].x, walker.y - world.robots[block].y
    pace = sqrt(ux * ux + uy * uy) / (sqrt(ox * ox + oy * oy) + 1e-9)
    vx, vy = -pace * oy, pace * ox
    if walker.side == 0:
        walker.side = 1 if vx * ux + vy * uy >= 0.0 else -1
    for _ in range(2):
        if step(world, walker, walker.side * vx, walker.side * vy, radius):
            return
        walker.side = -walker.side


@kernel
def step(world: Any, walker: Any, dx: float, dy: float, radius: float) -> bool:
    """Take a step, if neither a robot nor a wall is in the way."""
    x, y = walker.x + dx, walker.y + dy
    if in_the_way(world, walker, x, y, radius) >= 0 or in_wall(world, x, y):
        return False
    turn_towards(walker, dx, dy)
    walker.x, walker.y, walker.walking = x, y, 1
    return True


@kernel
def turn_towards(walker: Any, vx: float, vy: float) -> None:
    """Turn the way it walks, not at once."""
    turn = turn_to(atan2(vy, vx) - walker.heading)
    most = TURN * DT
    if turn > most:
        turn = most
    elif turn < -most:
        turn = -most
    walker.heading = wrap(walker.heading + turn)


@kernel
def is_driving(motion: Any) -> bool:
    """Whether a robot is on the move."""
    return motion.vx * motion.vx + motion.vy * motion.vy > DRIVING * DRIVING  # type: ignore[no-any-return]


@kernel
def in_the_way(world: Any, walker: Any, x: float, y: float, radius: float) -> int:
    """The first robot that is or will soon be in the way of a step to (x, y); -1: none. A step away is free."""
    for k in range(ROBOTS):
        robot = world.robots[k]
        if not robot.present:
            continue
        dx, dy = x - robot.x, y - robot.y
        if not (-SIGHT < dx < SIGHT and -SIGHT < dy < SIGHT):
            continue
        motion = world.motions[k]
        looks, reach = (3, RADIUS + radius + ROOM) if is_driving(motion) else (1, RADIUS + radius + CLOSE)
        for half in range(looks):
            ahead = 0.5 * half * AHEAD
            rx, ry = robot.x + ahead * motion.vx, robot.y + ahead * motion.vy
            dx, dy = x - rx, y - ry
            gap = dx * dx + dy * dy
            if gap < reach * reach:
                ox, oy = walker.x - rx, walker.y - ry
                if gap < ox * ox + oy * oy and arrives(world, robot, motion, half):
                    return k
    return -1


@kernel
def arrives(world: Any, robot: Any, motion: Any, half: int) -> bool:
    """Whether no wall stops a robot in so many halves of AHEAD."""
    for part in range(1, half + 1):
        ahead = 0.5 * part * AHEAD
        if in_wall(world, robot.x + ahead * motion.vx, robot.y + ahead * motion.vy):
            return False
    return True
