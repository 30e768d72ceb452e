"""Whole matches of one game, each with brains of its own on the seats, in one loop, plain or compiled."""

from collections.abc import Sequence
from typing import Any

from pigaming_app.ai.brain.baselines import IDLE
from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.experiments.cast import Cast
from pigaming_app.ai.experiments.rollout import compiled_rollout, plain_rollout
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.batch import initial_states
from pigaming_app.games.game import Setup
from pigaming_app.games.registry import games
from pigaming_app.sim.record import packed, unpack
from pigaming_app.sim.world import HZ, ROBOTS

OFF = "off"  # an empty seat


class LineUps:
    """Plays matches among some brains. The loop is compiled once for all of them."""

    def __init__(self, game: str, brains: Sequence[str], fast: bool) -> None:
        """`fast`: compiled; needs numba, and no brain that is `plain`. Raises ChoiceError for unknown brains."""
        self.game, self.fast = game, fast
        self.kinds: dict[str, BrainKind] = {OFF: IDLE} | {name: find_brain(game, name) for name in brains}
        self._cast = Cast(self.kinds.values(), fast)

    def played(self, setups: Sequence[Setup]) -> list[Any]:
        """The final state of each match. Every seat names one of the brains, or is off. Raises ArenaError."""
        states = initial_states(setups)
        matches = packed(states) if self.fast else states
        minds = self._cast.minds([self._seated(setup) for setup in setups])
        loop = (compiled_rollout if self.fast else plain_rollout)(self.game, self._cast.families)
        loop(matches, minds, self._cast.weights, max(longest(setup) for setup in setups))
        return [unpack(games()[self.game].state, row) for row in matches] if self.fast else states

    def _seated(self, setup: Setup) -> list[tuple[BrainKind, int]]:
        """Brain and seed of every seat, as `new_match` has them."""
        return [(self.kinds[seat.brain], setup.seed * ROBOTS + i) for i, seat in enumerate(setup.seats)]


def longest(setup: Setup) -> int:
    """Ticks after which a match is over."""
    return round((setup.minutes * 60 + games()[setup.game].variants[setup.variant].overtime) * HZ)
