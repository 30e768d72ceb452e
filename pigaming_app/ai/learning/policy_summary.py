"""Summary of a Q-table by direction of the opponent: mean value, move probabilities and the typical behaviour.

States of a direction (with different walls and bullets) are weighted by their visits. The policy in each state is that
of a trained robot: probabilities proportional to exp(Q / T) at the final temperature.
"""

from dataclasses import dataclass

from pigaming_app.ai.qlearning.features import PLACES
from pigaming_app.ai.qlearning.table import ACTIONS, MOVES, QTable

STATES = PLACES * PLACES  # states per direction
CLEAR = 0.05  # excess over a uniform policy that counts as a preference


@dataclass(frozen=True)
class Direction:
    """Summary for one sector.

    `seen`: decisions with the opponent there; `value`: mean over them of the best tried Q; `shares`: probabilities of
    the 18 moves.
    """

    seen: int
    value: float
    shares: tuple[float, ...]

    @property
    def action(self) -> str:
        """The behaviour with the largest excess over a uniform policy; "unknown" if the excess is below CLEAR."""
        excess = {word: -ACTION_NAMES.count(word) / ACTIONS for word in ACTION_NAMES}
        for share, word in zip(self.shares, ACTION_NAMES, strict=True):
            excess[word] += share
        best = max(excess, key=lambda word: excess[word])
        return best if self.seen and excess[best] > CLEAR else "unknown"


def action_name(linear: float, angular: float, fire: int) -> str:
    """Class of a move, a key of the texts."""
    if fire:
        return "shoot"
    if angular:
        return "turn_right" if angular > 0.0 else "turn_left"
    if linear:
        return "ahead" if linear > 0.0 else "behind"
    return "stay"


ACTION_NAMES = tuple(action_name(move.linear, move.angular, move.fire) for move in MOVES)


def direction(table: QTable, sector: int, cold: float) -> Direction:
    """Summary of a table (plain or NumPy record) for the opponent in `sector`, 0..15; `cold`: final temperature."""
    import numpy as np

    first, last = sector * STATES * ACTIONS, (sector + 1) * STATES * ACTIONS
    tried = np.asarray(table.n[first:last]).reshape(STATES, ACTIONS)
    visits = tried.sum(axis=1)
    seen = int(visits.sum())
    if not seen:
        return Direction(0, 0.0, (0.0,) * ACTIONS)
    visited = visits > 0
    weight = visits[visited] / seen
    q = np.asarray(table.q[first:last]).reshape(STATES, ACTIONS)[visited]
    highest = q.max(axis=1)
    odds = np.exp((q - highest[:, None]) / cold)
    odds /= odds.sum(axis=1, keepdims=True)
    values = np.where(tried[visited] > 0, q, -np.inf).max(axis=1)
    return Direction(seen, float(weight @ values), tuple(float(share) for share in weight @ odds))
