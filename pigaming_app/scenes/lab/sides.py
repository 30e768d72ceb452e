"""The two robots of the Lab, A and B, each with a reward of its own. B begins when it is first asked for."""

from collections import deque

from pigaming_app.scenes.lab.learning_curve import WinCourse
from pigaming_app.scenes.lab.network.kind_switch import KINDS, TABLE
from pigaming_app.scenes.lab.network.trainer import NetworkProgress, NetworkTrainer
from pigaming_app.scenes.lab.progress import TrainingProgress
from pigaming_app.scenes.lab.trainer import Trainer

WINDOW = 2.0  # s over which matches a second are counted


class LabSide:
    """One of the robots, as a table and as a network."""

    def __init__(self, table: Trainer, network: NetworkTrainer) -> None:
        self.table, self.network = table, network
        self.names = dict.fromkeys(KINDS, "")  # under which each was saved or opened
        self.was_behind: TrainingProgress | NetworkProgress | None = None  # the training behind the hand-made robot
        self.celebrated: TrainingProgress | NetworkProgress | None = None  # the one whose overtaking was celebrated
        self._changes: list[float] = []
        self._changed: TrainingProgress | NetworkProgress | None = None  # the training whose reward was changed
        self._counts: deque[tuple[float, int]] = deque()  # s, matches
        self._clock = 0.0

    def trainer(self, kind: str) -> Trainer | NetworkTrainer:
        return self.table if kind == TABLE else self.network

    def follow(self, kind: str, seconds: float) -> None:
        """Note what has happened in the last `seconds`."""
        matches = self.trainer(kind).snapshot.matches
        self._clock += seconds
        if self._counts and matches < self._counts[-1][1]:
            self._counts.clear()  # another training
        self._counts.append((self._clock, matches))
        while self._clock - self._counts[0][0] > WINDOW:
            self._counts.popleft()

    @property
    def rate(self) -> float:
        """Matches a second, lately; 0 before they can be counted."""
        if not self._counts:
            return 0.0
        (since, before), (now, matches) = self._counts[0], self._counts[-1]
        return (matches - before) / (now - since) if now - since > WINDOW / 2 else 0.0

    def note_change(self, kind: str) -> None:
        """Remember when the reward was changed; several changes at a time are one."""
        trainer = self.trainer(kind)
        if trainer.progress is not self._changed:
            self._changed, self._changes = trainer.progress, []
        matches = float(trainer.snapshot.matches)
        if matches and matches not in self._changes:
            self._changes = [*self._changes, matches]

    def course(self, kind: str) -> WinCourse:
        progress = self.trainer(kind).progress
        return WinCourse(progress.measures, self._changes if progress is self._changed else ())

    def close(self) -> None:
        """Pause."""
        self.table.close()
        self.network.close()
