"""The course of a training as a table: what each update did, and measured win rates in between."""

import csv
from collections.abc import Iterator, Mapping
from dataclasses import astuple
from pathlib import Path
from typing import Any

from pigaming_app.ai.ppo.learner import LearnerFigures
from pigaming_app.ai.ppo.training import Training, scores_at
from pigaming_app.ai.ppo.win_rates import DuelScore
from pigaming_app.jobs.learning.train.copies import RatedCopy
from pigaming_app.jobs.learning.train.outputs import csv_of

RATED = ("rating", "rating_low", "rating_high")
MEASURED = (*DuelScore._fields, "share", "low", "high")  # of each rival


class TrainingTable:
    """The rows of a training. With --resume they continue those of the file up to the checkpoint."""

    def __init__(self, training: Training, before: Path | None) -> None:
        """`before`: the table of the training that is resumed; one that cannot be read counts for nothing."""
        self.training = training
        self.copies: list[RatedCopy] = []  # of this training, rated
        self._rows: dict[int, Mapping[str, Any]] = dict(_read(before, training.updates)) if before else {}
        self._last = training.decisions, training.seconds

    @property
    def columns(self) -> list[str]:
        """The names of the columns."""
        task = self.training.task
        figures = [f"{prefix}{name}" for prefix in self.prefixes for name in LearnerFigures._fields]
        measured = [f"{rival}_{name}" for rival in task.rivals for name in MEASURED]
        columns = ["updates", "decisions", "seconds", "decisions_per_second", *figures, "pool", *measured]
        return [*columns, *RATED] if self.copies else columns

    @property
    def prefixes(self) -> list[str]:
        """Of the columns of each learner."""
        return ["", *(f"{name}_" for name in self.training.task.learners[1:])]

    def points(self, column: str) -> list[tuple[float, float]]:
        """A number of every update, each with the decisions so far, in millions."""
        found = ((int(row["decisions"]) / 1e6, row.get(column)) for _, row in sorted(self._rows.items()))
        return [(millions, float(value)) for millions, value in found if value]

    def numbers(self) -> dict[str, float]:
        """The last update for TensorBoard, by tag, and the wins if they were measured after it."""
        training = self.training
        row = self._rows[training.updates]
        speed = float(row["decisions_per_second"])
        found = {"training/decisions": training.decisions, "training/decisions_per_second": speed}
        found["training/pool"] = sum(map(len, training.pools))
        for name, telemetry in zip(training.task.learners, map(training.telemetry.get, range(2)), strict=False):
            found |= {f"{name}/{figure}": x for figure, x in (telemetry._asdict() if telemetry else {}).items()}
        if training.points and training.points[-1][0] == training.updates:
            scores = scores_at(training.task, training.points[-1])
            found |= {f"wins/{rival}": score.share for rival, score in scores.items()}
        return found

    def note(self) -> None:
        """Add a row for the last update."""
        training = self.training
        decisions, seconds = training.decisions - self._last[0], training.seconds - self._last[1]
        self._last = training.decisions, training.seconds
        row = {"decisions_per_second": f"{decisions / seconds:.0f}", "pool": _pool(training)}
        for prefix, telemetry in zip(self.prefixes, map(training.telemetry.get, range(2)), strict=False):
            row |= {f"{prefix}{name}": f"{x:.6g}" for name, x in (telemetry._asdict() if telemetry else {}).items()}
        self._rows[training.updates] = self._begun() | row

    def csv(self) -> bytes:
        """The table as a CSV file."""
        rows = dict(self._rows)
        for point in self.training.points:
            updates, decisions, seconds = int(point[0]), point[1], point[2]
            begun = {"updates": updates, "decisions": decisions, "seconds": seconds}
            rows[updates] = {**begun, **rows.get(updates, {}), **self._measured(point)}
        for copy in self.copies:
            points = dict(zip(RATED, (f"{x:.1f}" for x in astuple(copy.rating)), strict=True))
            begun = {"updates": copy.updates, "decisions": copy.decisions}
            rows[copy.updates] = {**begun, **rows.get(copy.updates, {}), **points}
        columns = self.columns
        return csv_of(columns, ([rows[k].get(name, "") for name in columns] for k in sorted(rows)))

    def _begun(self) -> dict[str, Any]:
        training = self.training
        return {"updates": training.updates, "decisions": training.decisions, "seconds": round(training.seconds, 3)}

    def _measured(self, point: tuple[float, ...]) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for rival, score in scores_at(self.training.task, point).items():
            shares = [f"{x:.4f}" for x in (score.share, *score.interval)]
            found |= {f"{rival}_{name}": x for name, x in zip(MEASURED, (*score, *shares), strict=True)}
        return found


def _pool(training: Training) -> str:
    """A population: learner and update of each member, the share won against it, its chance. Else the pool's size."""
    population = training.population
    if population is None:
        return str(sum(map(len, training.pools)))
    names, chances = training.task.learners, population.chances
    rows = zip(population.joined, population.members, chances, strict=True)
    return " ".join(f"{names[k]}@{update}:{one.share:.2f}:{chance:.3f}" for (k, update), one, chance in rows)


def _read(file: Path, updates: int) -> Iterator[tuple[int, Mapping[str, Any]]]:
    """The rows of a table up to an update."""
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return
    for row in csv.DictReader(text.splitlines()):
        if (number := row.get("updates") or "").isdecimal() and int(number) <= updates:
            yield int(number), row
