"""Incremental evaluation of one brain against another, for callers with a budget of milliseconds, such as a frame.

Matches run one after the other by the training rules, two per seed with the sides swapped. Run as a module, this file
compiles the Lab's kernels.
"""

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.learning.training import ARENA, GAME, MINUTES, TableTraining, training_setup
from pigaming_app.ai.qlearning.recipe import Recipe
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.game import Setup
from pigaming_app.sim.world import HZ
from pigaming_app.storage.background import exit_with_parent

HANDMADE = "hand3"  # the strongest hand-written brain


class Evaluation:
    """`matches` matches (an even number) of `one` against `other`, each `minutes` long; counted from `one`'s side."""

    def __init__(
        self,
        one: BrainKind,
        other: BrainKind,
        matches: int,
        seed: int,
        minutes: float = MINUTES,
        arena: str = ARENA,
        fast: bool = False,
        unplayed: dict[tuple[Setup, bool], Batch] | None = None,
    ) -> None:
        """`unplayed`: batches of single matches that evaluations share: one takes as long to make as to play."""
        self.kinds = one, other
        self._unplayed = {} if unplayed is None else unplayed
        self.matches, self.seed, self.minutes, self.arena, self.fast = matches, seed, minutes, arena, fast
        self.wins = self.ties = self.losses = 0
        self._played = 0
        self._batch: Batch | None = None
        self._left = 0  # ticks of the match that is being played

    @property
    def over(self) -> bool:
        return self._played == self.matches

    @property
    def pairs(self) -> int:
        """Pairs of matches, with the sides swapped, played to the end."""
        return self._played // 2

    @property
    def done(self) -> float:
        """Share of all ticks that is played."""
        whole = round(self.minutes * 60 * HZ)
        return (self._played + (1.0 - self._left / whole if self._batch else 0.0)) / self.matches

    @property
    def share(self) -> float:
        """Share of the matches so far that `one` won, ties counting half; 0.5 on average between equal brains."""
        return (self.wins + 0.5 * self.ties) / max(1, self._played)

    def play(self, ticks: int) -> None:
        """Play at most `ticks` ticks, stopping at the end of a match."""
        if self.over:
            return
        swapped = self._played % 2
        if self._batch is None:
            kinds = self.kinds[::-1] if swapped else self.kinds
            setup = training_setup(self.seed + self._played // 2, self.minutes, self.arena)
            if (setup, self.fast) not in self._unplayed:
                self._unplayed[setup, self.fast] = Batch([setup], [], self.fast)
            self._batch = Batch([setup], kinds, self.fast, twin=self._unplayed[setup, self.fast])
            self._left = round(self.minutes * 60 * HZ)
        ticks = min(ticks, self._left)
        self._batch.play(ticks)
        self._left -= ticks
        if not self._left:
            one, other, *_ = self._batch.scores()[0]
            self._count(other - one if swapped else one - other)
            self._batch = None

    def _count(self, lead: int) -> None:
        self.wins += lead > 0
        self.ties += lead == 0
        self.losses += lead < 0
        self._played += 1


def compile_all() -> None:
    """Compile or load the kernels of training and of every kind of evaluation. Raises ImportError without numba."""
    training = TableTraining(Recipe(), 1, fast=True)
    training.run(1)
    learned, handmade = training.checkpoint().kind, BRAINS[GAME][HANDMADE]
    for one, other in ((learned, handmade), (learned, learned)):
        evaluation = Evaluation(one, other, 2, 1, minutes=1 / (60 * HZ), fast=True)
        while not evaluation.over:
            evaluation.play(1)


if __name__ == "__main__":  # a separate process, so that compiling never delays a frame
    exit_with_parent()
    compile_all()
