"""The day log: every match, start, end and failure of the arcade, and the batteries of its robots.

A text file for each day in the folder `days` of the user's data, one JSON object a line; lines are only appended.
A line is written at once, so a killed process loses none. Lines that cannot be read are skipped and counted. Each names
its arcade, as several may run at once; while one runs, it holds the lock of a file of its name.
"""

import contextlib
import json
import logging
import os
import re
import secrets
from dataclasses import asdict, dataclass, replace
from datetime import date, datetime, timedelta
from math import isfinite
from pathlib import Path
from typing import Any

from pigaming_app.storage.file_lock import hold, is_held
from pigaming_app.storage.log import require_file
from pigaming_app.storage.parsing import ParseError, describe_error, one_line, parse_json, read

FOLDER = "days"
RUNNING = "running-"  # beginning of the name of an arcade's file
KEPT_DAYS = 56  # days after which a file is deleted
MAX_BYTES = 8_000_000  # of one day; nothing is appended beyond
MAX_LINE = 1000  # characters
MOST_SECONDS = 86_400.0  # of a match
MOST_VOLTS = 100.0
ROBOTS = ("simulated", "emulated", "real")
PROGRAM = ("start", "end", "failure")  # failure: of a screen; the arcade went on at the title
_NAME = re.compile(r"[a-z0-9_]{1,60}")
_ARCADE = re.compile(r"[0-9a-f]{0,16}")
_FILE = re.compile(r"(\d{4}-\d{2}-\d{2})\.jsonl")
log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class PlayedMatch:
    """A match. `seconds` of match time; `complete`: false if it was left before its end."""

    at: datetime  # its start, local time
    game: str
    seconds: float
    people: int
    ais: int
    robots: str = "simulated"  # one of ROBOTS
    complete: bool = True
    arcade: str = ""  # a name of the run of the arcade; empty in a log without names


@dataclass(frozen=True)
class ProgramEvent:
    """One of PROGRAM."""

    at: datetime
    what: str
    arcade: str = ""


@dataclass(frozen=True)
class Battery:
    """The battery of robot 1 to 4, V."""

    at: datetime
    robot: int
    volts: float
    arcade: str = ""


Record = PlayedMatch | ProgramEvent | Battery


class DamagedLine(ValueError):
    """A line is no record; the message is a short reason."""


class DayLog:
    """Appends records to the log in a data folder; without one it keeps nothing. Losses are logged, never raised."""

    def __init__(self, data: Path | None = None) -> None:
        self.folder = data / FOLDER if data else None
        self.arcade = secrets.token_hex(4)
        self._held: int | None = None  # handle of the file of this arcade, while it runs
        self._silent = False  # a loss has been logged

    def add(self, record: Record) -> None:
        """Append a record to the file of its day."""
        if self.folder is None:
            return
        try:
            line = to_line(replace(record, arcade=self.arcade))
            _append(self.folder / f"{record.at:%Y-%m-%d}.jsonl", line)
        except (OSError, ValueError) as error:
            if not self._silent:
                log.warning("The day log cannot be written: %s.", describe_error(error))
            self._silent = True

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
    kind = {PlayedMatch: "match", Battery: "battery"}.get(type(record))
    values = {"what": kind} if kind else {}
    values |= asdict(record) | {"at": record.at.isoformat(timespec="seconds")}
    if not record.arcade:
        del values["arcade"]
    return json.dumps(values, separators=(",", ":"))


def parse_line(line: str) -> Record:
    """The record of a line. Raises DamagedLine."""
    try:
        return _parsed(line)
    except ValueError as error:
        raise DamagedLine(str(error)) from None


def _parsed(line: str) -> Record:
    """The record of a line. Raises ValueError."""
    if len(line) > MAX_LINE:
        raise ValueError("the line is too long")
    values = parse_json(line)
    if not isinstance(values, dict):
        raise ParseError("not an object")
    at = datetime.fromisoformat(_text(values, "at"))
    if at.tzinfo is not None:
        raise ValueError("at: not local time")
    what, arcade = values.get("what"), values.get("arcade", "")
    if not isinstance(arcade, str) or not _ARCADE.fullmatch(arcade):
        raise ValueError("arcade: no name")
    if what in PROGRAM:
        return ProgramEvent(at, str(what), arcade)
    if what == "battery":
        return Battery(at, _whole(values, "robot", 1, 4), _number(values, "volts", MOST_VOLTS), arcade)
    if what != "match":
        raise ValueError("what: unknown")
    game, robots, complete = _text(values, "game"), _text(values, "robots"), values.get("complete")
    if not _NAME.fullmatch(game) or robots not in ROBOTS or not isinstance(complete, bool):
        raise ValueError("not a match")
    seconds = _number(values, "seconds", MOST_SECONDS)
    people, ais = _whole(values, "people", 0, 4), _whole(values, "ais", 0, 4)
    return PlayedMatch(at, game, seconds, people, ais, robots, complete, arcade)


def _append(path: Path, line: str) -> None:
    """Append a line; one that an interrupted write has left incomplete is ended first. Raises OSError."""
    path.parent.mkdir(parents=True, exist_ok=True)
    require_file(path)
    with path.open("a+b") as file:
        size = file.seek(0, os.SEEK_END)
        if size > MAX_BYTES:
            raise OSError(f"{one_line(str(path))} is full")
        if size:
            file.seek(size - 1)
        torn = size > 0 and file.read(1) != b"\n"
        file.write((b"\n" if torn else b"") + line.encode() + b"\n")


def _text(values: dict[str, Any], key: str) -> str:
    value = values.get(key)
    if not isinstance(value, str):
        raise ValueError(f"{key}: not a text")
    return value


def _whole(values: dict[str, Any], key: str, low: int, high: int) -> int:
    value = values.get(key)
    if type(value) is not int or not low <= value <= high:
        raise ValueError(f"{key}: not a number from {low} to {high}")
    return value


def _number(values: dict[str, Any], key: str, high: float) -> float:
    value = values.get(key)
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value) or not 0 <= value <= high:
        raise ValueError(f"{key}: not a number from 0 to {high:g}")
    return float(value)
