"""All high-score tables, in a file shared by several instances of the arcade.

An instance merges its own changes: under the file lock it reads the current file, clears it if requested, and adds its
new rows. So no row of another instance is lost, and tables cleared by another instance remain cleared.
"""

import logging
import os
from collections.abc import Iterable
from datetime import datetime, timedelta
from pathlib import Path

from pigaming_app.storage.file_lock import locked
from pigaming_app.storage.safe_files import NotSaved, read_or_restore, write_with_backup
from pigaming_app.storage.scores.file_format import Content, Problems, parse, to_text
from pigaming_app.storage.scores.table import LENGTH, Score, ScoreTable, are_initials, day, local, worth_keeping

FILE = "scores.toml"
MAX_BYTES = 16_000_000
Stamp = tuple[int, int, int]
log = logging.getLogger("pigaming")


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
