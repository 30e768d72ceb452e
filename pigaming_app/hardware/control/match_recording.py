"""Recording of a match with real robots: its replay, the robots at every tick, faults, and the run for `fidelity`.

The file is a zip archive. Part `match.replay` is a replay file like that of simulated robots; `robots.bin` is a
RobotTrack, with which the rules are judged again to the same end; `incidents.json` has the faults, and the moves of
things on the mat; `run.jsonl.gz` is a run (see recordings).
"""

import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO
from typing import Annotated, Any, NamedTuple

from msgspec import Meta

from pigaming_app.hardware.control.moving_things import ThingsMove
from pigaming_app.hardware.control.recorded_plant import ROW, SIZE, RobotTrack
from pigaming_app.hardware.control.safety import REMOTE, RULES, Fault
from pigaming_app.hardware.run_writer import RUN_PART, RunInMemory
from pigaming_app.sim.things.spec import read_things, wall_capsules
from pigaming_app.sim.toml_table import FieldError, TomlTable
from pigaming_app.sim.world import ROBOTS, WALLS
from pigaming_app.storage.parsing import parse_json
from pigaming_app.storage.schema import Count, between, from_json, one_of, to_json

MAX_TICKS = 180_000  # an hour
MAX_SECONDS = 86_400.0  # s of a fault
MAX_FAULTS = 10_000
MAGIC = b"PK\x03\x04"
REPLAY, ROBOTS_PART, INCIDENTS = "match.replay", "robots.bin", "incidents.json"
LIMITS = {  # bytes of a part, unpacked
    REPLAY: 8_000_000,
    ROBOTS_PART: ROW * SIZE * (MAX_TICKS + 1),
    RUN_PART: 100_000_000,
    INCIDENTS: 50_000_000,
}
MAX_BYTES = sum(LIMITS.values())
MAX_MOVES = 60 * 60 * 30
NAMES = frozenset(rule.name for rule in RULES) | frozenset(REMOTE.values())


class MatchFileError(ValueError):
    """A file is not a recording of a match; the reason in one line."""


@dataclass
class RecordedFault:
    """A fault of a robot, counted from 0, or of all (None): the tick at which it began, and how long it lasted."""

    name: Annotated[str, one_of(*NAMES)]
    robot: Annotated[int, between(0, ROBOTS - 1)] | None
    tick: Count
    pauses: bool  # True: the match waited
    seconds: Annotated[float, between(0.0, MAX_SECONDS)] = 0.0  # s of real time


@dataclass(frozen=True)
class RecordedIncidents:
    """Part INCIDENTS."""

    faults: Annotated[tuple[RecordedFault, ...], Meta(max_length=MAX_FAULTS)]
    moves: Annotated[tuple[ThingsMove, ...], Meta(max_length=MAX_MOVES)]


class MatchRecording(NamedTuple):
    """What the replay of a match lacks if its robots were real."""

    track: RobotTrack
    faults: tuple[RecordedFault, ...] = ()
    run: bytes = b""  # JSONL, compressed
    moves: tuple[ThingsMove, ...] = ()


class MatchRecorder:
    """Records a match while it is played: the plant adds the robots, the scene the faults, the rig the run."""

    def __init__(self, mm: float, emulated: bool = False) -> None:
        self.track = RobotTrack()
        self.run = RunInMemory(mm, emulated)
        self.faults: list[RecordedFault] = []
        self.moves: list[ThingsMove] = []
        self._present: dict[tuple[str, int | None], RecordedFault] = {}

    def record_faults(self, tick: int, now: float, faults: Sequence[Fault]) -> None:
        """Record the faults present at `now` (s); call it regularly."""
        keys = {(fault.name, fault.robot): fault for fault in faults}
        self._present = {key: one for key, one in self._present.items() if key in keys}
        for key, fault in keys.items():
            if key not in self._present and len(self.faults) < MAX_FAULTS:
                self._present[key] = RecordedFault(fault.name, fault.robot, tick, fault.pauses)
                self.faults.append(self._present[key])
            if key in self._present:
                self._present[key].seconds = min(max(0.0, now - fault.since), MAX_SECONDS)
                self._present[key].pauses |= fault.pauses

    def recording(self, ticks: int, robots: Sequence[Any]) -> MatchRecording:
        """The recording of the first ticks, after which the robots of the world are as they are now."""
        track = self.track.first(ticks)
        track.add(robots)
        moves = tuple(move for move in self.moves if move.tick <= ticks)
        return MatchRecording(track, tuple(self.faults), self.run.compressed(), moves)


def pack(replay: bytes, recording: MatchRecording) -> bytes:
    """The contents of a file."""
    file = BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for name, part in (
            (REPLAY, replay),
            (ROBOTS_PART, recording.track.pack()),
            (INCIDENTS, to_json(RecordedIncidents(recording.faults, recording.moves)).encode()),
            (RUN_PART, recording.run),
        ):
            archive.writestr(zipfile.ZipInfo(name), part)
    return file.getvalue()


def unpack(raw: bytes) -> dict[str, bytes]:
    """The parts of a file. Raises MatchFileError."""
    try:
        with zipfile.ZipFile(BytesIO(raw)) as archive:
            sizes = {entry.filename: entry.file_size for entry in archive.infolist()}
            if sizes.keys() != LIMITS.keys() or len(archive.infolist()) != len(sizes):
                raise MatchFileError("not a recording of a match")
            if any(size > LIMITS[name] for name, size in sizes.items()):
                raise MatchFileError("not a recording of a match: a part of it is too big")
            return {name: archive.read(name) for name in sizes}
    except MatchFileError:
        raise
    except Exception:  # zipfile raises many kinds of exceptions for damaged files
        raise MatchFileError("damaged: it has been cut short or edited") from None


def recording_of(parts: Mapping[str, bytes], ticks: int) -> MatchRecording:
    """The recording in the parts of a file, whose replay has that many ticks. Raises MatchFileError."""
    try:
        track = RobotTrack.unpack(parts[ROBOTS_PART], ticks + 1)
        known = from_json(parts[INCIDENTS], RecordedIncidents)
        for move in known.moves:
            read_things(TomlTable({"thing": parse_json(to_json(move.things))}))
            wall_capsules(move.things, WALLS)
        if any(not 0 <= tick <= ticks for tick in (one.tick for group in (known.faults, known.moves) for one in group)):
            raise ValueError("a tick after the last")
        return MatchRecording(track, known.faults, parts[RUN_PART], known.moves)
    except (ValueError, FieldError) as error:
        raise MatchFileError(f"not a valid recording ({str(error)[:80]!a})") from None
