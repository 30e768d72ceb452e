"""What an arcade plays just now, in a small file beside the event's, for pages that show it.

It is written about once a second and nobody waits for the disk. A reader takes one that no longer changes for gone, by
its own clock: the computers of a shared folder may differ.
"""

import contextlib
import glob
import hashlib
import os
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from pigaming_app.storage.parsing import read_text
from pigaming_app.storage.schema import Line, from_json, to_json

FRESH = 8.0  # s without a change
MOST = 32  # arcades of an event
MAX_BYTES = 4000


@dataclass(frozen=True)
class LiveMatch:
    """An arcade and its match; 0: none. `scores` and `clock` as its screen shows them; `beat` changes each time."""

    arcade: Line
    match: int = 0
    scores: Mapping[Line, Line] = field(default_factory=dict)
    clock: Line = ""
    beat: int = 0


def write(event_file: Path, live: LiveMatch) -> None:
    """Replace the file of an arcade; one that cannot be written is left out."""
    path = _file_of(event_file, live.arcade)
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        draft.write_text(to_json(live), encoding="utf-8")
        os.replace(draft, path)
    except OSError:
        with contextlib.suppress(OSError):
            draft.unlink(missing_ok=True)


def read(event_file: Path, arcade: str) -> LiveMatch | None:
    """What an arcade has written last; None if there is nothing to be read."""
    try:
        return from_json(read_text(_file_of(event_file, arcade), MAX_BYTES), LiveMatch)
    except (OSError, ValueError):
        return None


def remove(event_file: Path, arcade: str) -> None:
    """The arcade is closed, or shows something else."""
    with contextlib.suppress(OSError):
        _file_of(event_file, arcade).unlink(missing_ok=True)


class LiveMatches:
    """Reads the files of all arcades of an event. `clock`: s."""

    def __init__(self, event_file: Path, clock: Callable[[], float] = time.monotonic) -> None:
        self.event_file, self._clock = event_file, clock
        self._seen: dict[str, tuple[str, float]] = {}  # content of each file, and when it was new

    def now(self) -> tuple[LiveMatch, ...]:
        """The arcades that are there, by name."""
        now, seen, found = self._clock(), {}, []
        for path in sorted(self.event_file.parent.glob(f"{glob.escape(_prefix(self.event_file))}*"))[:MOST]:
            try:
                text = read_text(path, MAX_BYTES)
                live = from_json(text, LiveMatch)
            except (OSError, ValueError):
                continue
            before = self._seen.get(path.name)
            seen[path.name] = before if before and before[0] == text else (text, now)
            if now - seen[path.name][1] < FRESH:
                found.append(live)
        self._seen = seen
        return tuple(sorted(found, key=lambda live: live.arcade))


def _prefix(event_file: Path) -> str:
    return f".{event_file.name}.live-"


def _file_of(event_file: Path, arcade: str) -> Path:
    name = hashlib.sha256(arcade.encode()).hexdigest()[:12]
    return event_file.with_name(f"{_prefix(event_file)}{name}")
