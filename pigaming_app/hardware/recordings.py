"""Recorded runs of real robots: what they were told and where they were seen, one JSON object a line (JSONL).

The first line is the head. Then, in the order in which things happened, `sent` lines (when, a sequence number, the
shares of both wheels of every robot, null where the motors were off), `seen` lines (when the picture was taken, when it
was looked at, the raw fixes) and `pose` lines (where the tracker believed all robots to be). Times are s of one
monotonic clock, poses arena px and rad.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.signals import Fix, WheelCommand
from pigaming_app.sim.plant import Sighting
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.parsing import describe_error, one_line, parse_json, quote, read
from pigaming_app.storage.safe_files import AtomicFile

FORMAT = "pigaming-run-1"
MOST_BYTES = 400_000_000  # of a file; an hour has about 100 million
LATEST = 1e10  # s of a clock
LONGEST = 7200.0  # s of a run
FARTHEST = 100_000.0  # px from the corner of the arena, or rad
Floats = NDArray[np.float64]
Told = tuple[float, list[list[float]]]  # s, the shares of both wheels of every robot
Sight = tuple[float, float, float, float]  # s, px, px, rad


class RecordingError(ValueError):
    """A file that is not a run; one line with file, line and reason."""


@dataclass(frozen=True)
class RobotRecording:
    """What one robot was told, (k,) and (k, 2), and where it was seen, (m,) and (m, 3): px, px, rad without jumps."""

    told_at: Floats
    wheels: Floats  # shares; 0 where the motors were off
    seen_at: Floats
    poses: Floats

    def between(self, begin: float, end: float) -> "RobotRecording":
        """What was seen in this time, with all that was told."""
        seen = (self.seen_at >= begin) & (self.seen_at < end)
        return RobotRecording(self.told_at, self.wheels, self.seen_at[seen], self.poses[seen])


@dataclass(frozen=True)
class Recording:
    """A recorded run: a course for every robot that was seen often enough to tell something."""

    mm: float  # of an arena px on the mat
    courses: dict[int, RobotRecording]
    emulated: bool = False


class RecordingWriter:
    """Writes a run, line by line; the file appears when it is closed. Raises OSError."""

    def __init__(self, path: Path, mm: float, emulated: bool = False) -> None:
        self._draft = AtomicFile(path)
        self._seq = 0
        self._write({"kind": "head", "format": FORMAT, "mm": mm, "emulated": emulated})

    def sent(self, time: float, wheels: Sequence[WheelCommand | None]) -> None:
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


def load(path: Path, fewest: int = 50) -> Recording:
    """The run in a file; robots that were seen in fewer than `fewest` pictures are left out. Raises RecordingError."""
    try:
        lines = read(path, MOST_BYTES).splitlines()
    except OSError as error:
        raise RecordingError(f"{path.name}: cannot be read ({describe_error(error)})") from None
    run = _RecordingLines()
    for number, line in enumerate(lines, 1):
        try:
            run.take_in(parse_json(line))
        except (ValueError, KeyError, TypeError) as error:
            if number == len(lines) and number > 1:
                break  # a run that broke off in the middle of a line
            told = f"{type(error).__name__} {error}" if isinstance(error, KeyError) else str(error)
            raise RecordingError(one_line(f"{path.name}: line {number}: not a line of a run ({told})")) from None
        if number == 1 and not run.mm:
            raise RecordingError(f"{path.name}: not a run of PiGaming")
    courses = {robot: _course(robot, run.told, fixes) for robot, fixes in enumerate(run.seen) if len(fixes) >= fewest}
    if not courses or not run.told:
        raise RecordingError(f"{path.name}: too little was seen or sent to tell anything from it")
    times = [*(time for time, _ in run.told), *(fix[0] for fixes in run.seen for fix in fixes)]
    if max(times) - min(times) > LONGEST:
        raise RecordingError(f"{path.name}: its times are more than {LONGEST:g} s apart")
    return Recording(run.mm, courses, run.emulated)


class _RecordingLines:
    """What the lines of a run hold: `told` of all robots, `seen` of each, and the scale once its head was there."""

    def __init__(self) -> None:
        self.mm, self.emulated = 0.0, False
        self.told: list[Told] = []
        self.seen: list[list[Sight]] = [[] for _ in range(ROBOTS)]

    def take_in(self, entry: Any) -> None:
        """Take in one line. Raises ValueError, KeyError, TypeError."""
        match entry["kind"]:
            case "head":
                if self.mm or entry["format"] != FORMAT:
                    raise ValueError("another format")
                self.mm, self.emulated = _number(entry["mm"], 0.1, 100.0), entry.get("emulated") is True
            case "sent":
                wheels = _list(entry["wheels"], ROBOTS)
                both = [[0.0, 0.0] if pair is None else _shares(pair) for pair in wheels]
                self.told.append((_time(entry["time"]), both))
            case "seen":
                captured = _time(entry["captured"])
                for fix in _list(entry["fixes"]):
                    robot, x, y, heading = _list(fix, 4)
                    if robot not in range(ROBOTS) or not isinstance(robot, int) or isinstance(robot, bool):
                        raise ValueError(f"{quote(robot)} is no robot; there are 0 to {ROBOTS - 1}")
                    place = _number(x, -FARTHEST, FARTHEST), _number(y, -FARTHEST, FARTHEST)
                    self.seen[robot].append((captured, *place, _number(heading, -FARTHEST, FARTHEST)))


def _list(value: Any, count: int | None = None) -> list[Any]:
    if not isinstance(value, list) or (count is not None and len(value) != count):
        raise ValueError(f"{quote(value)} is no list{'' if count is None else f' of {count}'}")
    return value


def _shares(pair: Any) -> list[float]:
    return [_number(one, -2.0, 2.0) for one in _list(pair, 2)]


def _time(value: Any) -> float:
    return _number(value, -LATEST, LATEST)


def _number(value: Any, low: float, high: float) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise ValueError(f"{quote(value)} is no number from {low:g} to {high:g}")
    return float(value)


def _course(robot: int, told: list[Told], fixes: list[Sight]) -> RobotRecording:
    seen = np.array(sorted(fixes))
    seen = seen[np.concatenate(([True], np.diff(seen[:, 0]) > 0.0))]
    poses = np.column_stack([seen[:, 1], seen[:, 2], np.unwrap(seen[:, 3])])
    told = sorted(told, key=lambda one: one[0])
    wheels = np.array([one[robot] for _, one in told])
    return RobotRecording(np.array([time for time, _ in told]), wheels, seen[:, 0], poses)
