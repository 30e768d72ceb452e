"""Recorded runs of real robots: what they were told and where they were seen, one JSON object a line (JSONL).

The first line is the head. Then, in the order in which things happened, `sent` lines (when, a sequence number, the
shares of both wheels of every robot, null where the motors were off), `seen` lines (when the picture was taken, when it
was looked at, the raw fixes) and `pose` lines (where the tracker believed all robots to be). Times are s of one
monotonic clock, poses arena px and rad.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.signals import Fix, Wheels
from pigaming_app.keeping import Draft
from pigaming_app.sim.plant import Sighting
from pigaming_app.sim.world import ROBOTS

FORMAT = "pigaming-run-1"
Floats = NDArray[np.float64]


class RunError(ValueError):
    """A file that is not a run; one line with file, line and reason."""


@dataclass(frozen=True)
class Course:
    """What one robot was told, (k,) and (k, 2), and where it was seen, (m,) and (m, 3): px, px, rad without jumps."""

    told_at: Floats
    wheels: Floats  # shares; 0 where the motors were off
    seen_at: Floats
    poses: Floats

    def between(self, begin: float, end: float) -> "Course":
        """What was seen in this time, with all that was told."""
        seen = (self.seen_at >= begin) & (self.seen_at < end)
        return Course(self.told_at, self.wheels, self.seen_at[seen], self.poses[seen])


@dataclass(frozen=True)
class Run:
    """A recorded run: a course for every robot that was seen often enough to tell something."""

    mm: float  # of an arena px on the mat
    courses: dict[int, Course]
    emulated: bool = False


class Recorder:
    """Writes a run, line by line; the file appears when it is closed. Raises OSError."""

    def __init__(self, path: Path, mm: float, emulated: bool = False) -> None:
        self._draft = Draft(path)
        self._seq = 0
        self._write({"kind": "head", "format": FORMAT, "mm": mm, "emulated": emulated})

    def sent(self, time: float, wheels: Sequence[Wheels | None]) -> None:
        """The robots are told this."""
        self._seq += 1
        self._write({"kind": "sent", "time": time, "seq": self._seq, "wheels": [one and list(one) for one in wheels]})

    def seen(self, now: float, captured: float, fixes: Sequence[Fix]) -> None:
        """A picture has been looked at."""
        raw = [[fix.robot, fix.x, fix.y, fix.heading] for fix in fixes]
        self._write({"kind": "seen", "captured": captured, "time": now, "fixes": raw})

    def believed(self, now: float, sightings: Sequence[Sighting]) -> None:
        """Where the tracker has all robots."""
        self._write({"kind": "pose", "time": now, "poses": [list(one[:3]) for one in sightings]})

    def close(self) -> None:
        """The run is whole: put it in its place."""
        self._draft.finish()

    def discard(self) -> None:
        """The run broke off: an earlier one at its place stays. After `close` this does nothing."""
        self._draft.discard()

    def _write(self, line: dict[str, Any]) -> None:
        self._draft.write(f"{json.dumps(line, separators=(',', ':'))}\n".encode())


def load(path: Path, fewest: int = 50) -> Run:
    """The run in a file; robots that were seen in fewer than `fewest` pictures are left out. Raises RunError."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not text"
        raise RunError(f"{path.name}: cannot be read ({reason})") from None
    told: list[tuple[float, list[Any]]] = []
    seen: list[list[tuple[float, float, float, float]]] = [[] for _ in range(ROBOTS)]
    mm = 0.0
    for number, line in enumerate(lines, 1):
        try:
            mm = _take_in(json.loads(line), told, seen) or mm
        except (ValueError, KeyError, TypeError, IndexError) as error:
            if number == len(lines) and number > 1:
                break  # a run that broke off in the middle of a line
            raise RunError(f"{path.name}: line {number}: not a line of a run ({error})") from None
        if number == 1 and not mm:
            raise RunError(f"{path.name}: not a run of PiGaming")
    courses = {robot: _course(robot, told, fixes) for robot, fixes in enumerate(seen) if len(fixes) >= fewest}
    if not mm or not courses or not told:
        raise RunError(f"{path.name}: too little was seen or sent to tell anything from it")
    return Run(mm, courses, emulated=json.loads(lines[0]).get("emulated") is True)


def _take_in(
    entry: Any, told: list[tuple[float, list[Any]]], seen: list[list[tuple[float, float, float, float]]]
) -> float:
    """Take in one line; the scale if it is the head, else 0. Raises ValueError, KeyError, TypeError, IndexError."""
    match entry["kind"]:
        case "head":
            if entry["format"] != FORMAT or not 0.1 < entry["mm"] < 100.0:
                raise ValueError("another format")
            return float(entry["mm"])
        case "sent":
            told.append(
                (_number(entry["time"]), [one and [_number(one[0]), _number(one[1])] for one in entry["wheels"]])
            )
        case "seen":
            captured = _number(entry["captured"])
            for robot, x, y, heading in entry["fixes"]:
                seen[int(robot)].append((captured, _number(x), _number(y), _number(heading)))
    return 0.0


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        raise ValueError(f"{value!r} is no number")
    return float(value)


def _course(robot: int, told: list[tuple[float, list[Any]]], fixes: list[tuple[float, float, float, float]]) -> Course:
    wheels = np.array([one[robot] or (0.0, 0.0) for _, one in told])
    seen = np.array(sorted(fixes))
    seen = seen[np.concatenate(([True], np.diff(seen[:, 0]) > 0.0))]
    poses = np.column_stack([seen[:, 1], seen[:, 2], np.unwrap(seen[:, 3])])
    return Course(np.array([time for time, _ in told]), wheels.reshape(-1, 2), seen[:, 0], poses)
