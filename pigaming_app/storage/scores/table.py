"""A high-score table: the conditions that make its rows comparable, its rows, and their retention."""

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import UTC, date, datetime, timedelta
from typing import Annotated

from msgspec import Meta

from pigaming_app.storage.schema import between

LENGTH = 10  # rows of a table
DAYS = 7  # retention of daily tables, back from today; as many future days, in case the clock was wrong
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
MOST_POINTS, MOST_MS = 1_000_000, 100_000_000
YEARS = range(1970, 3000)  # a clock without a battery starts in 1970
Name = Annotated[str, Meta(max_length=200)]


@dataclass(frozen=True, order=True)
class ScoreTable:
    """The conditions under which a table's rows were scored."""

    game: Name
    arena: Name
    achievement: Name  # points, lap, race, time …
    timed: bool = False  # milliseconds, lower is better; else points, higher is better
    rules: Name = ""
    length: Annotated[float, between(0, 1000)] = 0  # minutes; laps or pallets in a game with a goal
    people: Annotated[int, between(1, 99)] = 1  # in the match
    side: Annotated[int, between(0, 99)] = 0  # people on the own team; 0: everyone played alone
    auto: bool = False  # against AIs that followed the strength of people

    def at_least(self, score: int, other: int) -> bool:
        """True if `score` is as good as `other`, or better."""
        return score <= other if self.timed else score >= other


@dataclass(frozen=True)
class Score:
    """One row: points or milliseconds. `when` becomes local time with its offset, in whole seconds."""

    initials: Annotated[str, Meta(pattern=r"^[A-Z]{3}\Z")]
    score: int
    when: datetime

    def __post_init__(self) -> None:
        object.__setattr__(self, "when", local(self.when))


def is_score(table: ScoreTable, row: Score) -> bool:
    """True if a row has a plausible value for a table."""
    return 0 < row.score <= MOST_MS if table.timed else abs(row.score) <= MOST_POINTS


def are_initials(text: str) -> bool:
    """True if a text is three of LETTERS."""
    return len(text) == 3 and all(letter in LETTERS for letter in text)


def local(when: datetime | None) -> datetime:
    """A time in the local zone, in whole seconds; None: now. Raises ValueError if the year is not in YEARS."""
    when = when or datetime.now()
    if when.year not in YEARS:
        raise ValueError(f"the year {when.year}")
    try:
        here = when.astimezone().replace(microsecond=0)
    except (OverflowError, OSError) as error:
        raise ValueError(str(error)) from None
    whole = (here.utcoffset() or timedelta()) % timedelta(minutes=1) == timedelta()
    return here if whole else here.astimezone(UTC)  # TOML offsets have no seconds, as Liberia's had until 1972


def day(row: Score) -> date:
    """The local date of a row."""
    return row.when.date()


def worth_keeping(table: ScoreTable, rows: Iterable[Score], today: date) -> list[Score]:
    """The rows that the all-time table or a daily table displays, best first; ties by time."""
    sign = 1 if table.timed else -1
    ordered = sorted(rows, key=lambda row: (sign * row.score, row.when))
    if len(ordered) <= LENGTH:
        return ordered
    days = [day(row) for row in ordered]
    room = dict.fromkeys(_near(set(days), today), LENGTH)
    kept = []
    for rank, (row, date_of_row) in enumerate(zip(ordered, days, strict=True)):
        left = room.get(date_of_row, 0)
        if rank < LENGTH or left > 0:
            kept.append(row)
        if left > 0:
            room[date_of_row] = left - 1
    return kept


def _near(days: set[date], today: date) -> list[date]:
    """The last DAYS days up to today, and the first DAYS days after it."""
    return [*sorted(day for day in days if day <= today)[-DAYS:], *sorted(day for day in days if day > today)[:DAYS]]
