"""All high-score tables, in a file shared by several instances of the arcade.

An instance merges its own changes: under the file lock it reads the current file, clears it if requested, and adds its
new rows. So no row of another instance is lost, and tables cleared by another instance remain cleared.
"""

import logging
import os
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from datetime import date, datetime, timedelta
from pathlib import Path
from typing import Annotated, Any

from pigaming_app.storage.file_lock import locked
from pigaming_app.storage.parsing import QUOTE_LENGTH, ParseError, one_line
from pigaming_app.storage.safe_files import NotSaved, read_or_restore, write_with_backup
from pigaming_app.storage.schema import between, from_toml, to_plain, to_toml, typed, valid_entries
from pigaming_app.storage.scores.table import (
    LENGTH,
    Score,
    ScoreTable,
    are_initials,
    day,
    is_score,
    local,
    worth_keeping,
)

FORMAT = 1

FILE = "scores.toml"
MAX_BYTES = 16_000_000
Stamp = tuple[int, int, int]
log = logging.getLogger("pigaming")


@dataclass
class Content:
    """The content of a scores file."""

    tables: dict[ScoreTable, list[Score]] = field(default_factory=dict)
    resets: int = 0

    def copy(self) -> "Content":
        """A copy that shares no lists."""
        return Content({table: [*rows] for table, rows in self.tables.items()}, self.resets)

    def clear(self) -> None:
        """Empty every table, and count it as a reset."""
        self.tables, self.resets = {}, self.resets + 1

    def trim(self, today: date) -> None:
        """Sort every table, and drop rows that are never displayed."""
        self.tables = {table: worth_keeping(table, rows, today) for table, rows in self.tables.items() if rows}

    def rows(self) -> Counter[tuple[ScoreTable, Score]]:
        """The number of occurrences of each row."""
        return Counter((table, row) for table, rows in self.tables.items() for row in rows)


@dataclass
class Problems:
    """Invalid entries that were ignored: their number, and the location of the first."""

    count: int = 0
    first: str = ""

    def add(self, where: str, count: int = 1) -> None:
        """Count invalid entries."""
        self.count += count
        self.first = self.first or where * (count > 0)

    def sentences(self, path: object) -> list[str]:
        """A sentence on all entries; empty if there are none."""
        if not self.count:
            return []
        entries = "1 entry is not a score" if self.count == 1 else f"{self.count} entries are not scores"
        return [f"{path}: {entries} ({'' if self.count == 1 else 'first '}in {self.first}); ignored."]


@dataclass(frozen=True)
class ScoresFile:
    """The file; its tables are validated one by one."""

    resets: Annotated[int, between(0, 10**9)] = 0
    table: tuple[Any, ...] = ()


def parse(text: str) -> tuple[Content, Problems]:
    """Parse a file into its content and the ignored entries. Raises ValueError if it is not a scores file."""
    file = from_toml(text, ScoresFile, FORMAT)
    content, faults = Content(resets=file.resets), Problems()
    for i, entry in enumerate(file.table, 1):
        try:
            table, entries = typed(entry, ScoreTable), typed(entry["rows"], list[Any])
        except (ParseError, KeyError):
            faults.add(f"table {i}")
            continue
        rows = [row for row in valid_entries(entries, Score) if is_score(table, row)]
        faults.add(one_line(f"{table.game}.{table.arena}", QUOTE_LENGTH), len(entries) - len(rows))
        content.tables.setdefault(table, []).extend(rows)
    return content, faults


def to_text(content: Content) -> str:
    """The text of a scores file."""
    tables = [to_plain(table) | {"rows": to_plain(rows)} for table, rows in sorted(content.tables.items()) if rows]
    return to_toml({"resets": content.resets, "table": tables}, FORMAT)


class Scores:
    """The tables of all games. New rows are in memory only, until `save`."""

    def __init__(self) -> None:
        self._content = Content()  # including unsaved changes
        self._seen = Content()  # the file as last read or written
        self._stamp: Stamp | None = None  # of the file at that time
        self._added: list[tuple[ScoreTable, Score]] = []
        self._cleared = False

    @classmethod
    def load(cls, folder: Path) -> "tuple[Scores, list[str]]":
        """Load the tables from the folder; returns them with a sentence for every problem."""
        scores = cls()
        if not os.path.isdir(folder):  # unlike Path.is_dir, never raises
            return scores, []
        try:
            with locked(folder / FILE):
                problems = scores._refresh(folder)
        except NotSaved:  # another instance holds the lock; the file is complete nevertheless
            problems = scores._refresh(folder)
        return scores, problems

    @property
    def unsaved(self) -> bool:
        """True if `save` has something to write."""
        return self._cleared or bool(self._added)

    def save(self, folder: Path) -> None:
        """Merge the changes into the file. Raises NotSaved; the file is then intact and the changes remain unsaved."""
        with locked(folder / FILE):
            if _stamp(folder / FILE) != self._stamp:
                before = self._seen
                problems = self._refresh(folder)
                for sentence in [*problems, *_merged(before, self._seen)]:
                    log.warning("%s", sentence)
            self._write(folder)

    def tables(self) -> list[ScoreTable]:
        """The tables that have rows, sorted."""
        return sorted(table for table, rows in self._content.tables.items() if rows)

    def add(self, table: ScoreTable, initials: str, score: int, when: datetime | None = None) -> Score:
        """Add a row; `when` defaults to now. Raises ValueError unless the initials are three letters A to Z."""
        if not are_initials(initials):
            raise ValueError(f"initials are three of A to Z, not {initials!r}")
        row = Score(initials, score, when or datetime.now())
        self._added.append((table, row))
        self._insert([(table, row)])
        return row

    def best(self, table: ScoreTable, days: int | None = None, now: datetime | None = None) -> list[Score]:
        """At most LENGTH rows of a table, best first: of all time, or of the last `days` (1: today; at most DAYS)."""
        rows = self._content.tables.get(table, [])
        if days is not None:
            today = local(now).date()
            first = today - timedelta(days=days - 1)
            rows = [row for row in rows if first <= day(row) <= today]
        return rows[:LENGTH]

    def place(self, table: ScoreTable, score: int, days: int | None = None, now: datetime | None = None) -> int | None:
        """The place of a new score in a table, from 1, after equal ones; None if it does not enter it."""
        ahead = sum(table.at_least(row.score, score) for row in self.best(table, days, now))
        return ahead + 1 if ahead < LENGTH else None

    def reset(self) -> None:
        """Empty every table."""
        self._content.clear()
        self._added.clear()
        self._cleared = True

    def _refresh(self, folder: Path) -> list[str]:
        """Read the current file and apply the unsaved changes. Returns sentences for the operator."""
        path = folder / FILE
        self._stamp = _stamp(path)  # before reading: if the file is replaced meanwhile, it is read again
        parsed, messages = read_or_restore(path, parse, MAX_BYTES)
        self._seen, problems = parsed or (Content(), Problems())
        messages += problems.sentences(path)
        self._content = self._seen.copy()
        self._content.trim(local(None).date())
        if self._cleared:
            self._content.clear()
        self._insert(self._added)
        return messages

    def _write(self, folder: Path) -> None:
        """Write the file if it has changed. Raises NotSaved."""
        if not self.unsaved:
            return
        write_with_backup(folder / FILE, to_text(self._content))
        self._added.clear()
        self._cleared = False
        self._seen, self._stamp = self._content.copy(), _stamp(folder / FILE)

    def _insert(self, rows: Iterable[tuple[ScoreTable, Score]]) -> None:
        """Insert rows into the sorted tables."""
        today = local(None).date()
        for table, row in rows:
            tables = self._content.tables
            tables[table] = worth_keeping(table, [*tables.get(table, []), row], today)


def _stamp(path: Path) -> Stamp | None:
    """Inode, modification time and size, which differ once the file is replaced; None if there is no file."""
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_ino, status.st_mtime_ns, status.st_size


def _merged(before: Content, now: Content) -> list[str]:
    """Sentences for the log on changes to the file by other instances."""
    rows = now.rows()
    messages = []
    if now.resets != before.resets:
        messages.append("another copy of the arcade has cleared the scores.")
    else:
        rows -= before.rows()
    if more := rows.total():
        messages.append(f"scores of another copy of the arcade merged: {more} {'row' if more == 1 else 'rows'}.")
    return messages
