"""How far a training has come: what the page shows of it, how often it wins, and what it knew at certain matches."""

from dataclasses import dataclass
from time import perf_counter
from typing import Any

from pigaming_app.ai import BRAINS
from pigaming_app.ai.brain.kind import Kind
from pigaming_app.ai.experiments.evaluation import HANDMADE, Exam
from pigaming_app.ai.experiments.training import GAME, Checkpoint, Training
from pigaming_app.ai.qlearning.policy_summary import Direction, direction
from pigaming_app.scenes.brain.rose import PETALS
from pigaming_app.scenes.lab.learning_curve import Measure
from pigaming_app.sim.world import HZ

MARKS = (0, 10, 50, 200)  # matches after which what it knows is kept
MATCHES = {True: 20, False: 6}  # of an exam, compiled and plain
MINUTES = {True: 2.0, False: 1.0}  # of each of them
EXAM_SEED = 1000
SOON = 8.0  # seconds after which it is examined again, if it has learned at all
GRAIN = 25  # exams over the length of the curve, about
PICTURE = {True: 1 / 14, False: 1 / 100}  # seconds between pictures, as fast as it can and else
PETAL = 1 / 60  # seconds between two directions of the rose


@dataclass
class TrainingState:
    """How a training stands, made anew whenever something has changed."""

    state: Any
    number: int  # of pictures so far
    matches: int = 0
    knowing: float = 0.0  # 0: it only guesses, 1: it does what it knows


class Progress:
    """What is known about one training. Only whoever may touch the training may call this."""

    def __init__(self, training: Training) -> None:
        self.training = training
        self.measures: list[Measure] = []
        self.plan: list[Direction | None] = [None] * PETALS
        self.checkpoints: dict[int, Checkpoint] = {}
        self.moment = TrainingState(training.look(), 0, training.matches, knowing(training))
        self._exam: Exam | None = None
        self._at = -1.0  # matches at which the last exam began
        self._when = self._seen = self._petal = perf_counter()
        self._sector = 0
        self._mark()

    def go_on(self, training: Training) -> None:
        """The same table goes on in another body."""
        self.training = training
        if self._exam:
            self._exam = self._examined(self._exam.kinds[0])

    @property
    def played(self) -> float:
        """Matches so far, with the part of the one that is being played."""
        training = self.training
        return training.matches + min(1.0, int(training.match.tick) / (training.minutes * 60 * HZ)) % 1.0

    def practise(self, ticks: int) -> None:
        """Train for so many ticks, stopping for a moment where a match ends."""
        training = self.training
        whole = round(training.minutes * 60 * HZ)
        while ticks > 0:
            left = whole - int(training.match.tick)
            some = min(ticks, left if left > 0 else whole)
            training.run(some)
            ticks -= some
            self._mark()

    def look(self, fast: bool) -> None:
        """Take a picture and look at one direction of the plan, where it is time for it."""
        now = perf_counter()
        if now - self._seen >= PICTURE[fast]:
            self._seen = now
            training = self.training
            self.moment = TrainingState(training.look(), self.moment.number + 1, training.matches, knowing(training))
        if now - self._petal >= PETAL:
            self._petal = now
            self.plan[self._sector] = direction(self.training.table, self._sector, self.training.recipe.cold)
            self._sector = (self._sector + 1) % PETALS

    def exam_due(self) -> Exam | None:
        """The exam that is going on, or one that should begin now."""
        if self._exam is None:
            played, now = self.played, perf_counter()
            grain = max(1.0, played / GRAIN)
            if played - self._at >= grain or (played > self._at and now - self._when >= SOON):
                self._at, self._when = played, now
                self._exam = self._examined(self.training.checkpoint().kind)
        return self._exam

    def note(self) -> None:
        """Take down how an exam went, if it is over."""
        if self._exam and self._exam.over:
            self.measures = [*self.measures, Measure(self._at, self._exam.share)]
            self._exam = None

    def _examined(self, learned: Kind) -> Exam:
        """An exam by the hand-made robot."""
        training, handmade = self.training, BRAINS[GAME][HANDMADE]
        fast = training.fast
        minutes = min(MINUTES[fast], training.minutes)
        return Exam(learned, handmade, MATCHES[fast], EXAM_SEED, minutes, training.arena, fast)

    def _mark(self) -> None:
        """Keep what it knows after so many matches."""
        matches = self.training.matches
        if matches in MARKS and matches not in self.checkpoints:
            self.checkpoints[matches] = self.training.checkpoint(str(matches))


def knowing(training: Training) -> float:
    """How far the way from guessing to knowing is gone, 0..1: as far as the temperature has fallen."""
    recipe = training.recipe
    return min(1.0, max(0.0, (recipe.hot - training.temperature) / (recipe.hot - recipe.cold)))
