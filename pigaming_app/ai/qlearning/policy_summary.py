"""What a Q-table has made of one direction of the opponent: how good it finds to have it there, and what it does then.

The states of a direction (walls and bullets differ) count by how often they were seen; what it does in each is what a
trained robot would: the roulette over exp(Q / T) at the last temperature.
"""

from dataclasses import dataclass
from typing import Any

from pigaming_app.ai.qlearning.features import PLACES
from pigaming_app.ai.qlearning.learner import ACTIONS, MOVES

STATES = PLACES * PLACES  # of one direction
CLEAR = 0.05  # share beyond chance from which on it has made up its mind


@dataclass(frozen=True)
class Direction:
    """`seen`: decisions with the opponent there; `worth`: Q of the best move tried, mean; `shares`: of the 18 moves."""

    seen: int
    worth: float
    shares: tuple[float, ...]

    @property
    def deed(self) -> str:
        """What it does more than by chance, in one word; "unknown" where it has not made up its mind."""
        excess = {word: -DEEDS.count(word) / ACTIONS for word in DEEDS}
        for share, word in zip(self.shares, DEEDS, strict=True):
            excess[word] += share
        best = max(excess, key=lambda word: excess[word])
        return best if self.seen and excess[best] > CLEAR else "unknown"


def deed(linear: float, angular: float, fire: int) -> str:
    """One word for a move."""
    if fire:
        return "shoot"
    if angular:
        return "turn_right" if angular > 0.0 else "turn_left"
    if linear:
        return "ahead" if linear > 0.0 else "behind"
    return "stay"


DEEDS = tuple(deed(move.linear, move.angular, move.fire) for move in MOVES)


def direction(table: Any, sector: int, cold: float) -> Direction:
    """What a table, of either body, has made of the opponent in a sector, 0..15; `cold`: the last temperature."""
    import numpy as np

    first, last = sector * STATES * ACTIONS, (sector + 1) * STATES * ACTIONS
    tried = np.asarray(table.n[first:last]).reshape(STATES, ACTIONS)
    often = tried.sum(axis=1)
    seen = int(often.sum())
    if not seen:
        return Direction(0, 0.0, (0.0,) * ACTIONS)
    there = often > 0
    weight = often[there] / seen
    q = np.asarray(table.q[first:last]).reshape(STATES, ACTIONS)[there]
    most = q.max(axis=1)
    odds = np.exp((q - most[:, None]) / cold)
    odds /= odds.sum(axis=1, keepdims=True)
    weights = np.where(tried[there] > 0, q, -np.inf).max(axis=1)
    return Direction(seen, float(weight @ weights), tuple(float(share) for share in weight @ odds))
