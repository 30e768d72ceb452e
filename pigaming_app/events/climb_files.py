"""Unfinished climbs on disk, so that a power cut or a kill loses at most the match in progress.

Every running climb has its own number, so copies of the arcade do not overwrite each other's. The file:

format = 1

[[climb]]
number = 4711
when = 2026-11-22T10:00:00+00:00

[climb.climb]
game = "pitanks"
rung = 3
eased = []
wins = 1
losses = 0
clear = 0
beaten = 2
lost = 1
"""

import secrets
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta

from pigaming_app.events.ladder import ALL, LEVELS, Climb, climbed_games
from pigaming_app.storage.file_lock import locked
from pigaming_app.storage.safe_files import read_or_restore, write_with_backup
from pigaming_app.storage.schema import between, from_toml, to_toml, valid_entries

FILE = "ladder.toml"
FORMAT = 1
MOST = 8  # climbs kept
KEPT = timedelta(hours=2)
NUMBERS = 10**9


@dataclass(frozen=True)
class SavedClimb:
    """A climb in the file."""

    number: Annotated[int, between(1, NUMBERS)]
    when: Annotated[datetime, Meta(tz=True)]
    climb: Climb

    def __post_init__(self) -> None:
        climb = self.climb
        if climb.game not in (*climbed_games(), ALL):
            raise ValueError("no such game")
        lowest = [max(i + 2, *climb.eased[:i], 2) for i in range(len(climb.eased))]  # robots there have level 1
        if any(not low <= start <= min(climb.rung, LEVELS) for low, start in zip(lowest, climb.eased, strict=True)):
            raise ValueError("eased too often")


@dataclass(frozen=True)
class ClimbsFile:
    """The file; its climbs are validated one by one."""

    climb: Any = ()


def new_number() -> int:
    """The number of a new climb."""
    return secrets.randbelow(NUMBERS) + 1


def saved_climbs(folder: Path, now: datetime | None = None) -> tuple[list[SavedClimb], list[str]]:
    """The climbs of the last two hours, newest first, and sentences on a damaged file, which is set aside."""
    read, problems = read_or_restore(folder / FILE, parse)
    now = now or datetime.now().astimezone()
    return [saved for saved in read or [] if abs(now - saved.when) <= KEPT], problems


def save(folder: Path, number: int, climb: Climb) -> None:
    """Save a climb in place of its last state. Raises NotSaved."""
    _change(folder, number, SavedClimb(number, datetime.now().astimezone().replace(microsecond=0), climb))


def delete(folder: Path, number: int) -> None:
    """Delete a climb that has ended. Raises NotSaved."""
    _change(folder, number, None)


def parse(text: str) -> list[SavedClimb]:
    """The valid climbs of a file, newest first. Raises ValueError if it is not such a file."""
    found = valid_entries(from_toml(text, ClimbsFile, FORMAT).climb, SavedClimb)
    return sorted(found, key=lambda saved: saved.when, reverse=True)[:MOST]


def to_text(climbs: list[SavedClimb]) -> str:
    """The text of a file."""
    return to_toml(ClimbsFile(climbs), FORMAT)


def _change(folder: Path, number: int, saved: SavedClimb | None) -> None:
    path = folder / FILE
    with locked(path):
        before, _ = saved_climbs(folder)
        others = [other for other in before if other.number != number]
        if saved or len(others) < len(before):
            write_with_backup(path, to_text([*([saved] if saved else []), *others][:MOST]))
