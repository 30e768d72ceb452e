"""Whole matches of one game, each with brains of its own on the seats, in one loop, plain or compiled."""

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from types import MappingProxyType
from typing import Any

from pigaming_app.ai.brain.kind import IDLE, BrainKind
from pigaming_app.ai.learning.batch import initial_states
from pigaming_app.ai.learning.rollout import cast_with_baselines, compiled_rollout, plain_rollout, rehearse
from pigaming_app.ai.plugin_faults import bound, check
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.game import Setup
from pigaming_app.games.registry import games
from pigaming_app.games.setup import longest
from pigaming_app.sim.record import packed, unpack
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.plugins.endless import overseer

OFF = "off"  # an empty seat


class LineUps:
    """Plays matches among some brains. The loop is compiled once for all of them."""

    def __init__(
        self, game: str, brains: Sequence[str], fast: bool, instead: Mapping[str, BrainKind] = MappingProxyType({})
    ) -> None:
        """`fast`: compiled; needs numba, and no brain that is `plain`. Raises ChoiceError for unknown brains.

        `instead`: brains in place of those of these names.
        """
        self.game, self.fast = game, fast
        self.kinds: dict[str, BrainKind] = {OFF: IDLE} | {name: find_brain(game, name) for name in brains} | {**instead}
        self._cast = cast_with_baselines(self.kinds.values(), fast)

    def played(self, setups: Sequence[Setup]) -> list[Any]:
        """The final state of each match; compiled ones share the cores. Raises ArenaError.

        Every seat names one of the brains, or is off.
        """
        return self.played_with_efforts(setups)[0]

    def played_with_efforts(self, setups: Sequence[Setup]) -> tuple[list[Any], list[list[float]]]:
        """The final state of each match, and the final effort of each seat; 0 of a brain that has none."""
        states = initial_states(setups)
        minds = self._cast.minds([self._seated(setup) for setup in setups])
        ticks = bound(self.game, max(longest(setup) for setup in setups))
        if not self.fast:
            plain_rollout(self.game, self._cast.families)(states, minds, self._cast.weights, ticks)
            check(self.game, states)
            return states, [[self._effort(mind) for mind in seated] for seated in minds]
        rehearse(setups[0], [self.kinds[seat.brain] for seat in setups[0].seats])
        matches, loop = packed(states), compiled_rollout(self.game, self._cast.families)
        weights = self._cast.weights
        share = -(-len(setups) // (os.cpu_count() or 1))
        with ThreadPoolExecutor() as threads:  # the loop runs without the GIL, and matches are independent
            shares = [slice(i, i + share) for i in range(0, len(setups), share)]
            parts = [
                threads.submit(
                    overseer.run, self.game, matches[part]["tick"].sum, loop, matches[part], minds[part], weights, ticks
                )
                for part in shares
            ]
        for part in parts:
            part.result()
        ended: list[Any] = [unpack(games()[self.game].state, row) for row in matches]
        check(self.game, ended)
        return ended, [[self._effort(mind) for mind in seated] for seated in minds]

    def _effort(self, mind: Any) -> float:
        """The effort in a seat's mind, a NumPy record if the loop is compiled."""
        inner = mind[f"mind{mind['family']}"] if self.fast else getattr(mind, f"mind{mind.family}")
        if self.fast:
            return float(inner["effort"]["now"]) if "effort" in (inner.dtype.names or ()) else 0.0
        return inner.effort.now if hasattr(inner, "effort") else 0.0

    def _seated(self, setup: Setup) -> list[tuple[BrainKind, int]]:
        """Brain and seed of every seat, as `new_match` has them."""
        return [(self.kinds[seat.brain], setup.seed * ROBOTS + i) for i, seat in enumerate(setup.seats)]
