"""Unfinished climbs on disk, so that a power cut or a kill loses at most the match in progress.

Every running climb has its own number, so copies of the arcade do not overwrite each other's. The file:

format = 1

[[climb]]
number = 4711
when = 2026-11-22T10:00:00+00:00
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
from dataclasses import asdict, dataclass, fields
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

from pigaming_app.events.ladder import ALL, LEVELS, MOST_LOST, NEEDED, Climb, climbed_games
from pigaming_app.storage.file_lock import locked
from pigaming_app.storage.parsing import parse_toml
from pigaming_app.storage.safe_files import read_or_restore, write_with_backup

FILE = "ladder.toml"
FORMAT = 1
MOST = 8  # climbs kept
KEPT = timedelta(hours=2)
NUMBERS = 10**9
LIMITS = {
    "rung": (1, LEVELS + 1),
    "wins": (0, NEEDED - 1),
    "losses": (0, NEEDED - 1),
    "clear": (0, MOST_LOST),
    "beaten": (0, LEVELS),
    "lost": (0, MOST_LOST * 10),
}


@dataclass(frozen=True)
class SavedClimb:
    """A climb in the file."""

    number: int
    when: datetime
    climb: Climb


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
    document = parse_toml(text)
    if type(document.get("format")) is not int or document["format"] != FORMAT:
        raise ValueError(f"its format is not {FORMAT}")
    entries = document.get("climb", [])
    found = [saved for entry in (entries if isinstance(entries, list) else []) if (saved := _saved(entry))]
    return sorted(found, key=lambda saved: saved.when, reverse=True)[:MOST]


def to_text(climbs: list[SavedClimb]) -> str:
    """The text of a file."""
    import tomli_w

    entries = [{"number": saved.number, "when": saved.when, **asdict(saved.climb)} for saved in climbs]
    return tomli_w.dumps({"format": FORMAT, "climb": entries})


def _change(folder: Path, number: int, saved: SavedClimb | None) -> None:
    path = folder / FILE
    with locked(path):
        before, _ = saved_climbs(folder)
        others = [other for other in before if other.number != number]
        if saved or len(others) < len(before):
            write_with_backup(path, to_text([*([saved] if saved else []), *others][:MOST]))


def _saved(entry: Any) -> SavedClimb | None:
    names = {field.name for field in fields(Climb)}
    if not isinstance(entry, dict) or entry.keys() != {"number", "when", *names}:
        return None
    number, when, game = entry["number"], entry["when"], entry["game"]
    if type(number) is not int or not 0 < number <= NUMBERS or game not in (*climbed_games(), ALL):
        return None
    if not isinstance(when, datetime) or when.tzinfo is None:
        return None
    if not isinstance(entry["eased"], list):
        return None
    values = {name: entry[name] for name in LIMITS}
    if not all(type(value) is int and LIMITS[name][0] <= value <= LIMITS[name][1] for name, value in values.items()):
        return None
    climb = Climb(game, eased=_eased(entry["eased"], values["rung"]), **values)
    return SavedClimb(number, when, climb) if len(climb.eased) == len(entry["eased"]) else None


def _eased(value: Any, rung: int) -> tuple[int, ...]:
    """The rungs of a list, as far as robots there and above have at least level 1."""
    found: list[int] = []
    for start in value:
        if type(start) is int and max([2, len(found) + 2, *found]) <= start <= min(rung, LEVELS):
            found.append(start)
    return tuple(found)
