"""Robot Football as PPO learns it: alone and in pairs, against the footballer by hand, itself and earlier copies.

Goals count; so does, as a potential that a policy gains nothing from in the long run, where the ball is, and how near
the nearest robot of the team is to it (A. Ng, D. Harada, S. Russell, "Policy invariance under reward transformations",
ICML 1999).
"""

from collections.abc import Mapping
from math import sqrt
from typing import Any

import numpy as np

from pigaming_app.api.learning import Hyper, LineUp, Tallies, Task
from pigaming_app.api.rules import WIDTH, kernel

from .network import ENCODING
from .rules import lead_of, side_of
from .state import LEFT, MIDDLE, Football

LEAD, FIELD, NEARNESS = range(3)  # gauges
POINT = 2.0  # reward of a goal, and cost of one conceded
ADVANCE, ADVANCED = 1.5, 0.5  # weight of the ball's place, at the begin and at the end of the training
CHASE, CHASED = 1.0, 0.3  # weight of the nearness to the ball
WIN = 2.0  # reward of a win; a tie costs a quarter of it
FAR = 900.0  # px
LATE, LATEST = 0.2, 0.3  # share of matches in which others and the ball are seen late, and the longest delay, s


@kernel
def gauge(match: Football, seat: int, inputs: Any, gauges: Any) -> None:
    """Lead of the team, place of the ball between the goals, and nearness of the team to it."""
    side, ball = side_of(match.robots[seat]), match.ball
    gauges[LEAD] = lead_of(match, side)
    if ball.out:
        return
    theirs = sqrt((WIDTH - ball.x) * (WIDTH - ball.x) + (ball.y - MIDDLE) * (ball.y - MIDDLE))
    ours = sqrt(ball.x * ball.x + (ball.y - MIDDLE) * (ball.y - MIDDLE))
    gauges[FIELD] = (ours - theirs) / WIDTH if side == LEFT else (theirs - ours) / WIDTH
    nearest = FAR
    for robot in match.robots:
        if robot.present and side_of(robot) == side:
            dx, dy = robot.x - ball.x, robot.y - ball.y
            nearest = min(nearest, sqrt(dx * dx + dy * dy))
    gauges[NEARNESS] = 1.0 - nearest / FAR


@kernel
def result(match: Football, seat: int) -> float:
    """Reward of the end of a match."""
    lead = lead_of(match, side_of(match.robots[seat]))
    return WIN if lead > 0 else -WIN if lead < 0 else -0.25 * WIN


def reward(gains: Any, inputs: Any, choices: Any, share: float) -> Any:
    """Rewards (T, S) of the decisions."""
    advance, chase = ADVANCE + (ADVANCED - ADVANCE) * share, CHASE + (CHASED - CHASE) * share
    return (POINT * gains[..., LEAD] + advance * gains[..., FIELD] + chase * gains[..., NEARNESS]).astype(np.float32)


def habits(random: Any) -> Mapping[str, float]:
    """How late a network sees others and the ball in a match."""
    return {"delay": random.random() * LATEST if random.random() < LATE else 0.0}


def pairs(share: int, rival: str) -> LineUp:
    """Two of the learner against two of a rival."""
    return LineUp(share, ("learner", rival, "learner", rival))


def alone(share: int, rival: str) -> LineUp:
    """One against one."""
    return LineUp(share, ("learner", rival, "off", "off"))


TASK = Task(
    encoding=ENCODING,
    arenas=("classic", "bumpers", "small_goals"),
    variants=("standard", "cup", "party"),
    minutes=(2.0,),
    line_ups=(
        pairs(5, "hand3"),
        pairs(4, "hand2"),
        pairs(2, "hand1"),
        pairs(3, "learner"),
        pairs(4, "pool"),
        alone(3, "hand3"),
        alone(2, "hand2"),
        alone(2, "learner"),
        alone(2, "pool"),
        LineUp(1, ("learner", "hand3", "learner", "off")),
        LineUp(1, ("learner", "hand3", "pool", "hand2")),
    ),
    gauges=("lead", "field", "nearness"),
    gauge=gauge,
    result=result,
    reward=reward,
    rivals=("hand3", "hand2"),
    habits=habits,
    cut=0.01,
    hyper=Hyper(matches=192, epochs=3, entropy=0.008, last_entropy=0.001, discount=0.99),
    sharpness=2.0,
)


@kernel
def tally(match: Football, seat: int, senses: Any, totals: Any) -> None:
    """Own goals, assists and shots, goals in the own goal, lead of the team, place of the ball, and the win."""
    player, side = match.players[seat], side_of(match.robots[seat])
    ahead = lead_of(match, side)
    totals[0], totals[1], totals[2] = player.goals, player.assists, player.shots
    totals[3], totals[4] = player.own_goals, ahead
    along = match.ball.x / WIDTH if side == LEFT else 1.0 - match.ball.x / WIDTH
    totals[5] = 0.5 if match.ball.out else along
    totals[6] = (ahead > 0) - (ahead < 0) if match.over else 0.0


TALLIES = Tallies(
    ("goals", "assists", "shots", "own_goals", "lead", "field", "win"),
    {"lead": 2.0, "field": 1.0, "win": 5.0},
    tally,
)
