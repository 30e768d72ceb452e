"""Motion of the ball: a disc that rolls between walls, goal posts and moving robots.

In every tick each robot has moved on a straight line, and the ball moves against all of them from contact to contact
(event-driven simulation with swept circles), so that it tunnels through nothing at any speed. A contact reverses the
normal part of the relative velocity and multiplies it by the coefficient of restitution; spin is ignored. Robots are
not pushed.

Invariants, after every tick:

- The ball overlaps no wall, no post and no robot by more than SLOP px, and all its numbers are finite.
- It has left the pitch only through a goal.

A ball between robots and a wall that leave no room for it first gives way (`give_way`), else lies at the nearest free
place that no wall separates from it (`nearest_free`), else it is dropped anew.

Source: D. Baraff, "Fast contact force computation for nonpenetrating rigid bodies", SIGGRAPH 1994, section 2; the sweep
is that of `sim/sweep.py`.
"""

from math import atan2, cos, sin, sqrt
from typing import Any

from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.grid import NEAR_UNIT, node_at
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.sweep import FAR, disc_contact, is_clear, offset_from_wall, wall_contact
from pigaming_app.sim.world import DT, HEIGHT, ROBOTS, WIDTH

from .state import LEFT, MIDDLE, NOBODY, RIGHT

SLOP = 1e-6  # px, for rounding
CONTACTS = 12  # in a tick, after which the ball stays where it is for the rest of it
UNSEEN = 14.0  # px: from a node without a wall near it, the ball reaches none within this distance
CARRIED = 26.0  # px in a tick: a robot that moved further was carried by hand
GIVING, WAY = 8, 20.0  # rounds, px: how far a ball gives way
RING, RINGS, ANGLES = 10.0, 24, 24  # px between, and number of, the circles on which a free place is sought
GRIP = 1.0  # px between a robot and the ball that it holds
GRIP_DECAY = 0.8  # of the angle of a held ball, per tick
TORN = 3600.0  # px^2: a robot farther than that from its place behind the ball has lost it
NOTHING, SCORED, CAUGHT, NOWHERE = range(4)  # results of a move
X_RIM, Y_RIM, LINE, POST, WALL, ROBOT = 1, 2, 3, 10, 100, 200  # obstacles; the last three count upwards from here


@kernel
def note_steps(match: Any) -> None:
    """Record how far each robot has moved since the last tick."""
    for k in range(ROBOTS):
        robot, player = match.robots[k], match.players[k]
        dx, dy = robot.x - player.last_x, robot.y - player.last_y
        if dx * dx + dy * dy > CARRIED * CARRIED:
            dx, dy = 0.0, 0.0
        player.dx, player.dy = dx, dy
        player.last_x, player.last_y = robot.x, robot.y


@kernel
def slow_down(match: Any) -> None:
    """Rolling friction of one tick."""
    ball = match.ball
    speed = sqrt(ball.vx * ball.vx + ball.vy * ball.vy)
    loss = match.rules.friction * DT
    if speed <= loss:
        ball.vx, ball.vy = 0.0, 0.0
    else:
        ball.vx *= (speed - loss) / speed
        ball.vy *= (speed - loss) / speed


@kernel
def roll(match: Any) -> int:
    """Move a free ball for one tick. Returns NOTHING, SCORED (it is on the line of a goal), or CAUGHT."""
    ball = match.ball
    left = 1.0  # share of the tick
    for _ in range(CONTACTS):
        dx, dy = ball.vx * DT * left, ball.vy * DT * left
        hit, t = first_contact(match, dx, dy, left, NOBODY)
        if hit == 0:
            ball.x += dx
            ball.y += dy
            return NOTHING
        ball.x += dx * t
        ball.y += dy * t
        left -= left * t
        if hit == LINE:
            return SCORED
        if hit >= ROBOT:
            k = hit - ROBOT
            touch(ball, k)
            if bounce_off_robot(match, k, left):
                return CAUGHT
        else:
            bounce_off(match, hit)
    return NOTHING


@kernel
def carry(match: Any) -> int:
    """Move a held ball with its holder, until something is in its way, where the holder loses it. As `roll`."""
    ball = match.ball
    k = ball.holder - 1
    robot, player = match.robots[k], match.players[k]
    ball.grip *= GRIP_DECAY
    reach, angle = RADIUS + match.rules.radius + GRIP, robot.heading + ball.grip
    dx, dy = robot.x + reach * cos(angle) - ball.x, robot.y + reach * sin(angle) - ball.y
    if dx * dx + dy * dy > TORN:  # it was carried
        lose(match)
        return NOTHING
    hit, t = first_contact(match, dx, dy, 1.0, ball.holder)
    ball.vx, ball.vy = player.dx / DT, player.dy / DT
    if hit == 0:
        ball.x += dx
        ball.y += dy
        return NOTHING
    ball.x += dx * t
    ball.y += dy * t
    if hit == LINE:
        return SCORED
    lose(match)
    if hit >= ROBOT:
        touch(ball, hit - ROBOT)
        bounce_off_robot(match, hit - ROBOT, 1.0 - t)
    else:
        bounce_off(match, hit)
    return NOTHING


@kernel
def lose(match: Any) -> None:
    """End the hold of the ball."""
    ball = match.ball
    player = match.players[ball.holder - 1]
    player.armed, player.cooldown = 0, match.rules.cooldown
    ball.holder, ball.charge, ball.grip = NOBODY, 0, 0.0


@kernel
def touch(ball: Any, k: int) -> None:
    """Record that robot k has touched the ball."""
    if ball.touched != k + 1:
        ball.before, ball.touched = ball.touched, k + 1


@kernel
def can_catch(match: Any, k: int) -> int:
    """1 if robot k would catch a ball at its front."""
    player = match.players[k]
    return 1 if match.actions[k].fire and player.armed and not player.cooldown else 0


@kernel
def bearing_of_ball(match: Any, k: int, x: float, y: float) -> float:
    """Bearing of the ball from robot k at (x, y), rad."""
    return turn_to(atan2(match.ball.y - y, match.ball.x - x) - match.robots[k].heading)


@kernel
def catch(match: Any, k: int, bearing: float) -> None:
    """Let robot k hold the ball, at this bearing."""
    ball = match.ball
    touch(ball, k)
    ball.holder, ball.charge, ball.grip = k + 1, 0, bearing
    ball.vx, ball.vy = 0.0, 0.0


# ------------------------------------------------------------------------------------------------------------ contacts


@kernel
def first_contact(match: Any, dx: float, dy: float, left: float, holder: int) -> tuple[int, float]:
    """The first obstacle, 0 for none, of the ball moving by (dx, dy) in the last `left` share of a tick, and the time.

    Its holder is none. An obstacle that the ball touches already counts only if it moves into it.
    """
    ball = match.ball
    x, y, radius = ball.x, ball.y, match.rules.radius
    hit, first = rim_contact(match, x, y, dx, dy)
    if match.grid[node_at(x, y)] >= NEAR_UNIT or dx * dx + dy * dy > UNSEEN * UNSEEN:
        slack = RADIUS - radius - SLOP  # the walls' bounding boxes include RADIUS
        west, east = (x + slack, x + dx - slack) if dx > 0.0 else (x + dx + slack, x - slack)
        north, south = (y + slack, y + dy - slack) if dy > 0.0 else (y + dy + slack, y - slack)
        for i in range(match.wall_count):
            wall = match.walls[i]
            if west < wall.right and east > wall.left and north < wall.bottom and south > wall.top and wall.health:
                t = wall_contact(x, y, dx, dy, wall, radius)
                if t < first:
                    nx, ny = offset_from_wall(wall, x, y)
                    if t > 0.0 or dx * nx + dy * ny < 0.0:
                        hit, first = WALL + i, t
    for k in range(ROBOTS):
        robot, player = match.robots[k], match.players[k]
        if robot.present and k + 1 != holder:
            rx, ry = robot.x - player.dx * left, robot.y - player.dy * left
            ux, uy = dx - player.dx * left, dy - player.dy * left
            t = disc_contact(x, y, ux, uy, rx, ry, RADIUS + radius)
            if t < first and (t > 0.0 or ux * (x - rx) + uy * (y - ry) < 0.0):
                hit, first = ROBOT + k, t
    return hit, first


@kernel
def rim_contact(match: Any, x: float, y: float, dx: float, dy: float) -> tuple[int, float]:
    """First contact with the rim, a post, or the line of a goal (of the ball's centre), as `first_contact`."""
    radius, half = match.rules.radius, match.mouth
    hit, first = 0, FAR
    if radius <= x <= WIDTH - radius and radius < x + dx < WIDTH - radius and radius < y + dy < HEIGHT - radius:
        return hit, first  # from within, since the pitch is convex
    if dy < 0.0 and y + dy <= radius:
        t = (radius - y) / dy
        hit, first = Y_RIM, t if t > 0.0 else 0.0
    elif dy > 0.0 and y + dy >= HEIGHT - radius:
        t = (HEIGHT - radius - y) / dy
        hit, first = Y_RIM, t if t > 0.0 else 0.0
    for side in (LEFT, RIGHT):
        line = 0.0 if side == LEFT else WIDTH
        inwards = 1.0 if side == LEFT else -1.0
        if (x + dx - line) * inwards > radius:
            continue
        if dx * inwards < 0.0:
            t = (line + inwards * radius - x) / dx
            if t < 0.0:
                t = 0.0
            if t < first and abs(y + dy * t - MIDDLE) >= half:
                hit, first = X_RIM, t
            t = (line - x) / dx
            if t < 0.0:
                t = 0.0
            if t <= 1.0 and t < first and abs(y + dy * t - MIDDLE) < half:
                hit, first = LINE, t
        for post in (0, 1):
            py = MIDDLE + half if post else MIDDLE - half
            t = disc_contact(x, y, dx, dy, line, py, radius)
            if t < first and (t > 0.0 or dx * (x - line) + dy * (y - py) < 0.0):
                hit, first = POST + 2 * side + post, t
    return hit, first


@kernel
def bounce_off(match: Any, hit: int) -> None:
    """Reflect the ball off rim, post or wall."""
    ball = match.ball
    if hit == X_RIM:
        reflect(ball, 1.0 if ball.x < 0.5 * WIDTH else -1.0, 0.0, 0.0, 0.0, match.rules.bounce)
    elif hit == Y_RIM:
        reflect(ball, 0.0, 1.0 if ball.y < MIDDLE else -1.0, 0.0, 0.0, match.rules.bounce)
    elif hit < WALL:
        side, post = (hit - POST) // 2, (hit - POST) % 2
        nx, ny = ball.x - (0.0 if side == LEFT else WIDTH), ball.y - (MIDDLE + match.mouth * (2 * post - 1))
        reflect(ball, nx, ny, 0.0, 0.0, match.rules.bounce)
    else:
        nx, ny = offset_from_wall(match.walls[hit - WALL], ball.x, ball.y)
        reflect(ball, nx, ny, 0.0, 0.0, match.rules.bounce)


@kernel
def bounce_off_robot(match: Any, k: int, left: float) -> int:
    """Reflect the ball off robot k, `left` of the tick before its end; 1 if it catches it instead."""
    ball, robot, player = match.ball, match.robots[k], match.players[k]
    x, y = robot.x - player.dx * left, robot.y - player.dy * left
    if ball.holder == NOBODY and can_catch(match, k):
        bearing = bearing_of_ball(match, k, x, y)
        if abs(bearing) <= match.rules.catch_angle:
            catch(match, k, bearing)
            return 1
    reflect(ball, ball.x - x, ball.y - y, player.dx / DT, player.dy / DT, match.rules.robot_bounce)
    return 0


@kernel
def reflect(ball: Any, nx: float, ny: float, ux: float, uy: float, restitution: float) -> None:
    """Reflect the ball off an obstacle with velocity (ux, uy); (nx, ny), of any length, points from it to the ball.

    Newton's law of impact: separating speed = restitution * approaching speed.
    """
    length2 = nx * nx + ny * ny
    approach = (ball.vx - ux) * nx + (ball.vy - uy) * ny
    if approach < 0.0 and length2 > 0.0:
        ball.vx -= (1.0 + restitution) * approach / length2 * nx
        ball.vy -= (1.0 + restitution) * approach / length2 * ny


# ------------------------------------------------------------------------------------------------------------ overlaps


@kernel
def settle(match: Any, from_x: float, from_y: float) -> int:
    """See to it that the ball overlaps nothing; (from_x, from_y): where it did not. NOTHING, SCORED, or NOWHERE."""
    ball = match.ball
    if is_free(match, ball.x, ball.y):
        return NOTHING
    if ball.holder:
        lose(match)
    x, y = ball.x, ball.y
    if give_way(match):
        dx, dy = ball.x - x, ball.y - y
        if dx * dx + dy * dy < WAY * WAY:
            return NOTHING
    elif (ball.x <= 0.0 or ball.x >= WIDTH) and abs(ball.y - MIDDLE) < match.mouth:
        return SCORED
    ball.vx, ball.vy = 0.0, 0.0
    return NOTHING if nearest_free(match, from_x, from_y) else NOWHERE


@kernel
def give_way(match: Any) -> int:
    """Push the ball straight out of what it overlaps, a few times in turn. 1 if it is free then."""
    ball, radius = match.ball, match.rules.radius
    for _ in range(GIVING):
        for k in range(ROBOTS):
            robot, player = match.robots[k], match.players[k]
            if robot.present and push_out(ball, ball.x - robot.x, ball.y - robot.y, RADIUS + radius):
                touch(ball, k)
                reflect(ball, ball.x - robot.x, ball.y - robot.y, player.dx / DT, player.dy / DT, 0.0)
        for i in range(match.wall_count):
            wall = match.walls[i]
            if wall.health:
                nx, ny = offset_from_wall(wall, ball.x, ball.y)
                if push_out(ball, nx, ny, wall.half + radius):
                    reflect(ball, nx, ny, 0.0, 0.0, 0.0)
        push_inside(match)
        if is_free(match, ball.x, ball.y):
            return 1
    return 0


@kernel
def push_out(ball: Any, nx: float, ny: float, reach: float) -> int:
    """Move the ball along (nx, ny), its offset from an obstacle, until that is `reach` px long. 1 if it was shorter."""
    gap2 = nx * nx + ny * ny
    if gap2 >= reach * reach or gap2 == 0.0:
        return 0
    gap = sqrt(gap2)
    ball.x += nx / gap * (reach - gap)
    ball.y += ny / gap * (reach - gap)
    return 1


@kernel
def push_inside(match: Any) -> None:
    """Move the ball back from rim and posts, but not out of a goal."""
    ball, radius = match.ball, match.rules.radius
    ball.y = min(max(ball.y, radius), HEIGHT - radius)
    if abs(ball.y - MIDDLE) >= match.mouth:
        ball.x = min(max(ball.x, radius), WIDTH - radius)
    for side in (LEFT, RIGHT):
        for post in (-1.0, 1.0):
            push_out(ball, ball.x - (0.0 if side == LEFT else WIDTH), ball.y - MIDDLE - post * match.mouth, radius)


@kernel
def is_free(match: Any, x: float, y: float) -> int:
    """1 if a ball at (x, y) overlaps neither rim, posts, walls nor robots."""
    radius, half = match.rules.radius, match.mouth
    if not radius - SLOP <= y <= HEIGHT - radius + SLOP:
        return 0
    if not radius - SLOP <= x <= WIDTH - radius + SLOP:
        aside = abs(y - MIDDLE)
        if not (aside < half and 0.0 <= x <= WIDTH):
            return 0
        nx, ny = min(x, WIDTH - x), half - aside
        if nx * nx + ny * ny < (radius - SLOP) * (radius - SLOP):
            return 0
    reach = RADIUS + radius - SLOP
    for robot in match.robots:
        if robot.present:
            dx, dy = x - robot.x, y - robot.y
            if dx * dx + dy * dy < reach * reach:
                return 0
    if match.grid[node_at(x, y)] >= NEAR_UNIT:
        for i in range(match.wall_count):
            wall = match.walls[i]
            if wall.health:
                dx, dy = offset_from_wall(wall, x, y)
                reach = wall.half + radius - SLOP
                if dx * dx + dy * dy < reach * reach:
                    return 0
    return 1


@kernel
def nearest_free(match: Any, x: float, y: float) -> int:
    """Put the ball at the free place nearest to (x, y), on the pitch and not behind a wall. 0 if none is near."""
    ball, radius = match.ball, match.rules.radius
    for ring in range(RINGS):
        for i in range(ANGLES if ring else 1):
            angle = i * 6.283185307179586 / ANGLES
            at_x, at_y = x + RING * ring * cos(angle), y + RING * ring * sin(angle)
            if (
                radius <= at_x <= WIDTH - radius
                and is_free(match, at_x, at_y)
                and is_clear(match, x, y, at_x, at_y, 0.0)
            ):
                ball.x, ball.y = at_x, at_y
                return 1
    return 0
