"""Explanation of a brain with a Q-table: its three features, and the values of its 18 moves.

Each petal of the rose is the value of the state with the opponent in that direction, and wall and bullet unchanged.
"""

from collections.abc import Iterator
from math import copysign, cos, sin, sqrt

from pigaming_app.ai.brain.thoughts import BULLET, OPPONENT, WALL, MoveKey, Percept, Thoughts, behaviour_of
from pigaming_app.ai.qlearning.features import (
    NONE,
    SECTORS,
    WIDE,
    bullet_of,
    nearest_opponent,
    opponent_of,
    state,
    wall_of,
)
from pigaming_app.ai.qlearning.table import ACTIONS, MOVES, LearnerMind, QTable, max_value, move_probabilities
from pigaming_app.games.pitanks.state import PiTanks

SIGHT = 190.0  # px at which walls and bullets are marked, as features hold directions without distances


def explain(match: PiTanks, seat: int, mind: LearnerMind, weights: QTable) -> Thoughts:
    """Thoughts of the player with a table on `seat`."""
    opponent = nearest_opponent(match, seat)
    if match.tick == 0 or opponent < 0:
        return Thoughts("starts")
    here = mind.state
    values = [float(q) for q in weights.q[here * ACTIONS : (here + 1) * ACTIONS]]
    tried = sum(int(n) for n in weights.n[here * ACTIONS : (here + 1) * ACTIONS])
    likely = move_probabilities(weights, here, weights.knobs.cold)[mind.move]
    move = _plain(mind.move)
    return Thoughts(
        behaviour=behaviour_of(*move),
        reason="tried" if tried else "new",
        names={"count": tried, "percent": round(100.0 * likely)},
        facts={
            "opponent": opponent_of(here),
            "wall": wall_of(here),
            "bullet": bullet_of(here),
            "tried": tried,
            "likely": likely,
        },
        percepts=tuple(_percepts(match, seat, opponent, here)),
        rose=_scaled([float(max_value(weights, state(k, wall_of(here), bullet_of(here)))) for k in range(SECTORS)]),
        moves=dict(zip((_plain(k) for k in range(ACTIONS)), _scaled(values), strict=True)),
        chosen=move,
    )


def _plain(k: int) -> MoveKey:
    linear, angular, fire = MOVES[k]
    return int(linear), int(angular), int(fire)


def _scaled(values: list[float]) -> list[float]:
    """Values scaled to -1..1 by signed square root, since a hit is worth many times any other move."""
    largest = max(abs(value) for value in values)
    return [copysign(sqrt(abs(value) / largest), value) if largest else 0.0 for value in values]


def _percepts(match: PiTanks, seat: int, opponent: int, here: int) -> Iterator[Percept]:
    """The opponent, and the directions of the wall and the bullet."""
    robot, other = match.robots[seat], match.robots[opponent]
    yield Percept(OPPONENT, other.x, other.y)
    for kind, sector in ((WALL, wall_of(here)), (BULLET, bullet_of(here))):
        if sector != NONE:
            angle = robot.heading + sector * WIDE
            yield Percept(kind, robot.x + SIGHT * cos(angle), robot.y + SIGHT * sin(angle))
