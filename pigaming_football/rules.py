"""Rules of Robot Football: put the ball into the other team's goal.

Robots push the ball. FIRE catches one at the robot's front; the longer it is held, for at most two seconds, the harder
it is shot when the button is released. A robot that holds the ball is a little slower, and loses it to anything that
the ball bumps into. A goal counts once the ball's centre is over the line, for the robot of the scoring team that
touched it last; an own goal counts for the other team. A goal of the team that is behind counts two.

After a goal the robots play on from where they are. Real robots cannot be moved by the rules, so the ball returns to
the middle two seconds later, and rolls to the team that conceded. A ball that rests in reach of nobody for five
seconds, or gets nowhere for nine, is dropped anew.

If the score is level at the end, the next goal wins. By the cup rules every goal counts one; by the party rules the
ball is lighter and livelier, and now and then golden: it counts two for either team.
"""

from math import cos, sin, sqrt
from typing import Any

from pigaming_app.api.rules import ROBOTS, WIDTH, kernel, steer, stop_all, uniform

from .overlaps import is_free, nearest_free
from .physics import (
    NOWHERE,
    SCORED,
    bearing_of_ball,
    can_catch,
    carry,
    catch,
    lose,
    note_steps,
    roll,
    settle,
    slow_down,
)
from .state import LEFT, MIDDLE, NOBODY, RIGHT, Football

RESTING = 6.0  # px/s, below which a ball counts as resting
PROGRESS = 60.0  # px by which a ball gets anywhere
ANEW = 150.0  # px between a jammed ball and the place where it is dropped
ROOM = 30.0  # px around a ball that is dropped
TIE = 1e-9  # px


@kernel
def judge(match: Football) -> None:
    """One tick of the rules: the ball moves as the robots have, then catches, shots and restarts, then their speeds."""
    if match.over:
        stop_all(match)
        return
    note_steps(match)
    ball = match.ball
    if ball.out:
        wait(match)
    else:
        move(match)
        if not ball.out:
            watch_rest(match)
    for k in range(ROBOTS):
        if match.robots[k].present:
            count_down(match, k)
    if not ball.out:
        use_feet(match)
    for k in range(ROBOTS):
        if match.robots[k].present:
            steer(match, k, match.rules.held_speed if ball.holder == k + 1 else 1.0)
    match.tick += 1
    if match.tick >= match.rules.ticks and is_decided(match):
        match.over = 1


@kernel
def is_decided(match: Football) -> bool:
    """True if one side leads, or no time of the overtime is left. The first such tick begins the overtime."""
    lead = lead_of(match, LEFT)
    if lead == 0 and match.tick < match.rules.ticks + match.rules.overtime:
        match.golden_goal = 1
        return False
    return True


@kernel
def lead_of(match: Football, side: int) -> int:
    """Goals of the team on one side less those of the other."""
    lead = 0
    for robot in match.robots:
        if robot.present:
            lead += robot.score if side_of(robot) == side else -robot.score
    return lead


@kernel
def side_of(robot: Any) -> int:
    """The side that a robot defends: LEFT for the first team, RIGHT for the second."""
    return LEFT if robot.team % 2 == 0 else RIGHT


# ------------------------------------------------------------------------------------------------------------ the ball


@kernel
def move(match: Football) -> None:
    """One tick of the ball in play; a goal, or a drop if there is no place for it."""
    ball = match.ball
    x, y = ball.x, ball.y
    if ball.holder:
        result = carry(match)
    else:
        slow_down(match)
        result = roll(match)
    if result != SCORED:
        result = settle(match, x, y)
    if result == SCORED:
        score(match)
    elif result == NOWHERE:
        drop(match, 0.0)


@kernel
def wait(match: Football) -> None:
    """Count down to the drop of the ball, which is postponed while there is no place for it."""
    ball = match.ball
    ball.out -= 1
    if ball.out == 0:
        if not nearest_free(match, ball.x, ball.y):
            ball.out = match.rules.warning
            choose_drop(match, 0.0)
            return
        ball.vx, ball.vy = ball.roll, 0.0
        ball.anchor_x, ball.anchor_y, ball.still, ball.alone = ball.x, ball.y, 0, 0


@kernel
def take_out(match: Football, x: float, y: float, ticks: int, speed: float) -> None:
    """Take the ball out of play for some ticks, until it is dropped at (x, y) and rolls along x."""
    ball = match.ball
    if ball.holder:
        lose(match)
    ball.x, ball.y, ball.vx, ball.vy, ball.out, ball.roll = x, y, 0.0, 0.0, ticks, speed
    ball.touched, ball.before = NOBODY, NOBODY
    ball.worth = 1
    if match.rules.golden > 0.0 and uniform(match) < match.rules.golden:
        ball.worth = 2


@kernel
def drop(match: Football, away: float) -> None:
    """Announce the drop of the ball at the nearest free place for it that is at least `away` px from it."""
    choose_drop(match, away)
    take_out(match, match.ball.x, match.ball.y, match.rules.warning, 0.0)


@kernel
def choose_drop(match: Football, away: float) -> None:
    """Move the ball to the nearest drop point that is free and `away` px off; of several, to any. Else it stays."""
    ball = match.ball
    begin = int(uniform(match) * match.drop_count)
    best, least = -1, 1e18
    for i in range(match.drop_count):
        j = (begin + i) % match.drop_count
        dx, dy = match.drops[j].x - ball.x, match.drops[j].y - ball.y
        distance2 = dx * dx + dy * dy
        if away * away <= distance2 < least - TIE and has_room(match, match.drops[j].x, match.drops[j].y):
            best, least = j, distance2
    if best >= 0:
        ball.x, ball.y = match.drops[best].x, match.drops[best].y


@kernel
def has_room(match: Football, x: float, y: float) -> bool:
    """True if a ball dropped at (x, y) is free and at least ROOM px from every robot."""
    if not is_free(match, x, y):
        return False
    reach = match.radius + match.rules.radius + ROOM
    for robot in match.robots:
        if robot.present:
            dx, dy = robot.x - x, robot.y - y
            if dx * dx + dy * dy < reach * reach:
                return False
    return True


@kernel
def watch_rest(match: Football) -> None:
    """Drop a ball anew that rests in reach of nobody, or gets nowhere."""
    ball, rules = match.ball, match.rules
    dx, dy = ball.x - ball.anchor_x, ball.y - ball.anchor_y
    if dx * dx + dy * dy > PROGRESS * PROGRESS:
        ball.anchor_x, ball.anchor_y, ball.still = ball.x, ball.y, 0
    ball.still += 1
    if ball.vx * ball.vx + ball.vy * ball.vy < RESTING * RESTING and not ball.holder and not in_reach(match):
        ball.alone += 1
    else:
        ball.alone = 0
    if ball.still >= rules.jammed:
        drop(match, ANEW)
    elif ball.alone >= rules.lonely:
        drop(match, 0.0)


@kernel
def in_reach(match: Football) -> bool:
    """True if a robot is near the ball."""
    ball, reach = match.ball, match.radius + match.rules.radius + match.rules.near
    for robot in match.robots:
        if robot.present:
            dx, dy = robot.x - ball.x, robot.y - ball.y
            if dx * dx + dy * dy < reach * reach:
                return True
    return False


@kernel
def score(match: Football) -> None:
    """The ball is on a goal's line: count the goal, and announce the kick-off."""
    ball = match.ball
    conceded = LEFT if ball.x < 0.5 * WIDTH else RIGHT
    match.goals += 1
    match.goal_side, match.goal_y = conceded, ball.y
    last, before = ball.touched - 1, ball.before - 1
    if last >= 0 and side_of(match.robots[last]) == conceded:
        match.players[last].own_goals += 1
        last, before = before, -1
    if last < 0 or side_of(match.robots[last]) == conceded:
        last = -1
        for k in range(ROBOTS):
            if last < 0 and match.robots[k].present and side_of(match.robots[k]) != conceded:
                last = k
    elif ball.touched - 1 == last:
        match.players[last].goals += 1
        if before >= 0 and before != last and side_of(match.robots[before]) != conceded:
            match.players[before].assists += 1
    if last >= 0:
        match.robots[last].score += worth_for(match, last)
    speed = match.rules.kick_off
    take_out(match, 0.5 * WIDTH, MIDDLE, match.rules.celebration, -speed if conceded == LEFT else speed)


@kernel
def worth_for(match: Football, k: int) -> int:
    """Points of a goal of robot k with the present ball: more if its team is behind."""
    worth, catch_up = match.ball.worth, match.rules.catch_up
    return max(worth, catch_up) if lead_of(match, side_of(match.robots[k])) < 0 else worth


# ------------------------------------------------------------------------------------------------------------- holding


@kernel
def count_down(match: Football, k: int) -> None:
    """One tick of a robot's timer, and of the button that catches again only after it was up."""
    player = match.players[k]
    if player.cooldown:
        player.cooldown -= 1
    if not match.actions[k].fire:
        player.armed = 1


@kernel
def use_feet(match: Football) -> None:
    """Shoot a held ball when its holder's button is up or the time is over; else let the nearest robot catch it."""
    ball, rules = match.ball, match.rules
    if ball.holder:
        ball.charge += 1
        if not match.actions[ball.holder - 1].fire or ball.charge >= rules.hold:
            shoot(match)
        return
    nearest, least = -1, match.radius + rules.radius + rules.catch_reach
    for k in range(ROBOTS):
        robot = match.robots[k]
        if robot.present and can_catch(match, k):
            dx, dy = ball.x - robot.x, ball.y - robot.y
            distance = sqrt(dx * dx + dy * dy)
            if distance > least + TIE or abs(bearing_of_ball(match, k, robot.x, robot.y)) > rules.catch_angle:
                continue
            if nearest < 0 or distance < least - TIE or uniform(match) < 0.5:
                nearest, least = k, distance
    if nearest >= 0:
        catch(match, nearest, bearing_of_ball(match, nearest, match.robots[nearest].x, match.robots[nearest].y))


@kernel
def charge_of(match: Football) -> float:
    """The charge of the held ball, full from 1 on."""
    return match.ball.charge / match.rules.charge


@kernel
def shoot(match: Football) -> None:
    """Shoot the held ball away from its holder."""
    ball, rules = match.ball, match.rules
    k = ball.holder - 1
    share = min(1.0, charge_of(match))
    speed = (rules.weakest + (rules.strongest - rules.weakest) * share) / rules.mass
    angle = match.robots[k].heading + ball.grip
    lose(match)
    ball.vx, ball.vy = speed * cos(angle), speed * sin(angle)
    match.players[k].shots += 1
