"""Motion of the ball: a disc that rolls between walls, goal posts and moving robots.

In every tick each robot has moved on a straight line, and the ball moves against all of them from contact to contact
(event-driven simulation with swept circles), so that it tunnels through nothing at any speed. A contact reverses the
normal part of the relative velocity and multiplies it by the coefficient of restitution. Robots are not pushed.

Invariants, after every tick:

- The ball overlaps no wall, no post and no robot by more than SLOP px, and all its numbers are finite.
- It has left the pitch only through a goal.

Where there is no room for it, `settle` finds some, or the ball is dropped anew.
"""

from math import atan2, cos, sin, sqrt

from pigaming_app.api.rules import ROBOTS, WIDTH, kernel, turn_to

from .contacts import LINE, ROBOT, bounce_off, first_contact, reflect, touch
from .overlaps import give_way, is_free, nearest_free
from .state import DT, MIDDLE, NOBODY, Football

CONTACTS = 12  # in a tick, after which the ball stays where it is for the rest of it
CARRIED = 26.0  # px in a tick: a robot that moved further was carried by hand
WAY = 20.0  # px: how far a ball gives way
GRIP = 1.0  # px between a robot and the ball that it holds
GRIP_DECAY = 0.8  # of the angle of a held ball, per tick
TORN = 3600.0  # px^2: a robot farther than that from its place behind the ball has lost it
NOTHING, SCORED, CAUGHT, NOWHERE = range(4)  # results of a move


@kernel
def note_steps(match: Football) -> None:
    """Record how far each robot has moved since the last tick."""
    for k in range(ROBOTS):
        robot, player = match.robots[k], match.players[k]
        dx, dy = robot.x - player.last_x, robot.y - player.last_y
        if dx * dx + dy * dy > CARRIED * CARRIED:
            dx, dy = 0.0, 0.0
        player.dx, player.dy = dx, dy
        player.last_x, player.last_y = robot.x, robot.y


@kernel
def slow_down(match: Football) -> None:
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
def roll(match: Football) -> int:
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
def carry(match: Football) -> int:
    """Move a held ball with its holder, until something is in its way, where the holder loses it. As `roll`."""
    ball = match.ball
    k = ball.holder - 1
    robot, player = match.robots[k], match.players[k]
    ball.grip *= GRIP_DECAY
    reach, angle = match.radius + match.rules.radius + GRIP, robot.heading + ball.grip
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
def lose(match: Football) -> None:
    """End the hold of the ball."""
    ball = match.ball
    player = match.players[ball.holder - 1]
    player.armed, player.cooldown = 0, match.rules.cooldown
    ball.holder, ball.charge, ball.grip = NOBODY, 0, 0.0


@kernel
def can_catch(match: Football, k: int) -> int:
    """1 if robot k would catch a ball at its front."""
    player = match.players[k]
    return 1 if match.actions[k].fire and player.armed and not player.cooldown else 0


@kernel
def bearing_of_ball(match: Football, k: int, x: float, y: float) -> float:
    """Bearing of the ball from robot k at (x, y), rad."""
    return turn_to(atan2(match.ball.y - y, match.ball.x - x) - match.robots[k].heading)


@kernel
def catch(match: Football, k: int, bearing: float) -> None:
    """Let robot k hold the ball, at this bearing."""
    ball = match.ball
    touch(ball, k)
    ball.holder, ball.charge, ball.grip = k + 1, 0, bearing
    ball.vx, ball.vy = 0.0, 0.0


@kernel
def bounce_off_robot(match: Football, k: int, left: float) -> int:
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
def settle(match: Football, from_x: float, from_y: float) -> int:
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
