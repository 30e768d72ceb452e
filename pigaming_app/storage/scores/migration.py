"""The scores file of version 1.3.0: how it is read, backed up and carried over.

It stays where it is, so that version 1.3.0 still finds it. Its tables were named after the arena alone, or after the
arena, the feat and perhaps the goal: "classic", "classic lap", "classic race 3". Neither rules nor people were kept.
Rows that version 1.3.0 adds later are carried over at the next start.
"""

import os
import re
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from hashlib import sha256
from itertools import count
from pathlib import Path

from pigaming_app.storage.parsing import QUOTE_LENGTH, describe_error, one_line, parse_toml, read, read_text
from pigaming_app.storage.safe_files import NotSaved, read_or_restore, write_atomic
from pigaming_app.storage.scores.file_format import Content, Migrated, Problems, row_of
from pigaming_app.storage.scores.table import LONGEST, Score, ScoreTable, local

FILE = "scores.toml"
LARGEST = 16_000_000  # bytes
_TIMED = re.compile(r"(?P<arena>.+) (?P<feat>[a-z]+)(?: (?P<goal>\d{1,2}))?", re.DOTALL)

Rows = Counter[tuple[ScoreTable, Score]]


def migrate(folder: Path, content: Content) -> list[str]:
    """Add the rows of version 1.3.0 that are not in `content` yet, and a note of it; what to report."""
    path = folder / FILE
    if not pending(folder, content):
        return []
    found, said = read_or_restore(path, parse, LARGEST)
    if found is None:
        return said
    rows, faults = found
    new = rows - _known(folder, content)
    for (table, row), times in new.items():
        content.tables.setdefault(table, []).extend([row] * times)
    games = Counter(table.game for table, _ in new.elements())
    content.migrated.append(Migrated(FILE, _backup(path), _digest(path), local(None), dict(games)))
    return [*said, *faults.sentences(path)]


def back_up(folder: Path, migrated: Migrated) -> None:
    """Copy the file that was carried over to its backup. Raises NotSaved."""
    path = folder / migrated.file
    try:
        raw = read(path, LARGEST)
    except OSError as error:
        raise NotSaved(f"{path} was not backed up: {describe_error(error)}.") from error
    if sha256(raw).hexdigest() != migrated.digest:
        raise NotSaved(f"{path} was not backed up: it has just changed.")
    if not os.path.lexists(folder / migrated.backup):
        write_atomic(folder / migrated.backup, raw)


def pending(folder: Path, content: Content) -> bool:
    """Whether there is a file of version 1.3.0 that has not been carried over yet. It changes nothing."""
    path = folder / FILE
    return os.path.lexists(path) and _digest(path) not in {one.digest for one in content.migrated}


def parse(text: str) -> tuple[Rows, Problems]:
    """The rows of a file of version 1.3.0, and what is wrong in it. Raises ParseError."""
    rows, faults = Rows(), Problems()
    for game, arena, entries in _tables(parse_toml(text)):
        where = one_line(f"{game}.{arena}", QUOTE_LENGTH)
        if not isinstance(entries, list) or max(len(game), len(arena)) > LONGEST:
            faults.add(where)
            continue
        for entry in entries:
            table = _table(game, arena, entry)
            if table and (row := row_of(table, entry)):
                rows[table, row] += 1
            else:
                faults.add(where)
    return rows, faults


def _tables(found: dict[str, object]) -> Iterator[tuple[str, str, object]]:
    for game, arenas in found.items():
        if isinstance(arenas, dict):
            yield from ((game, arena, entries) for arena, entries in arenas.items())
        else:
            yield game, "", None


def _table(game: str, arena: str, entry: object) -> ScoreTable | None:
    """The table of a row: its name tells arena, feat and goal of a time, the arena alone of points."""
    if not isinstance(entry, dict) or "ms" not in entry:
        return ScoreTable(game, arena, "points")
    told = _TIMED.fullmatch(arena)
    return ScoreTable(game, told["arena"], told["feat"], True, length=int(told["goal"] or 0)) if told else None


def _digest(path: Path) -> str:
    """SHA-256 of a file; empty where it cannot be read."""
    try:
        return sha256(read(path, LARGEST)).hexdigest()
    except OSError:
        return ""


def _backup(path: Path) -> str:
    """The name of the backup: one that is free, or that has the same content already."""
    for number in count(1):
        backup = path.with_name(f"{path.stem}-1.3.0{f'-{number}' * (number > 1)}{path.suffix}")
        if not os.path.lexists(backup) or _digest(backup) == _digest(path):
            return backup.name
    raise AssertionError("count never ends")


def _known(folder: Path, content: Content) -> Rows:
    """The rows that were carried over before: those of the backups, and those still in the tables."""
    known = Rows((table, row) for table, rows in content.tables.items() for row in rows if table.older)
    for one in content.migrated:
        with suppress(OSError, ValueError):
            known |= parse(read_text(folder / one.backup, LARGEST))[0]
    return known
