"""Simulated time of a day, also for the time of day; a few bytes in a file, which survive a kill.

`install` replaces `datetime.datetime` and `datetime.date` in this process by classes whose `now` and `today` follow it:
the day log, the high scores, the quiet hours and the names of files then have simulated times. It has to be called
before the rest of PiGaming is imported. Types of files keep the real classes, which the schema layer knows.
"""

import datetime as datetime_module
import mmap
import struct
from dataclasses import dataclass
from importlib import import_module
from math import inf
from pathlib import Path
from typing import Any

TIME_ZONE = "CET-1CEST,M3.5.0,M10.5.0/3"  # of all days, as in POSIX: no file is needed
RECORD = struct.Struct("<dIII")  # seconds, process, place, frames
STORAGE = "pigaming_app.storage"
EARLY = (f"{STORAGE}.day_log", f"{STORAGE}.scores.book", f"{STORAGE}.scores.table", "pigaming_app.events.climb_files")
PLACES = ("other", "title", "match", "event", "ending", "results")
REAL_DATETIME = datetime_module.datetime
REAL_DATE = datetime_module.date


@dataclass(frozen=True)
class Times:
    """The clock on the wall: `opening` as a timestamp; `set_back` s after it, if ever, it is set back by an hour.

    Local times are in the time zone of the process.
    """

    opening: float = datetime_module.datetime(2026, 6, 20, 8, 0, tzinfo=datetime_module.UTC).timestamp()  # 10:00
    set_back: float = inf

    def wall(self, seconds: float) -> datetime_module.datetime:
        """The local time so many seconds after the opening."""
        return REAL_DATETIME.fromtimestamp(self.stamp(seconds))

    def stamp(self, seconds: float) -> float:
        """The same as a timestamp."""
        return self.opening + seconds - (3600.0 if seconds >= self.set_back else 0.0)


class DayClock:
    """The file, written by the arcade and read by the script that kills it."""

    def __init__(self, path: Path) -> None:
        if not path.exists():
            path.write_bytes(bytes(RECORD.size))
        with path.open("r+b") as file:
            self._bytes = mmap.mmap(file.fileno(), RECORD.size)

    @property
    def seconds(self) -> float:
        """Since the opening."""
        return float(self._read()[0])

    @property
    def process(self) -> int:
        """The process that wrote last; 0: none."""
        return int(self._read()[1])

    @property
    def place(self) -> str:
        """One of PLACES."""
        return PLACES[self._read()[2]]

    @property
    def frames(self) -> int:
        """Of the process that wrote last."""
        return int(self._read()[3])

    def write(self, seconds: float, process: int, place: str, frames: int) -> None:
        self._bytes[:] = RECORD.pack(seconds, process, PLACES.index(place), frames)

    def _read(self) -> tuple[Any, ...]:
        return RECORD.unpack(self._bytes[:])


def install(clock: DayClock, times: Times) -> None:
    """Let this process live in simulated time."""

    class _Same(type):
        """Values of the real class count as well."""

        def __instancecheck__(cls, value: object) -> bool:
            return isinstance(value, REAL_DATETIME if issubclass(cls, REAL_DATETIME) else REAL_DATE)

    class SimulatedDatetime(REAL_DATETIME, metaclass=_Same):
        @classmethod
        def now(cls, tz: Any = None) -> Any:
            return REAL_DATETIME.fromtimestamp(times.stamp(clock.seconds), tz)

    class SimulatedDate(REAL_DATE, metaclass=_Same):
        @classmethod
        def today(cls) -> Any:
            return times.wall(clock.seconds).date()

    for module in map(import_module, EARLY):
        vars(module)["datetime"] = SimulatedDatetime
    datetime_module.datetime = SimulatedDatetime  # type: ignore[misc]
    datetime_module.date = SimulatedDate  # type: ignore[misc]
