"""Recordings of real robots: commands and observed poses, one JSON object a line (JSONL).

The file of a match with real robots has one as a part (see match_recording).

The first line is the header. Then follow, in chronological order, `sent` lines (time, sequence number, the wheel
commands of every robot as shares of full speed, null where the motors were off), `seen` lines (time of exposure, time
of processing, the raw fixes) and `pose` lines (the tracker's estimate of every robot). Times are s of one monotonic
clock, poses arena px and rad.
"""

import gzip
import zipfile
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Annotated

import numpy as np
from msgspec import Meta, Struct
from numpy.typing import NDArray

from pigaming_app.hardware.run_writer import FORMAT, RUN_PART
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.parsing import describe_error, one_line, parse_json, read
from pigaming_app.storage.schema import between, one_of, typed

MAX_BYTES = 400_000_000  # of a file; an hour has about 100 million
MAX_LINE = 10_000  # bytes
MAX_LINES = 2_000_000  # two hours have about 1.2 million
MAX_FIXES = 1_000_000  # of a robot
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


def load(path: Path, min_observations: int = 50) -> Recording:
    """Read a run; robots with fewer than `min_observations` are left out. Raises RecordingError."""
    try:
        raw = read(path, MAX_BYTES)
        raw = _run_of_match(raw) if raw.startswith(b"PK") else raw
    except OSError as error:
        raise RecordingError(f"{path.name}: cannot be read ({describe_error(error)})") from None
    except ValueError as error:
        raise RecordingError(f"{path.name}: {error}") from None
    run, lines = _RecordingLines(), BytesIO(raw)
    for number, line in enumerate(iter(lambda: lines.readline(MAX_LINE), b""), 1):
        if number > MAX_LINES:
            raise RecordingError(f"{path.name}: more than {MAX_LINES:,} lines")
        try:
            run.add(parse_json(line))
        except ValueError as error:
            if lines.tell() == len(raw) and number > 1:
                break  # the recording stopped in the middle of a line
            raise RecordingError(one_line(f"{path.name}: line {number}: not a line of a run ({error})")) from None
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


def _run_of_match(raw: bytes) -> bytes:
    """The run in the file of a match with real robots. Raises ValueError."""
    try:
        with zipfile.ZipFile(BytesIO(raw)) as archive, archive.open(RUN_PART) as part, gzip.open(part) as run:
            lines = run.read(MAX_BYTES + 1)
    except Exception:  # zipfile and gzip raise many kinds of exceptions for damaged files
        raise ValueError("no run, or a damaged one") from None
    if len(lines) > MAX_BYTES:
        raise ValueError(f"its run is larger than {MAX_BYTES:,} bytes")
    return lines


Moment = Annotated[float, between(-MAX_TIME, MAX_TIME)]  # s
WheelShare = Annotated[float, between(-2.0, 2.0)]
Coordinate = Annotated[float, between(-MAX_COORDINATE, MAX_COORDINATE)]
Number = Annotated[int, between(0, ROBOTS - 1)]  # of a robot


class RunHead(Struct, tag_field="kind", tag="head"):
    """The first line. `mm`: of an arena px on the mat."""

    format: Annotated[str, one_of(FORMAT)]
    mm: Annotated[float, between(0.1, 100.0)]
    emulated: bool = False


class SentLine(Struct, tag_field="kind", tag="sent"):
    """The commands of all robots; None: the motors were off."""

    time: Moment
    wheels: Annotated[tuple[tuple[WheelShare, WheelShare] | None, ...], Meta(min_length=ROBOTS, max_length=ROBOTS)]


class SeenLine(Struct, tag_field="kind", tag="seen"):
    """The fixes of a picture: robot, x, y, heading."""

    captured: Moment
    fixes: tuple[tuple[Number, Coordinate, Coordinate, Coordinate], ...]


class PoseLine(Struct, tag_field="kind", tag="pose"):
    """The tracker's estimates, which are not read."""


class RunLine(Struct):
    """Any line."""

    line: RunHead | SentLine | SeenLine | PoseLine


class _RecordingLines:
    """Parsed lines: `commands` of all robots, `observations` of each; `mm` is 0 before the header."""

    def __init__(self) -> None:
        self.mm, self.emulated = 0.0, False
        self.commands: list[Command] = []
        self.observations: list[list[Observation]] = [[] for _ in range(ROBOTS)]

    def add(self, entry: object) -> None:
        """Take one line over. Raises ValueError."""
        match typed({"line": entry}, RunLine).line:
            case RunHead() as head:
                if self.mm:
                    raise ValueError("a second header")
                self.mm, self.emulated = head.mm, head.emulated
            case SentLine() as sent:
                self.commands.append((sent.time, [[*(pair or (0.0, 0.0))] for pair in sent.wheels]))
            case SeenLine() as seen:
                for robot, x, y, heading in seen.fixes:
                    if len(self.observations[robot]) >= MAX_FIXES:
                        raise ValueError(f"more than {MAX_FIXES:,} poses of a robot")
                    self.observations[robot].append((seen.captured, x, y, heading))


def _course(robot: int, commands: list[Command], fixes: list[Observation]) -> RobotRecording:
    seen = np.array(sorted(fixes))
    seen = seen[np.concatenate(([True], np.diff(seen[:, 0]) > 0.0))]
    poses = np.column_stack([seen[:, 1], seen[:, 2], np.unwrap(seen[:, 3])])
    commands = sorted(commands, key=lambda command: command[0])
    wheels = np.array([pairs[robot] for _, pairs in commands])
    return RobotRecording(np.array([time for time, _ in commands]), wheels, seen[:, 0], poses)
