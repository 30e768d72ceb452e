"""All tables of scores, and how several copies of the arcade share their file.

A copy writes only its own changes: under the lock of the file it reads what is there now, clears it if it was told to,
and adds its new rows. Then a row of another copy is never lost, and a table that another copy cleared stays cleared.
"""

import logging
import os
from collections.abc import Iterable
from datetime import datetime, timedelta
from pathlib import Path

from pigaming_app.storage.file_lock import locked
from pigaming_app.storage.parsing import read_text
from pigaming_app.storage.safe_files import NotSaved, read_or_restore, write_with_backup
from pigaming_app.storage.scores.file_format import Content, Migrated, Problems, parse, to_text
from pigaming_app.storage.scores.migration import back_up, migrate, pending
from pigaming_app.storage.scores.table import LENGTH, Score, ScoreTable, are_initials, day, local, worth_keeping

FILE = "scores2.toml"  # version 1.3.0 has no use for it and leaves it alone
LARGEST = 16_000_000  # bytes
Stamp = tuple[int, int, int]
log = logging.getLogger("pigaming")


class Scores:
    """The tables of all games. A new row is in memory only, until `save`."""

    def __init__(self) -> None:
        self._content = Content()  # with the own changes
        self._seen = Content()  # the file as it was read or written last
        self._stamp: Stamp | None = None  # of that file
        self._added: list[tuple[ScoreTable, Score]] = []
        self._cleared = False

    @classmethod
    def load(cls, folder: Path) -> "tuple[Scores, list[str]]":
        """The tables kept in the folder, and one sentence for everything that was wrong with them.

        What version 1.3.0 kept is backed up and carried over.
        """
        scores = cls()
        if not os.path.isdir(folder):  # which never raises
            return scores, []
        try:
            with locked(folder / FILE):
                said = scores._refresh(folder)
                try:
                    scores._write(folder)
                except NotSaved as trouble:
                    said.append(str(trouble))
        except NotSaved:  # another copy hangs while it writes; the file is whole all the same
            said = scores._refresh(folder)
        return scores, said

    @property
    def unsaved(self) -> bool:
        """Whether `save` has something to write."""
        return self._cleared or bool(self._added)

    def save(self, folder: Path) -> None:
        """Merge the own changes into the file. Raises NotSaved; then the file is intact and the changes are kept."""
        with locked(folder / FILE):
            if _stamp(folder / FILE) != self._stamp:
                before = self._seen
                said = self._refresh(folder)
                for sentence in [*said, *_merged(before, self._seen)]:
                    log.warning("%s", sentence)
            self._write(folder)

    def tables(self) -> list[ScoreTable]:
        """The tables that have rows, in order."""
        return sorted(table for table, rows in self._content.tables.items() if rows)

    def add(self, table: ScoreTable, initials: str, score: int, when: datetime | None = None) -> Score:
        """Note a score; `when`: now, if not given. Raises ValueError unless the initials are three of A to Z."""
        if not are_initials(initials):
            raise ValueError(f"initials are three of A to Z, not {initials!r}")
        row = Score(initials, score, local(when))
        self._added.append((table, row))
        self._enter([(table, row)])
        return row

    def best(self, table: ScoreTable, days: int | None = None, now: datetime | None = None) -> list[Score]:
        """The table, best first, at most LENGTH rows: of all time, or of the last `days` (1: today; at most DAYS)."""
        rows = self._content.tables.get(table, [])
        if days is not None:
            today = local(now).date()
            first = today - timedelta(days=days - 1)
            rows = [row for row in rows if first <= day(row) <= today]
        return rows[:LENGTH]

    def place(self, table: ScoreTable, score: int, days: int | None = None, now: datetime | None = None) -> int | None:
        """The place of a new score in that table, from 1; None: not in it. It stands behind its equals."""
        ahead = sum(table.at_least(row.score, score) for row in self.best(table, days, now))
        return ahead + 1 if ahead < LENGTH else None

    def reset(self) -> None:
        """Empty every table."""
        self._content.clear()
        self._added.clear()
        self._cleared = True

    # ---- inside

    def _refresh(self, folder: Path) -> list[str]:
        """Take over the file as it is now, with the own changes on top; what to report."""
        path = folder / FILE
        self._stamp = _stamp(path)  # before it is read: if it is replaced meanwhile, it is read again
        found, said = read_or_restore(path, parse, LARGEST)
        self._seen, faults = found or (Content(), Problems())
        said += faults.sentences(path)
        self._content = self._seen.copy()
        said += migrate(folder, self._content)
        self._content.trim(local(None).date())
        if self._cleared:
            self._content.clear()
        self._enter(self._added)
        return said

    def _write(self, folder: Path) -> None:
        """Write the file if it changes; the backups of what was carried over come first. Raises NotSaved."""
        carried = self._content.migrated[len(self._seen.migrated) :]
        if not (self._cleared or self._added or carried):
            return
        for migrated in carried:
            back_up(folder, migrated)
        write_with_backup(folder / FILE, to_text(self._content))
        self._added.clear()
        self._cleared = False
        self._seen, self._stamp = self._content.copy(), _stamp(folder / FILE)

    def _enter(self, rows: Iterable[tuple[ScoreTable, Score]]) -> None:
        """Put rows in their places."""
        today = local(None).date()
        for table, row in rows:
            tables = self._content.tables
            tables[table] = worth_keeping(table, [*tables.get(table, []), row], today)


def _stamp(path: Path) -> Stamp | None:
    """What changes whenever the file is replaced; None: there is no file."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_ino, found.st_mtime_ns, found.st_size


def migrations(folder: Path) -> tuple[list[Migrated], bool]:
    """The files of version 1.3.0 carried over so far, and whether one waits for the next start. It changes nothing."""
    try:
        content, _ = parse(read_text(folder / FILE, LARGEST))
    except (OSError, ValueError):
        content = Content()
    return content.migrated, pending(folder, content)


def _merged(before: Content, now: Content) -> list[str]:
    """What other copies have changed in the file, in sentences for the log."""
    rows = now.rows()
    said = []
    if now.resets != before.resets:
        said.append("another copy of the arcade has cleared the scores.")
    else:
        rows -= before.rows()
    if more := rows.total():
        said.append(f"scores of another copy of the arcade merged: {more} {'row' if more == 1 else 'rows'}.")
    return said
