"""Motion of pedestrians: a flow field leads them around walls; they stop for robots and walk around those at rest.

The match has a Motion for each robot, updated once a tick: pedestrians react to measured motion, not to motor speeds.
"""

from math import atan2, exp, sqrt

from pigaming_app.games.factory.state import Factory, Motion, Worker
from pigaming_app.sim.angles import turn_to, wrap
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.flow_field import free_node, update_route
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import CELL, DT, HZ, ROBOTS, Robot

ARRIVED = 6.0  # px from the goal within which a walker has arrived
ARRIVED_NEAR_ROBOT = 70.0  # px likewise, if a robot at rest is in the way
MOVING_CLEARANCE, RESTING_CLEARANCE = 34.0, 8.0  # px of clearance from a moving robot, and from one at rest
PASSED_MARGIN = 24.0  # px beyond that clearance at which an obstacle has been passed
MOVING_SPEED = 20.0  # px/s above which a robot is moving
LOOKAHEAD = 0.5  # s of lookahead at a robot's motion
MAX_RANGE = 300.0  # px, beyond which no robot can come near within LOOKAHEAD
TURN_RATE = 8.0  # rad/s
MIN_PROGRESS = 10.0  # px that count as progress
CARRIED_DISTANCE = 40.0  # px in a tick: a robot that moved further was carried by hand
FILTER_WEIGHT = 1.0 - exp(-DT / 0.1)  # weight of one tick in the low-pass filter of velocity, time constant 0.1 s


@kernel
def track_motion(motion: Motion, robot: Robot) -> None:
    """Update a motion with the robot's current position."""
    x, y = robot.x, robot.y
    dx, dy = x - motion.x, y - motion.y
    motion.x, motion.y = x, y
    if dx * dx + dy * dy > CARRIED_DISTANCE * CARRIED_DISTANCE:
        dx, dy = 0.0, 0.0
    motion.vx += (dx * HZ - motion.vx) * FILTER_WEIGHT
    motion.vy += (dy * HZ - motion.vy) * FILTER_WEIGHT


@kernel
def send(walker: Worker, x: float, y: float) -> None:
    """Set a walker's goal, px."""
    route = walker.route
    route.active, route.goal_x, route.goal_y = 1, x, y
    walker.closest, walker.stuck_ticks = 1e9, 0


@kernel
def walk(world: Factory, walker: Worker, speed: float, radius: float) -> int:
    """One tick of walking. Returns 1 if the walker has reached its goal, or as near as robots at rest permit."""
    route = walker.route
    dx, dy = route.goal_x - walker.x, route.goal_y - walker.y
    left = sqrt(dx * dx + dy * dy)
    walker.walking = 0
    if left < ARRIVED:
        return 1
    update_route(world, route, walker.x, walker.y)
    advance(world, walker, left)
    dx, dy = route.waypoint_x - walker.x, route.waypoint_y - walker.y
    distance = sqrt(dx * dx + dy * dy)
    if distance < 1e-6:
        return 0
    pace = min(left, speed * DT)
    ux, uy = pace * dx / distance, pace * dy / distance
    block = in_the_way(world, walker, walker.x + ux, walker.y + uy, radius)
    if block < 0 and step(world, walker, ux, uy, radius):
        if in_the_way(world, walker, walker.x + ux, walker.y + uy, radius + PASSED_MARGIN) < 0:
            walker.side = 0
        return 0
    if block >= 0 and left < ARRIVED_NEAR_ROBOT and not is_driving(world.motions[block]):
        return 1
    go_round(world, walker, block, ux, uy, radius)
    return 0


@kernel
def advance(world: Factory, walker: Worker, left: float) -> None:
    """Count the ticks since a walker last came nearer to its goal, by path length."""
    route = walker.route
    if not route.straight:
        left = CELL * route.reach[free_node(world, walker.x, walker.y)]
    if left < walker.closest - MIN_PROGRESS:
        walker.closest, walker.stuck_ticks = left, 0
    else:
        walker.stuck_ticks += 1


@kernel
def go_round(world: Factory, walker: Worker, block: int, ux: float, uy: float, radius: float) -> None:
    """Step around robot `block` (around a wall if negative), keeping to one side until that is blocked."""
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
def step(world: Factory, walker: Worker, dx: float, dy: float, radius: float) -> bool:
    """Take a step unless a robot or a wall is in the way. Returns True if taken."""
    x, y = walker.x + dx, walker.y + dy
    if in_the_way(world, walker, x, y, radius) >= 0 or in_wall(world, x, y):
        return False
    turn_towards(walker, dx, dy)
    walker.x, walker.y, walker.walking = x, y, 1
    return True


@kernel
def turn_towards(walker: Worker, vx: float, vy: float) -> None:
    """Turn a walker towards its direction of motion, by at most TURN_RATE."""
    turn = turn_to(atan2(vy, vx) - walker.heading)
    limit = TURN_RATE * DT
    if turn > limit:
        turn = limit
    elif turn < -limit:
        turn = -limit
    walker.heading = wrap(walker.heading + turn)


@kernel
def is_driving(motion: Motion) -> bool:
    """True if a robot is moving."""
    return motion.vx * motion.vx + motion.vy * motion.vy > MOVING_SPEED * MOVING_SPEED


@kernel
def in_the_way(world: Factory, walker: Worker, x: float, y: float, radius: float) -> int:
    """The first robot that blocks a step to (x, y), now or within LOOKAHEAD; -1: none. Steps away from it are free."""
    for k in range(ROBOTS):
        robot = world.robots[k]
        if not robot.present:
            continue
        dx, dy = x - robot.x, y - robot.y
        if not (-MAX_RANGE < dx < MAX_RANGE and -MAX_RANGE < dy < MAX_RANGE):
            continue
        motion = world.motions[k]
        samples, reach = (3, MOVING_CLEARANCE) if is_driving(motion) else (1, RESTING_CLEARANCE)
        reach = world.radius + radius + reach
        for half in range(samples):
            ahead = 0.5 * half * LOOKAHEAD
            rx, ry = robot.x + ahead * motion.vx, robot.y + ahead * motion.vy
            dx, dy = x - rx, y - ry
            distance = dx * dx + dy * dy
            if distance < reach * reach:
                ox, oy = walker.x - rx, walker.y - ry
                if distance < ox * ox + oy * oy and path_is_free(world, robot, motion, half):
                    return k
    return -1


@kernel
def path_is_free(world: Factory, robot: Robot, motion: Motion, half: int) -> bool:
    """True if no wall stops a robot within `half` halves of LOOKAHEAD."""
    for part in range(1, half + 1):
        ahead = 0.5 * part * LOOKAHEAD
        if in_wall(world, robot.x + ahead * motion.vx, robot.y + ahead * motion.vy):
            return False
    return True
