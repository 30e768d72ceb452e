"""A contest of two brains, played a little at a time, for whoever has only some milliseconds, such as those of a frame.

One match after the other, by the rules of the training; every seed twice, with the sides swapped.
"""

import os
import sys
from threading import Thread

from pigaming_app.ai import BRAINS
from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.experiments.rollout import Batch
from pigaming_app.ai.experiments.training import ARENA, GAME, MINUTES, Training, training_setup
from pigaming_app.ai.qlearning.rewards import Recipe
from pigaming_app.sim.world import HZ

HANDMADE = "hard"  # the best that people have written by hand


class Evaluation:
    """So many matches of `one` against `other`, an even number."""

    def __init__(
        self,
        one: BrainKind,
        other: BrainKind,
        matches: int,
        seed: int,
        minutes: float = MINUTES,
        arena: str = ARENA,
        fast: bool = False,
    ) -> None:
        self.kinds = one, other
        self.matches, self.seed, self.minutes, self.arena, self.fast = matches, seed, minutes, arena, fast
        self.wins = self.ties = self.losses = 0
        self._played = 0
        self._batch: Batch | None = None
        self._left = 0  # ticks of the match that is being played

    @property
    def over(self) -> bool:
        return self._played == self.matches

    @property
    def share(self) -> float:
        """Of all matches so far, won; a tie is half a win. Against one like itself that is a half, on average."""
        return (self.wins + 0.5 * self.ties) / max(1, self._played)

    def play(self, ticks: int) -> None:
        """Play so many ticks on; not past the end of a match."""
        if self.over:
            return
        swapped = self._played % 2
        if self._batch is None:
            kinds = self.kinds[::-1] if swapped else self.kinds
            self._batch = Batch(
                [training_setup(self.seed + self._played // 2, self.minutes, self.arena)], kinds, self.fast
            )
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
    """Compile, or load, whatever the Lab plays: training, and every kind of exam. Raises ImportError without numba."""
    training = Training(Recipe(), 1, fast=True)
    training.run(1)
    learned, handmade = training.checkpoint().kind, BRAINS[GAME][HANDMADE]
    for one, other in ((learned, handmade), (learned, learned)):
        exam = Evaluation(one, other, 2, 1, minutes=1 / (60 * HZ), fast=True)
        while not exam.over:
            exam.play(1)


def exit_with_parent() -> None:
    """End this process as soon as the one that started it closes the pipe to it, for whatever reason."""

    def wait() -> None:
        os.read(sys.stdin.fileno(), 1)  # a buffered read would abort the interpreter at its normal end
        os._exit(1)

    Thread(target=wait, daemon=True).start()


if __name__ == "__main__":  # a process of its own that only compiles, so that no picture waits for it
    exit_with_parent()
    compile_all()
