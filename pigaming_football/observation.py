"""Observations of Robot Football, in a team's own frame: its own goal on the left, the other one on the right.

The right team's frame is turned by half a circle, so that one brain plays for either side.
"""

from math import atan2, pi, sqrt, tau
from typing import Annotated, Any

from pigaming_app.api.rules import HEIGHT, ROBOTS, WIDTH, kernel, record, turn_to

from .rules import charge_of, lead_of, side_of
from .state import DT, LEFT, MIDDLE, Football

FREE, OWN, MATE, OPPONENT = range(4)  # `Observation.held`
OTHERS = ROBOTS - 1


@record
class MovingRobot:
    """Another robot, in seat order after the own seat."""

    present: int
    mate: int
    x: float
    y: float
    heading: float
    vx: float  # px/s
    vy: float
    distance: float
    bearing: float  # relative to the own heading, rad, clockwise positive


@record
class Observation:
    """The observation of one seat: px, px/s, rad, s."""

    x: float
    y: float
    heading: float
    linear: float
    angular: float
    turbo: float
    turn_rate: float
    ball_x: float
    ball_y: float
    ball_vx: float
    ball_vy: float
    ball_distance: float
    ball_bearing: float
    ball_out: float  # s until it is dropped there; 0: in play
    ball_roll: float  # px/s, along x, when it is dropped
    worth: int  # goals for which it counts
    held: int  # FREE, or by whom
    charge: float  # of the shot, 0..1
    can_catch: int  # 1: FIRE would catch a ball at the front, or holds one
    goal_distance: float  # to the centre of the other goal
    goal_bearing: float
    mouth: float  # half the width of the goals
    lead: int  # goals
    seconds: float  # of the regular time; 0: overtime
    others: Annotated[list[MovingRobot], OTHERS]


@kernel
def observe(match: Football, seat: int, senses: Any, obs: Observation) -> None:
    """Fill in the observation of one seat."""
    robot, ball, player = match.robots[seat], match.ball, match.players[seat]
    side = side_of(robot)
    sign = 1.0 if side == LEFT else -1.0
    turn = 0.0 if side == LEFT else pi
    obs.x, obs.y = from_left(robot.x, WIDTH, sign), from_left(robot.y, HEIGHT, sign)
    obs.heading, obs.linear, obs.angular = turned(robot.heading, turn), robot.linear, robot.angular
    obs.turbo, obs.turn_rate = robot.turbo, match.rules.turn_rate
    obs.ball_x, obs.ball_y = from_left(ball.x, WIDTH, sign), from_left(ball.y, HEIGHT, sign)
    obs.ball_vx, obs.ball_vy = sign * ball.vx, sign * ball.vy
    obs.ball_distance, obs.ball_bearing = polar(obs, obs.ball_x, obs.ball_y)
    obs.ball_out, obs.worth = ball.out * DT, ball.worth
    obs.ball_roll = sign * ball.roll if ball.out else 0.0
    obs.held, obs.charge = FREE, 0.0
    if ball.holder:
        obs.held = OPPONENT
        if ball.holder == seat + 1:
            obs.held = OWN
            obs.charge = min(1.0, charge_of(match))
        elif side_of(match.robots[ball.holder - 1]) == side:
            obs.held = MATE
    obs.can_catch = 1 if player.armed and not player.cooldown else 0
    obs.goal_distance, obs.goal_bearing = polar(obs, WIDTH, MIDDLE)
    obs.mouth, obs.lead = match.mouth, lead_of(match, side)
    left = (match.rules.ticks - match.tick) * DT
    obs.seconds = left if left > 0.0 else 0.0
    for i in range(OTHERS):
        j = (seat + 1 + i) % ROBOTS
        seen, other = match.robots[j], obs.others[i]
        other.present, other.mate = seen.present, 1 if side_of(seen) == side else 0
        other.x, other.y = from_left(seen.x, WIDTH, sign), from_left(seen.y, HEIGHT, sign)
        other.heading = turned(seen.heading, turn)
        other.vx, other.vy = sign * match.players[j].dx / DT, sign * match.players[j].dy / DT
        other.distance, other.bearing = polar(obs, other.x, other.y)


@kernel
def from_left(value: float, size: float, sign: float) -> float:
    """A coordinate in the frame of the left team (sign 1) or the right one (-1); its own inverse."""
    return value if sign > 0.0 else size - value


@kernel
def turned(heading: float, turn: float) -> float:
    """A heading in [0, 2 pi) turned by `turn`, 0 or half a circle."""
    return heading + turn - tau if heading + turn >= tau else heading + turn


@kernel
def polar(obs: Observation, x: float, y: float) -> tuple[float, float]:
    """Distance and bearing of a point from the own pose, px and rad."""
    dx, dy = x - obs.x, y - obs.y
    return sqrt(dx * dx + dy * dy), turn_to(atan2(dy, dx) - obs.heading)
