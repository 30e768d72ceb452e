"""Migration of the scores file of version 1.3.0: parsing, backup, import.

The file remains in place for version 1.3.0. Its tables are named after the arena alone, or the arena, the feat and
perhaps the goal: "classic", "classic lap", "classic race 3". Rules and number of people are not recorded. Rows that
version 1.3.0 adds later are imported at the next start.
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
from pigaming_app.storage.scores.table import MAX_NAME, Score, ScoreTable, local

FILE = "scores.toml"
MAX_BYTES = 16_000_000
_TIMED = re.compile(r"(?P<arena>.+) (?P<feat>[a-z]+)(?: (?P<goal>\d{1,2}))?", re.DOTALL)

Rows = Counter[tuple[ScoreTable, Score]]


def migrate(folder: Path, content: Content) -> list[str]:
    """Add new rows of version 1.3.0 to `content`, with an entry for the file. Returns sentences for the operator."""
    path = folder / FILE
    if not pending(folder, content):
        return []
    parsed, messages = read_or_restore(path, parse, MAX_BYTES)
    if parsed is None:
        return messages
    rows, faults = parsed
    new = rows - _known(folder, content)
    for (table, row), times in new.items():
        content.tables.setdefault(table, []).extend([row] * times)
    games = Counter(table.game for table, _ in new.elements())
    content.migrated.append(Migrated(FILE, _backup(path), _digest(path), local(None), dict(games)))
    return [*messages, *faults.sentences(path)]


def back_up(folder: Path, migrated: Migrated) -> None:
    """Copy a migrated file to its backup. Raises NotSaved."""
    path = folder / migrated.file
    try:
        raw = read(path, MAX_BYTES)
    except OSError as error:
        raise NotSaved(f"{path} was not backed up: {describe_error(error)}.") from error
    if sha256(raw).hexdigest() != migrated.digest:
        raise NotSaved(f"{path} was not backed up: it has just changed.")
    if not os.path.lexists(folder / migrated.backup):
        write_atomic(folder / migrated.backup, raw)


def pending(folder: Path, content: Content) -> bool:
    """True if there is a file of version 1.3.0 that has not been migrated in its current state. Read-only."""
    path = folder / FILE
    return os.path.lexists(path) and _digest(path) not in {migrated.digest for migrated in content.migrated}


def parse(text: str) -> tuple[Rows, Problems]:
    """Parse a file of version 1.3.0 into its rows and the ignored entries. Raises ParseError."""
    rows, faults = Rows(), Problems()
    for game, arena, entries in _tables(parse_toml(text)):
        where = one_line(f"{game}.{arena}", QUOTE_LENGTH)
        if not isinstance(entries, list) or max(len(game), len(arena)) > MAX_NAME:
            faults.add(where)
            continue
        for entry in entries:
            table = _table(game, arena, entry)
            if table and (row := row_of(table, entry)):
                rows[table, row] += 1
            else:
                faults.add(where)
    return rows, faults


def _tables(document: dict[str, object]) -> Iterator[tuple[str, str, object]]:
    for game, arenas in document.items():
        if isinstance(arenas, dict):
            yield from ((game, arena, entries) for arena, entries in arenas.items())
        else:
            yield game, "", None


def _table(game: str, arena: str, entry: object) -> ScoreTable | None:
    """The table of a row. A table of times is named by arena, feat and goal, one of points by its arena."""
    if not isinstance(entry, dict) or "ms" not in entry:
        return ScoreTable(game, arena, "points")
    name = _TIMED.fullmatch(arena)
    return ScoreTable(game, name["arena"], name["feat"], True, length=int(name["goal"] or 0)) if name else None


def _digest(path: Path) -> str:
    """SHA-256 of a file; empty if it cannot be read."""
    try:
        return sha256(read(path, MAX_BYTES)).hexdigest()
    except OSError:
        return ""


def _backup(path: Path) -> str:
    """The first backup name that is unused, or whose file has the same content."""
    for number in count(1):
        backup = path.with_name(f"{path.stem}-1.3.0{f'-{number}' * (number > 1)}{path.suffix}")
        if not os.path.lexists(backup) or _digest(backup) == _digest(path):
            return backup.name
    raise AssertionError("count never ends")


def _known(folder: Path, content: Content) -> Rows:
    """The rows already migrated: those of the backups, and those still in the tables."""
    known = Rows((table, row) for table, rows in content.tables.items() for row in rows if table.older)
    for migrated in content.migrated:
        with suppress(OSError, ValueError):
            known |= parse(read_text(folder / migrated.backup, MAX_BYTES))[0]
    return known
