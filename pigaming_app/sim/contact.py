"""Inelastic contact between robots, and between robots and walls: robots slide along walls and push each other apart.

Every robot first moves freely; overlaps are then resolved along their normals, so that motion along a wall is kept.
Two invariants hold after every tick if they held before it:

- No robot is in a wall. One that still touches a wall after the last round returns to its position before the tick.
- No two robots overlap by more than OVERLAP px. Two that do, and by more than before the tick, both return.

A robot that is put back (`Robot.recover`) jumps, before the tick, to a position at which both hold.

Proof: at the position to which a robot returns the first invariant held already, and two that have both returned are as
far apart as before; each returns at most once, so the loop ends. A tick moves a robot by at most SHOVE px, so that no
crush catapults a robot.
"""

from math import sqrt

from pigaming_app.sim.grid import NEAR_UNIT, node_at
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.robot import integrate
from pigaming_app.sim.sweep import FAR, offset_from_wall, wall_contact
from pigaming_app.sim.world import HEIGHT, ROBOTS, WIDTH, Robot, World

ROUNDS, MAX_ROUNDS = 6, 24  # limits on rounds of overlap resolution: usually, and in a crush
SHOVE = 16.0  # px, the longest step in a tick with contact
SLOP = 1e-6  # px by which a robot may overlap a wall, for rounding
CRUSH = 0.5  # px of overlap above which ROUNDS is exceeded
OVERLAP = 1.5  # px, permitted between two robots
BERTH = 8.0  # px between a robot that is put back and any other
ALL = (1 << ROBOTS) - 1  # a bit for each robot
TOUCHED, MOVED = 1, 2  # by a wall


@kernel
def drive(world: World) -> None:
    """One tick of motion: fulfil requests to be put back, integrate every present robot, then resolve contacts."""
    robots = world.robots
    for k in range(ROBOTS):
        if robots[k].recover:
            put_back(world, k)
    r0, r1, r2, r3 = robots[0], robots[1], robots[2], robots[3]
    x0, y0, x1, y1 = r0.x, r0.y, r1.x, r1.y
    x2, y2, x3, y3 = r2.x, r2.y, r3.x, r3.y
    for robot in robots:
        if robot.present:
            integrate(robot)
    touched = 0
    shifted, unsettled = 0, ALL  # a bit for each robot: moved by contact; perhaps still in a wall
    for n in range(MAX_ROUNDS):
        deepest = separate(world)
        if deepest > 0.0:
            shifted = unsettled = ALL
        moved = deepest > SLOP
        checked, unsettled = unsettled, 0
        for k in range(ROBOTS):
            if checked & 1 << k and robots[k].present:
                push = push_out_of_walls(world, robots[k])
                if push:
                    unsettled |= 1 << k
                    moved = moved or push == MOVED
        shifted |= unsettled
        if not moved or (n >= ROUNDS and deepest < CRUSH):
            break
        touched = 1
    if not touched:
        return
    limit_step(world, r0, x0, y0, shifted & 1)
    limit_step(world, r1, x1, y1, shifted & 2)
    limit_step(world, r2, x2, y2, shifted & 4)
    limit_step(world, r3, x3, y3, shifted & 8)
    near2 = (2.0 * world.radius - OVERLAP) * (2.0 * world.radius - OVERLAP)
    back = 1
    while back:
        back = undo_overlap(near2, r0, x0, y0, r1, x1, y1)
        back += undo_overlap(near2, r0, x0, y0, r2, x2, y2)
        back += undo_overlap(near2, r0, x0, y0, r3, x3, y3)
        back += undo_overlap(near2, r1, x1, y1, r2, x2, y2)
        back += undo_overlap(near2, r1, x1, y1, r3, x3, y3)
        back += undo_overlap(near2, r2, x2, y2, r3, x3, y3)


@kernel
def put_back(world: World, k: int) -> None:
    """Put robot k at rest at the pose that the game requests for it, as soon as no other robot stands there."""
    robot = world.robots[k]
    if is_free(world, k, robot.recover_x, robot.recover_y):
        robot.x, robot.y, robot.heading = robot.recover_x, robot.recover_y, robot.recover_heading
        robot.linear, robot.angular, robot.recover = 0.0, 0.0, 0


@kernel
def is_free(world: World, k: int, x: float, y: float) -> bool:
    """True if robot k would touch no other robot at (x, y)."""
    berth = 2.0 * world.radius + BERTH
    for j in range(ROBOTS):
        other = world.robots[j]
        dx, dy = other.x - x, other.y - y
        if j != k and other.present and dx * dx + dy * dy < berth * berth:
            return False
    return True


@kernel
def separate(world: World) -> float:
    """Push overlapping robots apart, half the overlap each. Returns the deepest overlap in px."""
    robots, width, deepest = world.robots, 2.0 * world.radius, 0.0
    width2 = width * width
    for i in range(ROBOTS - 1):
        robot = robots[i]
        if not robot.present:
            continue
        for j in range(i + 1, ROBOTS):
            other = robots[j]
            if not other.present:
                continue
            dx, dy = other.x - robot.x, other.y - robot.y
            distance2 = dx * dx + dy * dy
            if distance2 >= width2:
                continue
            distance = sqrt(distance2)
            if distance > 1e-9:
                nx, ny = dx / distance, dy / distance
            else:  # on the same spot: any direction will do
                nx, ny = 1.0, 0.0
            push = 0.5 * (width - distance)
            robot.x -= push * nx
            robot.y -= push * ny
            other.x += push * nx
            other.y += push * ny
            if 2.0 * push > deepest:
                deepest = 2.0 * push
    return deepest


@kernel
def push_out_of_walls(world: World, robot: Robot) -> int:
    """Move a robot that overlaps a wall straight out of it. Returns 0, MOVED, or TOUCHED if by no more than SLOP.

    A robot exactly on the centre line of a wall stays there, TOUCHED.
    """
    moved, radius = 0, world.radius
    if robot.x < radius:
        robot.x = radius
        moved = MOVED
    elif robot.x > WIDTH - radius:
        robot.x = WIDTH - radius
        moved = MOVED
    if robot.y < radius:
        robot.y = radius
        moved = MOVED
    elif robot.y > HEIGHT - radius:
        robot.y = HEIGHT - radius
        moved = MOVED
    if world.grid[node_at(robot.x, robot.y)] < NEAR_UNIT:
        return moved
    for i in range(world.wall_count):
        wall = world.walls[i]
        if wall.left < robot.x < wall.right and wall.top < robot.y < wall.bottom and wall.health:
            dx, dy = offset_from_wall(wall, robot.x, robot.y)
            reach = wall.half + radius
            gap2 = dx * dx + dy * dy
            if gap2 < reach * reach:
                gap = sqrt(gap2)
                moved = moved or TOUCHED
                if gap > 1e-9:
                    robot.x += dx / gap * (reach - gap)
                    robot.y += dy / gap * (reach - gap)
                    if reach - gap > SLOP:
                        moved = MOVED
    return moved


@kernel
def in_wall(world: World, x: float, y: float) -> int:
    """1 if a robot with its centre at (x, y) would overlap a wall."""
    radius = world.radius
    if x < radius or x > WIDTH - radius or y < radius or y > HEIGHT - radius:
        return 1
    if world.grid[node_at(x, y)] < NEAR_UNIT:
        return 0
    for i in range(world.wall_count):
        wall = world.walls[i]
        if wall.left < x < wall.right and wall.top < y < wall.bottom and wall.health:
            dx, dy = offset_from_wall(wall, x, y)
            reach = wall.half + radius - SLOP
            if dx * dx + dy * dy < reach * reach:
                return 1
    return 0


@kernel
def limit_step(world: World, robot: Robot, from_x: float, from_y: float, shifted: int = 1) -> None:
    """Limit a robot's step from (from_x, from_y) to SHOVE px, and undo it if it ends in a wall.

    One that contact has not `shifted` ends in none.
    """
    dx, dy = robot.x - from_x, robot.y - from_y
    way2 = dx * dx + dy * dy
    if way2 > SHOVE * SHOVE:
        share = SHOVE / sqrt(way2)
        robot.x = from_x + share * dx
        robot.y = from_y + share * dy
        shifted = 1
    if shifted and in_wall(world, robot.x, robot.y):
        robot.x = from_x
        robot.y = from_y


@kernel
def undo_overlap(near2: float, robot: Robot, x1: float, y1: float, other: Robot, x2: float, y2: float) -> int:
    """Return two robots to (x1, y1) and (x2, y2) if they overlap too far, and farther than there. 1 if it did.

    `near2`: px^2 between their centres, below which they overlap too far.
    """
    if not robot.present or not other.present:
        return 0
    dx, dy = other.x - robot.x, other.y - robot.y
    now = dx * dx + dy * dy
    if now >= near2:
        return 0
    dx, dy = x2 - x1, y2 - y1
    if now >= dx * dx + dy * dy:
        return 0
    robot.x, robot.y, other.x, other.y = x1, y1, x2, y2
    return 1


@kernel
def first_wall(world: World, x: float, y: float, dx: float, dy: float, radius: float) -> tuple[int, float]:
    """The first inner wall, -1 for none, that a circle meets on its way by (dx, dy), and the time.

    Times as in `sweep`: shares of the way, FAR (2) for none. A wall that it touches already counts only if the circle
    moves into it. The rim of the arena is no inner wall. The circle is no
    wider than a robot.
    """
    hit, first = -1, FAR
    unseen = world.radius - radius
    if world.grid[node_at(x, y)] < NEAR_UNIT and (unseen > 0.0 and dx * dx + dy * dy <= unseen * unseen):
        return hit, first
    slack = world.radius - radius - SLOP  # the walls' bounding boxes include a robot's radius
    west, east = (x + slack, x + dx - slack) if dx > 0.0 else (x + dx + slack, x - slack)
    north, south = (y + slack, y + dy - slack) if dy > 0.0 else (y + dy + slack, y - slack)
    for i in range(world.wall_count):
        wall = world.walls[i]
        if west < wall.right and east > wall.left and north < wall.bottom and south > wall.top and wall.health:
            t = wall_contact(x, y, dx, dy, wall, radius)
            if t < first:
                nx, ny = offset_from_wall(wall, x, y)
                if t > 0.0 or dx * nx + dy * ny < 0.0:
                    hit, first = i, t
    return hit, first
