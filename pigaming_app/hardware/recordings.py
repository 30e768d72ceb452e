"""Recordings of real robots: commands and observed poses, one JSON object a line (JSONL).

The first line is the header. Then follow, in chronological order, `sent` lines (time, sequence number, the wheel
commands of every robot as shares of full speed, null where the motors were off), `seen` lines (time of exposure, time
of processing, the raw fixes) and `pose` lines (the tracker's estimate of every robot). Times are s of one monotonic
clock, poses arena px and rad.
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
MAX_BYTES = 400_000_000  # of a file; an hour has about 100 million
MAX_TIME = 1e10  # s of a clock
MAX_DURATION = 7200.0  # s of a run
MAX_COORDINATE = 100_000.0  # px from the corner of the arena, or rad
Floats = NDArray[np.float64]
Command = tuple[float, list[list[float]]]  # s, the shares of both wheels of every robot
Observation = tuple[float, float, float, float]  # s, px, px, rad


class RecordingError(ValueError):
    """Invalid recording; the text is one line with file, line number and reason."""


@dataclass(frozen=True)
class RobotRecording:
    """Commands of one robot, times (k,) and wheels (k, 2), and its observations, times (m,) and poses (m, 3).

    Times are s; poses are px, px, rad, with the heading unwrapped.
    """

    command_times: Floats
    wheels: Floats  # shares; 0 where the motors were off
    pose_times: Floats
    poses: Floats

    def between(self, begin: float, end: float) -> "RobotRecording":
        """The observations from `begin` to `end` (s, exclusive), with all commands."""
        seen = (self.pose_times >= begin) & (self.pose_times < end)
        return RobotRecording(self.command_times, self.wheels, self.pose_times[seen], self.poses[seen])


@dataclass(frozen=True)
class Recording:
    """A recorded run: a course for every robot with enough observations."""

    mm: float  # of an arena px on the mat
    courses: dict[int, RobotRecording]
    emulated: bool = False


class RecordingWriter:
    """Writes a run line by line; the file appears on `close`. Raises OSError."""

    def __init__(self, path: Path, mm: float, emulated: bool = False) -> None:
        self._draft = AtomicFile(path)
        self._seq = 0
        self._write({"kind": "head", "format": FORMAT, "mm": mm, "emulated": emulated})

    def record_commands(self, time: float, wheels: Sequence[WheelCommand | None]) -> None:
        """Record the commands of all robots, sent at `time` (s)."""
        self._seq += 1
        pairs = [pair and list(pair) for pair in wheels]
        self._write({"kind": "sent", "time": time, "seq": self._seq, "wheels": pairs})

    def record_fixes(self, now: float, captured: float, fixes: Sequence[Fix]) -> None:
        """Record the fixes of a picture taken at `captured` and processed at `now` (s)."""
        raw = [[fix.robot, fix.x, fix.y, fix.heading] for fix in fixes]
        self._write({"kind": "seen", "captured": captured, "time": now, "fixes": raw})

    def record_estimates(self, now: float, sightings: Sequence[Sighting]) -> None:
        """Record the tracker's estimates."""
        self._write({"kind": "pose", "time": now, "poses": [list(sighting[:3]) for sighting in sightings]})

    def close(self) -> None:
        """Finish the file and move it to its path."""
        self._draft.finish()

    def discard(self) -> None:
        """Abandon an incomplete run; an earlier file at that path stays. No effect after `close`."""
        self._draft.discard()

    def _write(self, line: dict[str, Any]) -> None:
        self._draft.write(f"{json.dumps(line, separators=(',', ':'))}\n".encode())


def load(path: Path, min_observations: int = 50) -> Recording:
    """Read a run; robots with fewer than `min_observations` are left out. Raises RecordingError."""
    try:
        lines = read(path, MAX_BYTES).splitlines()
    except OSError as error:
        raise RecordingError(f"{path.name}: cannot be read ({describe_error(error)})") from None
    run = _RecordingLines()
    for number, line in enumerate(lines, 1):
        try:
            run.add(parse_json(line))
        except (ValueError, KeyError, TypeError) as error:
            if number == len(lines) and number > 1:
                break  # the recording stopped in the middle of a line
            reason = f"{type(error).__name__} {error}" if isinstance(error, KeyError) else str(error)
            raise RecordingError(one_line(f"{path.name}: line {number}: not a line of a run ({reason})")) from None
        if number == 1 and not run.mm:
            raise RecordingError(f"{path.name}: not a run of PiGaming")
    courses = {
        robot: _course(robot, run.commands, fixes)
        for robot, fixes in enumerate(run.observations)
        if len(fixes) >= min_observations
    }
    if not courses or not run.commands:
        raise RecordingError(f"{path.name}: too little was seen or sent to tell anything from it")
    times = [*(time for time, _ in run.commands), *(fix[0] for fixes in run.observations for fix in fixes)]
    if max(times) - min(times) > MAX_DURATION:
        raise RecordingError(f"{path.name}: its times are more than {MAX_DURATION:g} s apart")
    return Recording(run.mm, courses, run.emulated)


class _RecordingLines:
    """Parsed lines: `commands` of all robots, `observations` of each; `mm` is 0 before the header."""

    def __init__(self) -> None:
        self.mm, self.emulated = 0.0, False
        self.commands: list[Command] = []
        self.observations: list[list[Observation]] = [[] for _ in range(ROBOTS)]

    def add(self, entry: Any) -> None:
        """Parse one line. Raises ValueError, KeyError or TypeError."""
        match entry["kind"]:
            case "head":
                if self.mm or entry["format"] != FORMAT:
                    raise ValueError("another format")
                self.mm, self.emulated = _number(entry["mm"], 0.1, 100.0), entry.get("emulated") is True
            case "sent":
                wheels = _list(entry["wheels"], ROBOTS)
                both = [[0.0, 0.0] if pair is None else _shares(pair) for pair in wheels]
                self.commands.append((_time(entry["time"]), both))
            case "seen":
                captured = _time(entry["captured"])
                for fix in _list(entry["fixes"]):
                    robot, x, y, heading = _list(fix, 4)
                    if robot not in range(ROBOTS) or not isinstance(robot, int) or isinstance(robot, bool):
                        raise ValueError(f"{quote(robot)} is no robot; there are 0 to {ROBOTS - 1}")
                    self.observations[robot].append((captured, _coordinate(x), _coordinate(y), _coordinate(heading)))


def _list(value: Any, count: int | None = None) -> list[Any]:
    if not isinstance(value, list) or (count is not None and len(value) != count):
        raise ValueError(f"{quote(value)} is no list{'' if count is None else f' of {count}'}")
    return value


def _shares(pair: Any) -> list[float]:
    return [_number(share, -2.0, 2.0) for share in _list(pair, 2)]


def _time(value: Any) -> float:
    return _number(value, -MAX_TIME, MAX_TIME)


def _coordinate(value: Any) -> float:
    return _number(value, -MAX_COORDINATE, MAX_COORDINATE)


def _number(value: Any, low: float, high: float) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise ValueError(f"{quote(value)} is no number from {low:g} to {high:g}")
    return float(value)


def _course(robot: int, commands: list[Command], fixes: list[Observation]) -> RobotRecording:
    seen = np.array(sorted(fixes))
    seen = seen[np.concatenate(([True], np.diff(seen[:, 0]) > 0.0))]
    poses = np.column_stack([seen[:, 1], seen[:, 2], np.unwrap(seen[:, 3])])
    commands = sorted(commands, key=lambda command: command[0])
    wheels = np.array([pairs[robot] for _, pairs in commands])
    return RobotRecording(np.array([time for time, _ in commands]), wheels, seen[:, 0], poses)
