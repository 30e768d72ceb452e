"""Events on disk. Spec and journal are the whole file, so a kill or a power cut loses nothing that was saved:

{"format": 1,
 "spec": {"title": "Open day", "format": "swiss", "games": ["pitanks"], "entrants": [{"name": "AAA", …}, …], …},
 "journal": [{"entry": "result", "match": 1, "places": [["AAA"], ["BBB"]], "scores": {"AAA": 7.0, "BBB": 2.0}}, …]}

A file is replaced in one step (temporary file, fsync, rename) and has a backup, the version before.
"""

import contextlib
import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from itertools import takewhile
from math import isfinite
from pathlib import Path
from typing import Any

from pigaming_app.events.event import Event
from pigaming_app.events.journal import Added, Corrected, Entry, Postponed, Recorded, Substituted, Withdrawn
from pigaming_app.events.spec import Advance, Entrant, EventSpec, Format, Outcome
from pigaming_app.storage.file_lock import locked
from pigaming_app.storage.parsing import describe_error, parse_json, quote, read_text
from pigaming_app.storage.safe_files import NotSaved, backup_of, read_or_restore, write_with_backup

FOLDER = "events"  # below the data folder
FORMAT = 1
MAX_BYTES = 8_000_000
LONGEST = 400  # characters of a text in a file


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


def _joined(path: Path, event: Event, known: Event) -> Event:
    """An event with the entries that only `known` has, as far as they are still possible."""
    if replace(event.spec, title=known.spec.title) != known.spec:
        raise ValueError(f"{path}: another event")
    pairs = zip(event.journal, known.journal, strict=False)
    common = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))
    others = event.journal[common:]
    for entry in known.journal[common:]:
        if entry not in others:
            with contextlib.suppress(ValueError):  # the other process was faster
                event = event.after(entry)
    return event


def delete(path: Path) -> None:
    """Delete an event and its backup. Raises NotSaved if it is still there."""
    with locked(path):
        try:
            for file in (backup_of(path), path):
                file.unlink(missing_ok=True)
        except OSError as error:
            raise NotSaved(f"{path} was not deleted: {describe_error(error)}.") from error
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
    match parse_json(text):
        case {"format": 1, "spec": dict(spec), "journal": list(journal)}:
            pass
        case {"format": other} if other != FORMAT:
            raise ValueError(f"its format is {quote(other)}, not {FORMAT}")
        case _:
            raise ValueError("it is not an event")
    event = Event(_spec(spec), tuple(_entry(entry) for entry in journal))
    _ = event.progress  # raises ValueError for an impossible journal
    return event


def to_text(event: Event) -> str:
    """The text of a file."""
    spec = event.spec
    plain = {
        "title": spec.title,
        "format": spec.format.value,
        "games": spec.games,
        "entrants": [_plain_entrant(entrant) for entrant in spec.entrants],
        "rounds": spec.rounds,
        "seats": spec.seats,
        "arenas": {game: arenas[0] if len(arenas) == 1 else arenas for game, arenas in spec.arenas.items()},
        "minutes": dict(spec.minutes),
        "variants": dict(spec.variants),
        "seed": spec.seed,
        "advance": spec.advance.value,
        "fill": spec.fill,
    }
    head = json.dumps(plain, ensure_ascii=False)
    journal = ",\n  ".join(json.dumps(_plain(entry), ensure_ascii=False) for entry in event.journal)
    return f'{{"format": {FORMAT},\n "spec": {head},\n "journal": [\n  {journal}\n]}}\n'


def _plain_entrant(entrant: Entrant) -> dict[str, str]:
    plain = {"name": entrant.name, "brain": entrant.brain, "team": entrant.team}
    return {key: value for key, value in plain.items() if value}


def _plain(entry: Entry) -> dict[str, Any]:
    match entry:
        case Recorded(outcome):
            return {"entry": "result", **_plain_outcome(outcome)}
        case Corrected(outcome):
            return {"entry": "correction", **_plain_outcome(outcome)}
        case Added(entrant):
            return {"entry": "late", **_plain_entrant(entrant)}
        case Withdrawn(name):
            return {"entry": "withdrawal", "name": name}
        case Postponed(fixture):
            return {"entry": "postponement", "match": fixture}
        case Substituted(name, brain):
            return {"entry": "substitute", "name": name, "brain": brain}


def _plain_outcome(outcome: Outcome) -> dict[str, Any]:
    plain = {"match": outcome.fixture, "places": outcome.places, "scores": dict(outcome.scores)}
    more = {"note": outcome.note, "extra": outcome.extra}
    return plain | {key: value for key, value in more.items() if value}


def _entry(value: Any) -> Entry:
    match value:
        case {"entry": "result", "match": _}:
            return Recorded(_outcome(value))
        case {"entry": "correction", "match": _}:
            return Corrected(_outcome(value))
        case {"entry": "late", "name": _}:
            return Added(_entrant(value))
        case {"entry": "withdrawal", "name": name}:
            return Withdrawn(_text(name))
        case {"entry": "postponement", "match": int(number)}:
            return Postponed(number)
        case {"entry": "substitute", "name": name, "brain": brain}:
            return Substituted(_text(name), _text(brain))
    raise ValueError(f"{quote(value)} is not an entry of a journal")


def _outcome(value: Mapping[str, Any]) -> Outcome:
    match value:
        case {"match": int(number), "places": list(places), "scores": dict(scores)}:
            pass
        case _:
            raise ValueError(f"{quote(value)} is not a result")
    if not all(isinstance(place, list) for place in places):
        raise ValueError(f"{quote(places)} are no places")
    named = tuple(tuple(_text(name) for name in place) for place in places)
    points = {_text(name): _number(score) for name, score in scores.items()}
    extra = value.get("extra", 0)
    if type(extra) is not int:
        raise ValueError(f"{quote(extra)} is no number of an extra match")
    return Outcome(number, named, points, _text(value.get("note", "")), extra)


def _spec(value: Mapping[str, Any]) -> EventSpec:
    match value:
        case {"title": title, "format": str(form), "games": list(games), "entrants": list(entrants)}:
            pass
        case _:
            raise ValueError("its spec lacks title, format, games or entrants")
    rounds, seats, seed = (value.get(key, usual) for key, usual in (("rounds", 0), ("seats", 2), ("seed", 1)))
    if any(type(number) is not int for number in (rounds, seats, seed)):
        raise ValueError("rounds, seats and seed are whole numbers")
    advance = value.get("advance", Advance.HALF.value)
    if form not in [*Format] or advance not in [*Advance]:
        raise ValueError(f"no format {quote(form)} with {quote(advance)}")
    return EventSpec(
        title=_text(title),
        format=Format(form),
        games=tuple(_text(game) for game in games),
        entrants=tuple(_entrant(entrant) for entrant in entrants),
        rounds=rounds,
        seats=seats,
        arenas=_table(value, "arenas", _arenas),
        minutes=_table(value, "minutes", _number),
        variants=_table(value, "variants", _text),
        seed=seed,
        advance=Advance(advance),
        fill=_text(value.get("fill", "")),
    )


def _table(value: Mapping[str, Any], key: str, of: Callable[[Any], Any]) -> dict[str, Any]:
    found = value.get(key, {})
    if not isinstance(found, dict):
        raise ValueError(f"{key} = {quote(found)} is not a table")
    return {_text(game): of(choice) for game, choice in found.items()}


def _arenas(value: Any) -> tuple[str, ...]:
    """One arena, or several that take turns."""
    return tuple(_text(arena) for arena in (value if isinstance(value, list) else [value]))


def _entrant(value: Any) -> Entrant:
    if not isinstance(value, dict):
        raise ValueError(f"{quote(value)} is not an entrant")
    return Entrant(_text(value.get("name")), _text(value.get("brain", "")), _text(value.get("team", "")))


def _text(value: Any) -> str:
    if not isinstance(value, str) or len(value) > LONGEST or not value.isprintable():
        raise ValueError(f"{quote(value)} is not a short text")
    return value


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        raise ValueError(f"{quote(value)} is not a number")
    return float(value)
