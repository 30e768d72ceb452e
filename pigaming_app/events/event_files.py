"""Events on disk. Spec and journal are the whole file, so a kill or a power cut loses nothing that was saved:

{"format": 1,
 "spec": {"title": "Open day", "format": "swiss", "games": ["pitanks"], "entrants": [{"name": "AAA", …}, …], …},
 "journal": [{"entry": "result", "outcome": {"fixture": 1, "places": [["AAA"], ["BBB"]], …}}, …]}

A file is replaced in one step (temporary file, fsync, rename) and has a backup, the version before.
"""

import contextlib
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import takewhile
from pathlib import Path

from pigaming_app.events.event import Event
from pigaming_app.events.journal import Entry, Summoned
from pigaming_app.events.spec import EventSpec
from pigaming_app.storage.file_lock import locked
from pigaming_app.storage.parsing import describe_error, read_text
from pigaming_app.storage.safe_files import backup_of, read_or_restore, write_with_backup
from pigaming_app.storage.schema import from_json, to_json
from pigaming_app.storage.trash import discard

FOLDER = "events"  # below the data folder
FORMAT = 1
MAX_BYTES = 8_000_000


@dataclass(frozen=True)
class EventFile:
    """The content of a file."""

    spec: EventSpec
    journal: tuple[Entry, ...]


@dataclass(frozen=True)
class Listed:
    """A file in the folder; `event` is None if it cannot be read."""

    path: Path
    event: Event | None


def path_of(title: str, folder: Path) -> Path:
    """A new file for an event of this title; `folder` holds all events."""
    stem = re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")[:40] or "event"
    names = [stem, *(f"{stem}-{number}" for number in range(2, 1000))]
    return next(path for name in names if not (path := folder / f"{name}.json").exists())


def load(path: Path) -> tuple[Event | None, list[str]]:
    """The event of a file, and sentences on damage. None without a file, or if neither it nor its backup is usable.

    A damaged event is set aside and replaced by its backup; a file without one, perhaps no event at all, stays.
    """
    try:
        return parse(read_text(path, MAX_BYTES)), []
    except FileNotFoundError:
        return None, []
    except (OSError, ValueError) as error:
        if _readable(backup_of(path) if path.name else path) is None:
            return None, [f"{path} cannot be read ({describe_error(error)})."]
    return read_or_restore(path, parse, MAX_BYTES)


def save(path: Path, event: Event) -> None:
    """Save an event; it is on the disk when this returns. Raises NotSaved."""
    with locked(path):
        write_with_backup(path, to_text(event))


def update(path: Path, change: Callable[[Event], Event], known: Event | None = None) -> Event:
    """Change the event in the file, also while another process does. Raises NotSaved, or ValueError of the change.

    `known`: the event as this process has it. It spares parsing the file if nobody else has changed it, takes the place
    of a file that is gone or damaged, and what a full disk has kept out of the file is added.
    """
    with locked(path):
        event = change(latest(path, known))
        write_with_backup(path, to_text(event))
    return event


def latest(path: Path, known: Event | None = None) -> Event:
    """The event in the file with what only `known` has, see `update`. Raises ValueError if there is none."""
    if known is not None and _is_saved(path, known):
        return known
    event, problems = load(path)
    if event is None:
        if known is None:
            raise ValueError(problems[-1] if problems else f"{path}: no such event")
        return known
    return _joined(path, event, known) if known is not None else event


def version(path: Path) -> tuple[int, ...]:
    """Changes with the file, as each save replaces it; empty without one."""
    try:
        found = path.stat()
    except OSError:
        return ()
    return found.st_mtime_ns, found.st_size, found.st_ino


def _joined(path: Path, event: Event, known: Event) -> Event:
    """An event with the entries that only `known` has, as far as they are still possible."""
    if not same_event(event, known):
        raise ValueError(f"{path}: another event")
    common, own = beyond(known.journal, event.journal)
    return merged(event, common, own)


def same_event(event: Event, other: Event) -> bool:
    """True for two copies of one event, even under different titles."""
    return replace(event.spec, title=other.spec.title) == other.spec


def beyond(journal: Sequence[Entry], other: Sequence[Entry]) -> tuple[int, list[Entry]]:
    """How many entries two journals have in common at their beginnings, and what one has that the other lacks."""
    pairs = zip(journal, other, strict=False)
    common = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))
    return common, without(journal[common:], other[common:])


def without(entries: Sequence[Entry], others: Sequence[Entry]) -> list[Entry]:
    """Entries without others, each of which takes away one that is equal."""
    left, found = list(others), []
    for entry in entries:
        if entry in left:
            left.remove(entry)
        else:
            found.append(entry)
    return found


def merged(event: Event, common: int, own: Sequence[Entry]) -> Event:
    """The event with entries of a copy that has the same first `common` ones: what it lacks, as far as it is possible.

    Nobody takes over by this a match that others have called meanwhile, nor takes back their call.
    """
    lost: set[int] = set()
    for entry in without(own, event.journal[common:]):
        if isinstance(entry, Summoned):
            if entry.arcade is not None and event.calls.get(entry.fixture, entry.arcade) != entry.arcade:
                lost.add(entry.fixture)
            if entry.fixture in lost:
                continue
        with contextlib.suppress(ValueError):  # others were faster
            event = event.after(entry)
    return event


def delete(path: Path) -> None:
    """Move an event and its backup to the trash. Raises NotSaved if it is still there."""
    with locked(path):
        discard(path, "events")
    with contextlib.suppress(OSError):
        path.with_name(f".{path.name}.lock").unlink(missing_ok=True)


def _is_saved(path: Path, event: Event) -> bool:
    try:
        return read_text(path, MAX_BYTES) == to_text(event)
    except (OSError, ValueError):
        return False


def saved_events(folder: Path, most: int | None = None) -> list[Listed]:
    """The events in a folder, at most `most`, the one that was changed last first. Damaged files stay as they are."""
    found = []
    for path in folder.glob("*.json"):
        try:
            found.append((path.stat().st_mtime, path))
        except OSError:
            continue
    return [Listed(path, _readable(path)) for _, path in sorted(found, reverse=True)[:most]]


def _readable(path: Path) -> Event | None:
    try:
        return parse(read_text(path, MAX_BYTES))
    except (OSError, ValueError):
        return None


def parse(text: str) -> Event:
    """The event of a text. Raises ValueError with the reason if it is none."""
    file = from_json(text, EventFile, FORMAT)
    event = Event(file.spec, file.journal)
    _ = event.progress  # raises ValueError for an impossible journal
    return event


def to_text(event: Event) -> str:
    """The text of a file."""
    journal = ",\n  ".join(map(to_json, event.journal))
    return f'{{"format": {FORMAT},\n "spec": {to_json(event.spec)},\n "journal": [\n  {journal}\n]}}\n'
