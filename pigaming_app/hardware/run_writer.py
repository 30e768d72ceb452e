"""Writing a run of real robots (see recordings), to a file or, compressed, to memory."""

import gzip
import json
from collections.abc import Callable, Sequence
from pathlib import Path
from threading import Lock
from typing import Any

from pigaming_app.hardware.signals import Fix, WheelCommand
from pigaming_app.sim.plant import Sighting
from pigaming_app.storage.safe_files import AtomicFile

FORMAT = "pigaming-run-1"
RUN_PART = "run.jsonl.gz"  # a run in the file of a match
BLOCK = 1 << 16  # bytes of lines that are compressed together
LONGEST = 7000.0  # s of a run in memory, less than recordings.MAX_DURATION: a match may wait for hours


class Recorder:
    """Receives all commands, fixes and estimates of a rig."""

    def record_commands(self, time: float, wheels: Sequence[WheelCommand | None]) -> None:
        """Record the commands of all robots, sent at `time` (s)."""

    def record_fixes(self, now: float, captured: float, fixes: Sequence[Fix]) -> None:
        """Record the fixes of a picture taken at `captured` and processed at `now` (s); those of ROS have own times."""

    def record_estimates(self, now: float, sightings: Sequence[Sighting]) -> None:
        """Record the tracker's estimates."""


class RunWriter(Recorder):
    """Writes a run line by line through `write`."""

    def __init__(self, write: Callable[[bytes], object], mm: float, emulated: bool = False) -> None:
        self._append = write
        self._seq = 0
        self._write({"kind": "head", "format": FORMAT, "mm": mm, "emulated": emulated})

    def record_commands(self, time: float, wheels: Sequence[WheelCommand | None]) -> None:
        self._seq += 1
        pairs = [pair and list(pair) for pair in wheels]
        self._write({"kind": "sent", "time": time, "seq": self._seq, "wheels": pairs})

    def record_fixes(self, now: float, captured: float, fixes: Sequence[Fix]) -> None:
        for time in sorted({fix.captured for fix in fixes}) or [captured]:
            raw = [[fix.robot, fix.x, fix.y, fix.heading] for fix in fixes if fix.captured == time]
            self._write({"kind": "seen", "captured": time, "time": now, "fixes": raw})

    def record_estimates(self, now: float, sightings: Sequence[Sighting]) -> None:
        self._write({"kind": "pose", "time": now, "poses": [list(sighting[:3]) for sighting in sightings]})

    def _write(self, line: dict[str, Any]) -> None:
        self._append(f"{json.dumps(line, separators=(',', ':'))}\n".encode())


class RecordingWriter(RunWriter):
    """Writes a run to a file, which appears on `close`. Raises OSError."""

    def __init__(self, path: Path, mm: float, emulated: bool = False) -> None:
        self._draft = AtomicFile(path)
        super().__init__(self._draft.write, mm, emulated)

    def close(self) -> None:
        """Finish the file and move it to its path."""
        self._draft.finish()

    def discard(self) -> None:
        """Abandon an incomplete run; an earlier file at that path stays. No effect after `close`."""
        self._draft.discard()


class RunInMemory(RunWriter):
    """A run in memory, compressed while it is recorded; it ends after LONGEST. For use from several threads.

    Estimates are left out: the recording of a match has them tick by tick.
    """

    def __init__(self, mm: float, emulated: bool = False) -> None:
        self._blocks: list[bytes] = []
        self._open = bytearray()
        self._lock = Lock()
        self._end = float("inf")
        super().__init__(self._add, mm, emulated)

    def compressed(self) -> bytes:
        """The run up to now: JSONL in gzip blocks."""
        with self._lock:
            return b"".join([*self._blocks, gzip.compress(self._open, 6, mtime=0)])

    def record_estimates(self, now: float, sightings: Sequence[Sighting]) -> None:
        pass

    def _write(self, line: dict[str, Any]) -> None:
        if "time" in line:
            self._end = min(self._end, line["time"] + LONGEST)
            if line["time"] > self._end:
                return
        super()._write(line)

    def _add(self, line: bytes) -> None:
        with self._lock:
            self._open += line
            if len(self._open) >= BLOCK:
                self._blocks.append(gzip.compress(self._open, 6, mtime=0))
                self._open.clear()
