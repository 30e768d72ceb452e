"""The task of a game that has an encoding and none of its own: points, the lead, and the win.

It learns on all arenas by all rules, against the levels, itself and earlier copies.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from pigaming_app.ai.networks.encoding import Encoding, Inputs
from pigaming_app.ai.ppo.task import LEARNER, POOL, LineUp, Task, versus
from pigaming_app.games.arenas import shipped_arenas
from pigaming_app.games.registry import games
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import ROBOTS

POINTS, LEAD, WON, TIED, LOST = range(5)  # gauges
RIVALS = ("level3", "level1")


@kernel
def points_of(match: MatchState, team: int) -> int:
    """The points of a team."""
    total = 0
    for robot in match.robots:
        if robot.present and robot.team == team:
            total += robot.score
    return total


@kernel
def gauge(match: MatchState, seat: int, inputs: Inputs, gauges: list[float]) -> None:
    """Points of the team, its lead over the best other one, and the end of the match."""
    own = points_of(match, match.robots[seat].team)
    best, others = 0, 0
    for robot in match.robots:
        if robot.present and robot.team != match.robots[seat].team:
            other = points_of(match, robot.team)
            if not others or other > best:
                best = other
            others = 1
    gauges[POINTS], gauges[LEAD] = own, own - best
    if match.over:
        gauges[WON if own > best else LOST if own < best else TIED] = 1.0


@dataclass(frozen=True)
class PointRewards:
    """Rewards of the decisions."""

    point: float = 0.5
    lead: float = 0.5
    win: float = 2.0
    tie: float = -0.5
    defeat: float = -2.0

    def __call__(self, gains: np.ndarray, inputs: np.ndarray, choices: np.ndarray, share: float) -> Any:
        """Rewards (T, S)."""
        weights = np.array([self.point, self.lead, self.win, self.tie, self.defeat], np.float32)
        return gains @ weights


def standard_task(encoding: Encoding) -> Task:
    """The task of a game by its points."""
    game = games()[encoding.game]
    variant = game.default
    return Task(
        encoding=encoding,
        gauges=("points", "lead", "won", "tied", "lost"),
        gauge=gauge,
        reward=PointRewards(),
        arenas=tuple(shipped_arenas(game.name)),
        variants=tuple(game.variants),
        minutes=(float(variant.default_minutes),),
        line_ups=tuple(_line_ups(game.name, variant.name)),
        rivals=RIVALS,
    )


def _line_ups(game: str, variant: str) -> Iterator[LineUp]:
    for other in ("level1", "level3", LEARNER, POOL):
        yield versus(game, other, variant)
        if len({*games()[game].variants[variant].teams}) == ROBOTS:
            yield LineUp(1, (LEARNER, other, other, other))
