"""The brain that plays by a trained Q-table."""

from collections.abc import Callable
from typing import Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.brain.unstick import act_on_reflex
from pigaming_app.ai.qlearning.features import nearest_opponent, situation
from pigaming_app.ai.qlearning.table import LearnerMind, QTable, apply_move, sample_move
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import packed, unpack
from pigaming_app.sim.rng import seeded


@kernel
def think(match: PiTanks, seat: int, mind: LearnerMind, weights: QTable) -> None:
    """At every decision draw a move at the final temperature, unless the reflex overrides it."""
    if match.tick % weights.knobs.period:
        return
    opponent = nearest_opponent(match, seat)
    if opponent >= 0 and not act_on_reflex(match, seat, opponent, mind, weights.knobs.period):
        mind.state = situation(match, seat, opponent, weights.knobs.incoming)
        mind.move = sample_move(weights, mind.state, weights.knobs.cold, mind)
        apply_move(match.actions[seat], mind.move)


def reset(mind: LearnerMind, seed: int) -> None:
    """Initialise a mind that follows the table alone."""
    mind.random = seeded(seed)


def reset_with_reflex(mind: LearnerMind, seed: int) -> None:
    """Initialise a mind whose reflex frees the robot when it is stuck."""
    reset(mind, seed)
    mind.reflex.on = 1


class Learned:
    """A trained table as the `weights` of a brain. The NumPy or plain copy is made on first use and cached."""

    def __init__(self, table: QTable) -> None:
        """`table`: a plain record, or a row of one NumPy record."""
        plain = isinstance(table, QTable)
        self.bodies: dict[bool, Any] = {not plain: [table] if plain else table}

    def __call__(self, fast: bool) -> Any:
        """A row of one table, a NumPy record (`fast`) or a plain one."""
        if fast not in self.bodies:
            other = self.bodies[not fast]
            self.bodies[fast] = packed(other) if fast else [unpack(QTable, other[0])]
        return self.bodies[fast]


def player(name: str, weights: Callable[[bool], Any], reflex: bool = False) -> BrainKind:
    """A brain that plays by a table; `reflex`: it also frees itself when stuck, as in matches against people."""
    return BrainKind(name, LearnerMind, think, reset_with_reflex if reflex else reset, weights)
