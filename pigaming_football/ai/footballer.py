"""The hand-written footballer: roles by cost, as in the robot soccer leagues.

- Role assignment: who meets the ball first chases it, with hysteresis; the other keeps the goal while the ball is near
  it, and else supports. P. Stone, M. Veloso, "Task decomposition, dynamic role assignment, and low-bandwidth
  communication for real-time strategic teamwork", Artificial Intelligence 110, 1999. In a team that plays together
  the last robot leaves the goal only if it is much faster, and supports only a mate who has the ball. The hasty chase.
- Chaser: meets the ball where it will be, from behind, so that it faces the goal once it has the ball.
- Keeper: on the line from the ball to the goal's centre, along which it drives; where a shot will cross it, if one
  comes. Compare T. Röfer et al., "B-Human team report", 2011, section on the goalie.
- Supporter: strategic positioning by attraction and repulsion (SPAR). M. Veloso, M. Bowling, S. Achim, "The CMUnited-98
  small-robot team", RoboCup-98, LNCS 1604, 1999.

Every robot decides for itself, from its team's frame; a human mate is assigned a role like any other.
"""

from math import atan2, pi, sqrt
from typing import Any

from pigaming_app.api.brains import corner_after, escape, set_action, ticks_stuck, turn_stick, update_route
from pigaming_app.api.rules import HEIGHT, WIDTH, is_clear, kernel, turn_to, uniform

from ..observation import FREE, MATE, OPPONENT, OWN, Observation, from_left, observe, polar
from ..rules import side_of
from ..state import LEFT, MIDDLE, Football, Rules
from .mind import BALL, CHASER, FRICTION, KEEPER, PERIOD, SUPPORTER, Mind, clearance, notice, time_to_meet

LOYALTY = 0.35  # s by which another must be faster to take over the chase
NEAR_GOAL = 300.0  # px of the ball from the own goal up to which the last robot of a team leaves it like any other
STAYS = 2.0  # s by which it must be faster to leave for a ball at the other end
FIRST = 0.25  # s by which an opponent must be faster for a lone robot to defend
KICK_OFF = 190.0  # px from the middle, where it awaits the ball
BEHIND = 40.0  # px, room between ball and robot on the way round it
WRONG_SIDE = 1.7  # rad between the ways to the ball and on to the goal, from which it drives round the ball
EITHER_SIDE = 2.6  # rad from which both ways round the ball are about as long, so that it keeps to one
GRASP, GRASP_ANGLE = 75.0, 0.9  # px, rad: FIRE is pressed when the ball is as near
OPEN = 64.0  # px of clearance of an open shot
LONG_SHOT = 750.0  # px
LONGEST = 85  # ticks for which it holds the ball
KEEPER_X, KEEPER_FAR, KEEPER_SHARE = 78.0, 300.0, 0.36  # px, px, and share of the ball's distance: its line
ALONG_WALL = 150.0  # px within which it drives straight at a ball beside a wall, where no robot has room
PASSED = 50.0  # px to a corner of the way round walls, within which it drives to the next one if it can
GRAZE = BALL - 1.0  # px of room on a way on which it may slide along walls
KEEPER_ROOM = 70.0  # px from its line within which it keeps its heading
STUCK_TICKS, STUCK_DISTANCE = 40, 14.0
WEAKEST, STRONGEST = Rules().weakest, Rules().strongest  # px/s, of a shot
AHEAD = ((60.0, -230.0), (60.0, 230.0), (260.0, -190.0), (260.0, 190.0), (420.0, -120.0), (420.0, 120.0))


@kernel
def think(match: Football, seat: int, mind: Mind, weights: Any) -> None:
    """Observe and decide every PERIOD ticks; the action holds in between."""
    if (match.tick + mind.phase) % PERIOD:
        return
    mind.touch = match.radius + BALL
    observe(match, seat, mind, mind.obs)
    notice(mind)
    obs, action = mind.obs, match.actions[seat]
    if mind.freeing:
        mind.since += PERIOD
        if not escape(mind, obs.x, obs.y, action):
            return
        mind.freeing = 0
    choose_role(mind)
    if obs.held == OWN:
        play_ball(match, seat, mind)
    elif mind.role == CHASER:
        chase(match, seat, mind)
    elif mind.role == KEEPER:
        keep_goal(match, seat, mind)
    else:
        support(match, seat, mind)
    idle = abs(action.linear) < 0.3 * mind.speed
    if ticks_stuck(mind, obs.x, obs.y, idle, STUCK_DISTANCE, PERIOD) > STUCK_TICKS:
        mind.freeing, mind.since = 1, 0
        back = -1.0 if action.linear > 0.0 else 1.0
        mind.escape = back if uniform(mind) < 0.8 else -back
        mind.escape_turn = 2.0 * uniform(mind) - 1.0


# -------------------------------------------------------------------------------------------------------------- roles


@kernel
def choose_role(mind: Mind) -> None:
    """Assign the own role by the times in which each robot can meet the ball."""
    obs = mind.obs
    mates, mate_time, rival_time = 0, 1e9, 1e9
    is_last, stays = True, STAYS * max(0.0, mind.seen_x - NEAR_GOAL) / WIDTH if mind.plays else 0.0
    for i in range(3):
        other = obs.others[i]
        if not other.present:
            continue
        bearing = atan2(mind.seen_y - other.y, mind.seen_x - other.x)
        after = time_to_meet(mind, other.x, other.y, turn_to(bearing - other.heading))
        if other.mate:
            mates += 1
            mate_time = min(mate_time, after + stays if other.x < obs.x else after)
            is_last = is_last and obs.x <= other.x
        else:
            rival_time = min(rival_time, after)
    own_time = time_to_meet(mind, obs.x, obs.y, polar(obs, mind.seen_x, mind.seen_y)[1])  # last: it sets the point
    if mind.role == CHASER and mates:
        own_time -= LOYALTY
    if is_last and mates:
        own_time += stays
    if obs.held == OWN or (mind.hasty and obs.held != MATE):
        mind.role = CHASER
    elif obs.held == MATE or (mates and mate_time < own_time):
        defends = mind.plays or obs.held == OPPONENT or mind.seen_x < 0.55 * WIDTH
        mind.role = KEEPER if mind.seen_x < 0.4 * WIDTH or (defends and obs.held != MATE) else SUPPORTER
    elif obs.ball_roll > 0.0 or (obs.held == OPPONENT and obs.x > mind.seen_x - BEHIND):
        mind.role = KEEPER  # their kick-off, or they are past
    elif not mates and obs.ball_roll == 0.0 and rival_time + FIRST < own_time:
        mind.role = KEEPER
    else:
        mind.role = CHASER


@kernel
def chase(match: Football, seat: int, mind: Mind) -> None:
    """Meet the ball, from behind if there is time for it, and catch it."""
    obs = mind.obs
    x, y = mind.meet_x, mind.meet_y
    if obs.held == OPPONENT:  # the ball is what it must bump into
        drive_to(match, seat, mind, mind.seen_x, mind.seen_y, 1, 0)
        return
    if obs.ball_roll < 0.0:  # the own kick-off
        x -= KICK_OFF
    gx, gy = WIDTH - x, MIDDLE - y
    length = sqrt(gx * gx + gy * gy) + 1e-9
    off = turn_to(atan2(y - obs.y, x - obs.x) - atan2(gy, gx))
    if (
        abs(off) > WRONG_SIDE
        and not mind.hasty
        and clearance(obs, x, y, x, y, False) > 260.0
        and obs.ball_distance > 1.2 * mind.touch
    ):
        room = mind.touch + BEHIND
        if abs(off) < EITHER_SIDE or mind.side == 0.0:
            mind.side = 1.0 if off > 0.0 else -1.0
        x += -gx / length * room * 0.6 - mind.side * gy / length * room
        y += -gy / length * room * 0.6 + mind.side * gx / length * room
    else:
        mind.side = 0.0
    drive_to(match, seat, mind, x, min(max(y, 36.0), HEIGHT - 36.0), 1, grasp(mind, obs))


@kernel
def grasp(mind: Mind, obs: Observation) -> int:
    """1 if FIRE should be pressed to catch the ball."""
    near = obs.ball_distance - mind.touch < GRASP and abs(obs.ball_bearing) < GRASP_ANGLE
    return 1 if near and obs.held == FREE and obs.ball_out == 0.0 and obs.can_catch else 0


@kernel
def play_ball(match: Football, seat: int, mind: Mind) -> None:
    """With the ball: shoot if the way is open, else pass, else carry it towards the more open side of the goal."""
    obs = mind.obs
    if mind.hasty:  # wherever it looks
        steer(match, seat, mind, 1.0, 0.0, 0, 0)
        return
    corner = obs.mouth - 50.0 if obs.mouth > 90.0 else 0.4 * obs.mouth
    up = clearance(obs, obs.x, obs.y, WIDTH, MIDDLE - corner, False)
    down = clearance(obs, obs.x, obs.y, WIDTH, MIDDLE + corner, False)
    x, y, charge = WIDTH, MIDDLE - corner if up > down else MIDDLE + corner, 0.6
    is_open = max(up, down) > OPEN
    shoots = is_open and obs.goal_distance < LONG_SHOT
    if not shoots and mind.plays:
        for i in range(3):
            mate = obs.others[i]
            if mate.present and mate.mate and mate.x > obs.x - 60.0 and 220.0 < mate.distance < 900.0:
                lane = clearance(obs, obs.x, obs.y, mate.x, mate.y, False)
                if lane > OPEN and clearance(obs, mate.x, mate.y, WIDTH, MIDDLE, False) > 0.7 * max(up, down):
                    shoots = True
                    x, y = mate.x + 0.5 * mate.vx + 60.0, mate.y + 0.5 * mate.vy
                    charge = (sqrt(220.0 * 220.0 + 2.0 * FRICTION * mate.distance) - WEAKEST) / (STRONGEST - WEAKEST)
    _, angle = polar(obs, x, y)
    angle = turn_to(angle + mind.bias)
    distance = sqrt((x - obs.x) * (x - obs.x) + (y - obs.y) * (y - obs.y))
    tolerance = 0.05 + 0.4 * mind.error + 25.0 / (distance + 50.0)
    late = mind.held >= LONGEST and abs(obs.goal_bearing) < 1.7
    release = late or (shoots and abs(angle) < tolerance and obs.charge >= charge)
    ahead = 1.0 if abs(angle) < 0.7 else 0.35
    if shoots and abs(angle) < 0.3 and obs.charge < charge:
        ahead = 0.6
    steer(match, seat, mind, ahead, angle, 0 if release else 1, 0)


@kernel
def keep_goal(match: Football, seat: int, mind: Mind) -> None:
    """Stand between ball and goal, heading along the line on which to drive; catch the ball if it is at the front."""
    obs = mind.obs
    reach = min(obs.mouth, 150.0)
    line = min(max(KEEPER_SHARE * mind.seen_x, KEEPER_X), KEEPER_FAR)
    gap = max(mind.seen_x - line, 1.0)
    y = MIDDLE + (mind.seen_y - MIDDLE) * line / (line + gap)
    if mind.seen_vx < -120.0:
        crossing = mind.seen_y + mind.seen_vy * gap / -mind.seen_vx
        if abs(crossing - MIDDLE) < obs.mouth + 60.0:
            y = crossing
    y = min(max(y, MIDDLE - reach), MIDDLE + reach)
    dx, dy = line - obs.x, y - obs.y
    fire = grasp(mind, obs)
    if abs(dx) > KEEPER_ROOM or abs(dy) > 240.0:
        drive_to(match, seat, mind, line, y, 1 if dx < -120.0 else 0, fire)
        return
    if fire and obs.ball_distance < mind.touch + 30.0:
        steer(match, seat, mind, 0.5, obs.ball_bearing, fire, 0)
        return
    up = abs(turn_to(obs.heading + 0.5 * pi)) < abs(turn_to(obs.heading - 0.5 * pi))
    ahead = -1.0 if up else 1.0
    off = turn_to((-0.5 * pi if up else 0.5 * pi) - obs.heading)
    off -= ahead * 0.006 * dx * (1.0 if dy * ahead >= 0.0 else -1.0)  # back to its line while it drives
    drives = ahead * dy / 45.0 if abs(off) < 0.6 and abs(dy) > 8.0 else 0.0
    steer(match, seat, mind, drives, off, fire, 0)


@kernel
def support(match: Football, seat: int, mind: Mind) -> None:
    """Go where a pass can reach it: attracted by open lanes and the goal, repelled by opponents and the mate."""
    obs = mind.obs
    best, best_x, best_y = -1e9, obs.x, obs.y
    for ahead, aside in AHEAD:
        x = min(max(mind.seen_x + ahead, 200.0), WIDTH - 170.0)
        y = min(max(mind.seen_y + aside, 130.0), HEIGHT - 130.0)
        dx, dy = x - obs.x, y - obs.y
        value = 1.5 * min(clearance(obs, mind.seen_x, mind.seen_y, x, y, False), 130.0)
        value += min(clearance(obs, x, y, WIDTH, MIDDLE, False), 130.0) + min(clearance(obs, x, y, x, y, True), 200.0)
        value -= 0.25 * sqrt(dx * dx + dy * dy) - 0.1 * x
        if value > best:
            best, best_x, best_y = value, x, y
    dx, dy = best_x - obs.x, best_y - obs.y
    if dx * dx + dy * dy < 60.0 * 60.0 or obs.ball_distance < mind.touch + GRASP:
        steer(match, seat, mind, 0.0, polar(obs, mind.seen_x, mind.seen_y)[1], grasp(mind, obs), 0)
    else:
        drive_to(match, seat, mind, best_x, best_y, 0, grasp(mind, obs))


# ------------------------------------------------------------------------------------------------------------- driving


@kernel
def drive_to(match: Football, seat: int, mind: Mind, x: float, y: float, hurry: int, fire: int) -> None:
    """Drive to a point, in the team's frame, round the walls; in a `hurry` with turbo, and without slowing down."""
    obs, robot, route = mind.obs, match.robots[seat], mind.route
    sign = 1.0 if side_of(robot) == LEFT else -1.0
    route.active, route.goal_x, route.goal_y = 1, from_left(x, WIDTH, sign), from_left(y, HEIGHT, sign)
    update_route(match, route, robot.x, robot.y)
    way_x, way_y = from_left(route.waypoint_x, WIDTH, sign), from_left(route.waypoint_y, HEIGHT, sign)
    distance, angle = polar(obs, way_x, way_y)
    if not route.straight:
        gap, straight = polar(obs, x, y)
        if gap < ALONG_WALL and is_clear(match, robot.x, robot.y, route.goal_x, route.goal_y, GRAZE):
            distance, angle = gap, straight
        elif distance < PASSED:
            node_x, node_y = corner_after(route)
            if is_clear(match, robot.x, robot.y, node_x, node_y, GRAZE):
                distance, angle = polar(obs, from_left(node_x, WIDTH, sign), from_left(node_y, HEIGHT, sign))
    ahead = 1.0
    if not fire and abs(angle) > 2.3 and distance < 160.0:
        angle, ahead = turn_to(angle + pi), -1.0
    if abs(angle) > 1.1:
        ahead *= 0.15
    elif abs(angle) > 0.5:
        ahead *= 0.6
    if not hurry and distance < 70.0:
        ahead *= 0.3 + 0.7 * distance / 70.0
    fast = 1 if hurry and mind.turbo and distance > 170.0 and abs(angle) < 0.3 and obs.turbo > 0.3 else 0
    steer(match, seat, mind, ahead, angle, fire, fast)


@kernel
def steer(match: Football, seat: int, mind: Mind, ahead: float, angle: float, fire: int, turbo: int) -> None:
    """Set the action that turns by `angle` and drives `ahead` (-1..1), as fast as the level permits."""
    obs = mind.obs
    turn = turn_stick(angle, obs.angular, obs.turn_rate, PERIOD)
    turn = min(max(turn, -mind.speed), mind.speed)
    set_action(match.actions[seat], min(max(ahead, -1.0), 1.0) * mind.speed, turn, fire, turbo)
