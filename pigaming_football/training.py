"""Robot Football as PPO learns it: alone and in pairs, against the footballer by hand, itself and earlier copies.

Goals count; so does, as a potential that a policy gains nothing from in the long run, where the ball is, and how near
the nearest robot of the team is to it (A. Ng, D. Harada, S. Russell, "Policy invariance under reward transformations",
ICML 1999).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import sqrt
from typing import Any

import numpy as np

from pigaming_app.api.learning import Tallies, Task
from pigaming_app.api.rules import WIDTH, kernel

from .network import ENCODING
from .rules import lead_of, side_of
from .state import LEFT, MIDDLE, Football

LEAD, FIELD, NEARNESS, WON, TIED, LOST = range(6)  # gauges
FAR = 900.0  # px


@kernel
def gauge(match: Football, seat: int, inputs: Any, gauges: Any) -> None:
    """Lead of the team, end of the match, place of the ball between the goals, and nearness of the team to it."""
    side, ball = side_of(match.robots[seat]), match.ball
    lead = lead_of(match, side)
    gauges[LEAD] = lead
    if match.over:
        gauges[WON if lead > 0 else LOST if lead < 0 else TIED] = 1.0
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


@dataclass(frozen=True)
class FootballRewards:
    """Rewards of the decisions."""

    goal: float  # also the cost of one conceded
    win: float
    tie: float
    defeat: float
    first_advance: float  # weight of the ball's place, at the begin and at the end of the training
    advance: float
    first_chase: float  # weight of the nearness to the ball
    chase: float

    def __call__(self, gains: Any, inputs: Any, choices: Any, share: float) -> Any:
        """Rewards (T, S)."""
        advance = self.first_advance + (self.advance - self.first_advance) * share
        chase = self.first_chase + (self.chase - self.first_chase) * share
        play = self.goal * gains[..., LEAD] + advance * gains[..., FIELD] + chase * gains[..., NEARNESS]
        ends = self.win * gains[..., WON] + self.tie * gains[..., TIED] + self.defeat * gains[..., LOST]
        return play.astype(np.float32) + ends


@dataclass(frozen=True)
class FootballHabits:
    """How late a network sees others and the ball in a match."""

    late: float  # share of the matches
    latest: float  # s

    def __call__(self, random: Any) -> Mapping[str, float]:
        """Fields of a network's senses."""
        return {"delay": random.random() * self.latest if random.random() < self.late else 0.0}


TASK = Task(
    encoding=ENCODING,
    gauges=("lead", "field", "nearness", "won", "tied", "lost"),
    gauge=gauge,
    reward=FootballRewards,
    habits=FootballHabits,
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
    ("goals", "assists", "shots", "own_goals", "lead", "field", "win"), {"lead": 2.0, "field": 1.0, "win": 5.0}, tally
)
