"""The match that is shown: the network as it is now against the hand-made robot, by the rules of its training.

The process plays dozens of matches at once; this one is like each of them.
"""

from typing import Any

from pigaming_app.ai.brain.kind import BrainKind, BrainPlayer
from pigaming_app.ai.learning.batch import initial_states
from pigaming_app.ai.learning.evaluation import HANDMADE
from pigaming_app.ai.learning.training import ARENA, GAME, MINUTES, training_setup
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.registry import games
from pigaming_app.sim.contact import drive


class Exhibition:
    """One match after the other."""

    def __init__(self, kind: BrainKind, seed: int) -> None:
        self.seed, self._kind = seed, kind
        self.match: Any = None
        self._players: list[BrainPlayer] = []
        self._begin()

    def replace_brain(self, kind: BrainKind) -> None:
        """Play on with another network."""
        self._players[0].weights = kind.weights(False)[0]
        self._kind = kind

    def play(self, ticks: int) -> None:
        """Advance by `ticks` ticks, across matches."""
        judge = games()[GAME].judge
        for _ in range(ticks):
            if self.match.over:
                self.seed += 1
                self._begin()
            for seat, player in enumerate(self._players):
                player.think(self.match, seat)
            judge(self.match)
            drive(self.match)

    def _begin(self) -> None:
        self.match = initial_states([training_setup(self.seed, MINUTES, ARENA)])[0]
        self._players = [BrainPlayer(self._kind, self.seed), BrainPlayer(BRAINS[GAME][HANDMADE], self.seed + 1)]
