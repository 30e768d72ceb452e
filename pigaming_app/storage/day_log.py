"""The day log: every match, start, end and failure of the arcade, and the batteries of its robots.

A text file for each day in the folder `days` of the user's data, one JSON object a line; lines are only appended.
A line is on the disk at once, so a kill or a power cut loses none; while the disk is full, lines wait for the next one.
Lines that cannot be read are skipped and counted. Each names its arcade, as several may run at once; while one runs, it
holds the lock of a file of its name.
"""

import contextlib
import errno
import logging
import os
import re
import secrets
from collections import deque
from datetime import date, datetime, timedelta
from pathlib import Path
from typing import Annotated

from msgspec import Meta, Struct
from msgspec.structs import replace

from pigaming_app.storage.file_lock import hold, is_held
from pigaming_app.storage.log import require_file
from pigaming_app.storage.parsing import ParseError, describe_error, one_line, parse_json, read
from pigaming_app.storage.schema import between, one_of, to_json, typed

FOLDER = "days"
RUNNING = "running-"  # beginning of the name of an arcade's file
KEPT_DAYS = 56  # days after which a file is deleted
MAX_BYTES = 8_000_000  # of one day; nothing is appended beyond
MAX_LINE = 1000  # characters
MAX_UNSAVED = 1000  # lines kept while the disk is full
MOST_SECONDS = 86_400.0  # of a match
MOST_VOLTS = 100.0
ROBOTS = ("simulated", "emulated", "real")
PROGRAM = ("start", "end", "failure")  # failure: of a screen; the arcade went on at the title
_FILE = re.compile(r"(\d{4}-\d{2}-\d{2})\.jsonl")
log = logging.getLogger("pigaming")


Local = Annotated[datetime, Meta(tz=False)]
Arcade = Annotated[str, Meta(pattern=r"^[0-9a-f]{0,16}\Z")]
Players = Annotated[int, between(0, 4)]


class PlayedMatch(Struct, frozen=True, tag_field="kind", tag="match"):
    """A match. `seconds` of match time; `complete`: false if it was left before its end."""

    at: Local  # its start
    game: Annotated[str, Meta(pattern=r"^[a-z0-9_]{1,60}\Z")]
    seconds: Annotated[float, between(0.0, MOST_SECONDS)]
    people: Players
    ais: Players
    robots: Annotated[str, one_of(*ROBOTS)] = "simulated"
    complete: bool = True
    arcade: Arcade = ""  # a name of the run of the arcade; empty in a log without names


class ProgramEvent(Struct, frozen=True, tag_field="kind", tag="program"):
    """One of PROGRAM."""

    at: Local
    what: Annotated[str, one_of(*PROGRAM)]
    arcade: Arcade = ""


class Battery(Struct, frozen=True, tag_field="kind", tag="battery"):
    """The battery of robot 1 to 4, V."""

    at: Local
    robot: Annotated[int, between(1, 4)]
    volts: Annotated[float, between(0.0, MOST_VOLTS)]
    arcade: Arcade = ""


Record = PlayedMatch | ProgramEvent | Battery


class DamagedLine(ValueError):
    """A line is no record; the message is a short reason."""


class DayLog:
    """Appends records to the log in a data folder; without one it keeps nothing. Trouble is logged, never raised."""

    def __init__(self, data: Path | None = None) -> None:
        self.folder = data / FOLDER if data else None
        self.arcade = secrets.token_hex(4)
        self._held: int | None = None  # handle of the file of this arcade, while it runs
        self._unsaved = deque[tuple[Path, str]](maxlen=MAX_UNSAVED)  # files and lines
        self._silent = False  # the trouble has been logged

    def add(self, record: Record) -> None:
        """Append a record to the file of its day, after those that could not be written before."""
        if self.folder is None:
            return
        file = self.folder / f"{record.at:%Y-%m-%d}.jsonl"
        self._unsaved.append((file, to_line(replace(record, arcade=self.arcade))))
        for _ in range(len(self._unsaved)):
            path, line = self._unsaved.popleft()
            try:
                _append(path, line)
            except OSError as error:
                self._unsaved.append((path, line))
                if not self._silent:
                    log.warning("The day log cannot be written: %s.", describe_error(error))
                self._silent = True
        self._silent = bool(self._unsaved)

    def note(self, what: str) -> None:
        """Append one of PROGRAM now."""
        self.add(ProgramEvent(now(), what))
        if self.folder is None:
            return
        if what == "start":
            self._held = hold(_running(self.folder, self.arcade))
        elif what == "end" and self._held is not None:
            os.close(self._held)
            self._held = None
            with contextlib.suppress(OSError):
                _running(self.folder, self.arcade).unlink()

    def delete_old(self, today: date) -> None:
        """Delete the files of days more than KEPT_DAYS ago, and those of arcades that crashed."""
        if self.folder is None:
            return
        with contextlib.suppress(OSError):
            for path in self.folder.glob(f"{RUNNING}*"):
                if not is_held(path):
                    path.unlink()
        for day in days(self.folder.parent):
            if day < today - timedelta(days=KEPT_DAYS):
                with contextlib.suppress(OSError):
                    (self.folder / f"{day}.jsonl").unlink()


def runs(data: Path, arcade: str) -> bool:
    """True if an arcade is running now."""
    return is_held(_running(data / FOLDER, arcade))


def _running(folder: Path, arcade: str) -> Path:
    return folder / f"{RUNNING}{arcade}"


def now() -> datetime:
    """The local time, in whole seconds."""
    return datetime.now().replace(microsecond=0)


def days(data: Path) -> list[date]:
    """The days that have a log in the data folder, earliest first."""
    found = []
    with contextlib.suppress(OSError):
        for entry in os.scandir(data / FOLDER):
            if match := _FILE.fullmatch(entry.name):
                with contextlib.suppress(ValueError):
                    found.append(date.fromisoformat(match[1]))
    return sorted(found)


def read_day(data: Path, day: date) -> tuple[list[Record], int]:
    """The records of a day in the order of the file, and the number of lines skipped. Raises OSError.

    A day without a file has no records.
    """
    try:
        text = read(data / FOLDER / f"{day}.jsonl", MAX_BYTES + MAX_LINE).decode("utf-8", "replace")
    except FileNotFoundError:
        return [], 0
    records, skipped = [], 0
    for line in text.split("\n"):
        if line.strip():
            try:
                records.append(parse_line(line))
            except DamagedLine:
                skipped += 1
    return records, skipped


def to_line(record: Record) -> str:
    """The line of a record, without its end."""
    return to_json(record)


def parse_line(line: str) -> Record:
    """The record of a line. Raises DamagedLine."""
    try:
        if len(line) > MAX_LINE:
            raise ParseError("the line is too long")
        return typed(parse_json(line), Record)  # type: ignore[arg-type]
    except ParseError as error:
        raise DamagedLine(str(error)) from None


def _append(path: Path, line: str) -> None:
    """Append a line, which is on the disk then; an incomplete one of an interrupted write is ended first.

    Raises OSError if it does not fit; nothing of it stays then.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    require_file(path)
    with path.open("a+b", buffering=0) as file:
        size = file.seek(0, os.SEEK_END)
        if size > MAX_BYTES:
            raise OSError(f"{one_line(str(path))} is full")
        if size:
            file.seek(size - 1)
        torn = size > 0 and file.read(1) != b"\n"
        raw = (b"\n" if torn else b"") + line.encode() + b"\n"
        written = file.write(raw)
        if written < len(raw):
            if file.seek(0, os.SEEK_END) == size + written:  # no other arcade has appended
                file.truncate(size)
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        with contextlib.suppress(OSError):  # a file system without it
            os.fsync(file.fileno())
