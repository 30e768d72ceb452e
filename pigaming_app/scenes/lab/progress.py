"""Progress of a training: published states, win rate and checkpoints."""

from dataclasses import dataclass
from math import ceil
from time import perf_counter
from typing import Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.learning.evaluation import HANDMADE, Evaluation
from pigaming_app.ai.learning.policy_summary import Direction, direction
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.learning.training import GAME, Checkpoint, TableTraining
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.game import Setup
from pigaming_app.scenes.brain.rose import PETALS
from pigaming_app.scenes.lab.learning_curve import Measure
from pigaming_app.sim.world import HZ

CHECKPOINTS = (0, 10, 50, 200)  # matches after which a checkpoint is saved
MATCHES = {True: 20, False: 6}  # per evaluation, compiled and interpreted
MINUTES = {True: 2.0, False: 1.0}  # per match
EXAM_SEED = 1000
EXAM_INTERVAL = 8.0  # s between evaluations, provided the training advanced
EXAMS_PER_CURVE = 25  # approximate evaluations over the length of the curve
EXAM_SHARE = 0.02  # of the time at full speed, after as many matches
FORECAST = 0.5  # s after which the end of an evaluation can be foreseen
FIRST_POINT = 8.0  # s after which the first evaluation ends with the matches played so far, at least two
PICTURE = {True: 1 / 14, False: 1 / 100}  # s between frames, at full speed and otherwise
PETAL = 1 / 60  # s between two evaluated directions of the rose


@dataclass
class TrainingState:
    """Snapshot of a training, replaced on every change."""

    state: Any
    number: int  # frame counter
    matches: int = 0
    knowing: float = 0.0  # 0: only explores, 1: only exploits


class TrainingProgress:
    """Progress of one training. Call only while holding the right to access the training."""

    def __init__(self, training: TableTraining) -> None:
        self.training = training
        self.measures: list[Measure] = []
        self.plan: list[Direction | None] = [None] * PETALS
        self.checkpoints: dict[int, Checkpoint] = {}
        self.snapshot = TrainingState(training.snapshot(), 0, training.matches, knowing(training))
        self._exam: Evaluation | None = None
        self._unplayed: dict[tuple[Setup, bool], Batch] = {}
        self._exam_start = -1.0  # matches at the start of the last evaluation
        self._exam_time = self._last_frame = self._last_direction = perf_counter()
        self._exam_seconds = 0.0  # that the last evaluation took
        self._sector = 0
        self._save_checkpoint()

    def replace_training(self, training: TableTraining) -> None:
        """Continue with the same table in another implementation (compiled or interpreted)."""
        self.training = training
        if self._exam:
            self._exam = self._evaluation(self._exam.kinds[0])

    @property
    def played(self) -> float:
        """Matches so far, including the fraction of the current one."""
        training = self.training
        return training.matches + min(1.0, training.tick / (training.minutes * 60 * HZ)) % 1.0

    def train(self, ticks: int) -> None:
        """Train for `ticks`, recording checkpoints at match boundaries."""
        training = self.training
        whole = round(training.minutes * 60 * HZ)
        while ticks > 0:
            due = next((matches for matches in CHECKPOINTS if matches > training.matches), 0)
            batch = min(ticks, (due - training.matches) * whole - training.tick % whole) if due else ticks
            training.run(batch)
            ticks -= batch
            self._save_checkpoint()

    def publish(self, fast: bool) -> None:
        """Publish a frame and evaluate one direction of the rose, when due."""
        now = perf_counter()
        if now - self._last_frame >= PICTURE[fast]:
            self._last_frame = now
            training = self.training
            self.snapshot = TrainingState(
                training.snapshot(), self.snapshot.number + 1, training.matches, knowing(training)
            )
        if now - self._last_direction >= PETAL:
            self._last_direction = now
            self.plan[self._sector] = direction(self.training.table, self._sector, self.training.recipe.cold)
            self._sector = (self._sector + 1) % PETALS

    def exam_due(self, at_full_speed: bool = False) -> Evaluation | None:
        """The running evaluation, or a new one if due; `at_full_speed`: late ones leave most of the time free."""
        if self._exam is None:
            played, now = self.played, perf_counter()
            grain = max(1.0, played / EXAMS_PER_CURVE)
            since, seconds = played - self._exam_start, now - self._exam_time
            pause = min(self._exam_seconds / EXAM_SHARE, EXAM_INTERVAL)
            rests = at_full_speed and played > EXAMS_PER_CURVE and seconds < pause
            if (since >= grain or (since > 0 and seconds >= EXAM_INTERVAL)) and not rests:
                self._exam_start, self._exam_time = played, now
                self._exam = self._evaluation(self.training.checkpoint().kind)
        return self._exam

    def record_exam(self) -> None:
        """Record the result of a finished evaluation. The first one ends early where it takes long."""
        seconds = perf_counter() - self._exam_time
        in_time = bool(self.measures) or seconds < FIRST_POINT or not (self._exam and self._exam.pairs)
        if self._exam and (self._exam.over or not in_time):
            self.measures = [*self.measures, Measure(self._exam_start, self._exam.share)]
            self._exam, self._exam_seconds = None, seconds

    @property
    def first_point(self) -> int | None:
        """s until the first point of the curve, about; None if it is there."""
        if self.measures:
            return None
        passed, done = perf_counter() - self._exam_time, self._exam.done if self._exam else 0.0
        forecast = passed / done - passed if done and passed > FORECAST else FIRST_POINT
        return max(1, ceil(min(FIRST_POINT - passed, forecast)))

    def _evaluation(self, learned: BrainKind) -> Evaluation:
        """An evaluation against the hand-made robot."""
        training, handmade = self.training, BRAINS[GAME][HANDMADE]
        fast = training.fast
        minutes = min(MINUTES[fast], training.minutes)
        return Evaluation(learned, handmade, MATCHES[fast], EXAM_SEED, minutes, training.arena, fast, self._unplayed)

    def _save_checkpoint(self) -> None:
        """Save a checkpoint if one is due."""
        matches = self.training.matches
        if matches in CHECKPOINTS and matches not in self.checkpoints:
            self.checkpoints[matches] = self.training.checkpoint(str(matches))


def knowing(training: TableTraining) -> float:
    """Progress from exploration to exploitation, 0..1, derived from the temperature."""
    recipe = training.recipe
    return min(1.0, max(0.0, (recipe.hot - training.temperature) / (recipe.hot - recipe.cold)))
