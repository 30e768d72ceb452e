"""The figures of a day, from its log: matches per hour and game, mean length, busiest hour, crashes, batteries."""

import csv
import io
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from datetime import date, datetime, time, timedelta
from pathlib import Path
from typing import Any

from pigaming_app.storage.day_log import Battery, PlayedMatch, ProgramEvent, Record, days, now, read_day, runs

COLUMNS = ("start", "game", "seconds", "people", "ais", "robots")


@dataclass(frozen=True)
class BatteryFigures:
    """Battery of one robot, V: the last reading and the lowest."""

    last: float
    lowest: float


@dataclass(frozen=True)
class ArcadeSession:
    """What an arcade did on a day: from its first record to its last one, or while it runs to now or to midnight."""

    begin: datetime
    end: datetime
    crashed: bool  # no end is recorded, and it does not run any more


@dataclass(frozen=True)
class DayReport:
    """The figures of a day. Matches that were left before their end count as `left` only.

    `crashes`: of arcades, by a crash, a hang or a power cut. `sessions`: of arcades, which may overlap. `failures`:
    screens that failed, after which the title returned. `skipped`: damaged lines of the log.
    """

    day: date
    matches: tuple[PlayedMatch, ...] = ()  # complete ones, by their start
    left: int = 0
    starts: int = 0
    crashes: int = 0
    failures: int = 0
    sessions: tuple[ArcadeSession, ...] = ()  # by their begin
    batteries: dict[int, BatteryFigures] = field(default_factory=dict)  # by robot
    skipped: int = 0

    @property
    def games(self) -> dict[str, int]:
        """Matches by game, the most played one first."""
        counts = Counter(match.game for match in self.matches)
        return dict(sorted(counts.items(), key=lambda pair: (-pair[1], pair[0])))

    @property
    def hours(self) -> dict[int, dict[str, int]]:
        """Matches by game for each hour 0..23 that has any, by their start."""
        table: dict[int, Counter[str]] = {}
        for match in self.matches:
            table.setdefault(match.at.hour, Counter())[match.game] += 1
        return {hour: dict(table[hour]) for hour in sorted(table)}

    @property
    def mean_seconds(self) -> float:
        """Mean length of a match; 0 without any."""
        return sum(match.seconds for match in self.matches) / len(self.matches) if self.matches else 0.0

    @property
    def busiest_hour(self) -> int | None:
        """The hour with the most matches, the earliest of equal ones; None without any."""
        counts = {hour: sum(games.values()) for hour, games in self.hours.items()}
        return max(counts, key=lambda hour: (counts[hour], -hour)) if counts else None

    @property
    def at_once(self) -> int:
        """The most arcades that ran at the same time."""
        return max(
            (sum(one.begin <= other.begin <= one.end for one in self.sessions) for other in self.sessions), default=0
        )

    @property
    def open_seconds(self) -> float:
        """The time during which at least one arcade ran."""
        total, until = 0.0, datetime.min
        for one in self.sessions:
            total += max(0.0, (one.end - max(one.begin, until)).total_seconds())
            until = max(until, one.end)
        return total

    @property
    def people(self) -> int:
        """Seats taken by people in all matches."""
        return sum(match.people for match in self.matches)

    def as_json(self) -> dict[str, Any]:
        """Plain values for JSON."""
        return {
            "day": self.day.isoformat(),
            "matches": len(self.matches),
            "left": self.left,
            "games": self.games,
            "hours": {str(hour): games for hour, games in self.hours.items()},
            "mean_seconds": round(self.mean_seconds, 1),
            "busiest_hour": self.busiest_hour,
            "people": self.people,
            "real": sum(match.robots == "real" for match in self.matches),
            "starts": self.starts,
            "crashes": self.crashes,
            "failures": self.failures,
            "arcades_at_once": self.at_once,
            "open_seconds": round(self.open_seconds),
            "batteries": {
                str(robot): {"last": figures.last, "lowest": figures.lowest}
                for robot, figures in self.batteries.items()
            },
            "skipped_lines": self.skipped,
        }


def report_of(data: Path, day: date) -> DayReport:
    """The figures of a day. Raises OSError."""
    records, skipped = read_day(data, day)
    unfinished = {record.arcade for record in records if record.arcade} - _ended(records)
    return figures(
        day, records, skipped, {name for name in unfinished if runs(data, name)} | _later(data, day, unfinished)
    )


def figures(day: date, records: Sequence[Record], skipped: int = 0, going_on: Collection[str] = ()) -> DayReport:
    """The figures of the records of a day. `going_on`: the arcades that still run, or ran on a later day."""
    played = [record for record in records if isinstance(record, PlayedMatch)]
    program = [record for record in records if isinstance(record, ProgramEvent)]
    readings: dict[int, list[float]] = {}
    for record in records:
        if isinstance(record, Battery):
            readings.setdefault(record.robot, []).append(record.volts)
    sessions = [*_sessions(day, records, going_on), *_nameless([event for event in program if not event.arcade])]
    return DayReport(
        day=day,
        matches=tuple(sorted((match for match in played if match.complete), key=lambda match: match.at)),
        left=sum(not match.complete for match in played),
        starts=sum(event.what == "start" for event in program),
        crashes=sum(one.crashed for one in sessions),
        failures=sum(event.what == "failure" for event in program),
        sessions=tuple(sorted(sessions, key=lambda one: one.begin)),
        batteries={robot: BatteryFigures(volts[-1], min(volts)) for robot, volts in sorted(readings.items())},
        skipped=skipped,
    )


def _sessions(day: date, records: Sequence[Record], going_on: Collection[str]) -> list[ArcadeSession]:
    """The sessions of arcades with names."""
    found: dict[str, list[Record]] = {}
    for record in records:
        if record.arcade:
            found.setdefault(record.arcade, []).append(record)
    ended, last = _ended(records), min(now(), datetime.combine(day, time.max).replace(microsecond=0))
    sessions = []
    for name, own in found.items():
        ends = [last] if name in going_on else [record.at + _length(record) for record in own]
        sessions.append(
            ArcadeSession(min(record.at for record in own), max(ends), name not in ended and name not in going_on)
        )
    return sessions


def _length(record: Record) -> timedelta:
    return timedelta(seconds=record.seconds if isinstance(record, PlayedMatch) else 0.0)


def _ended(records: Sequence[Record]) -> set[str]:
    return {record.arcade for record in records if isinstance(record, ProgramEvent) and record.what == "end"}


def _later(data: Path, day: date, arcades: Collection[str]) -> set[str]:
    """Those of the arcades that have records on a later day."""
    found: set[str] = set()
    for other in days(data):
        if other > day and arcades:
            found |= {record.arcade for record in read_day(data, other)[0]} & {*arcades}
    return found


def _nameless(program: Sequence[ProgramEvent]) -> list[ArcadeSession]:
    """The sessions of arcades without names: an end is that of the latest start. The last start may still run."""
    sessions, begun = [], list[datetime]()
    for event in program:
        if event.what == "start":
            begun.append(event.at)
        elif event.what == "end" and begun:
            sessions.append(ArcadeSession(begun.pop(), event.at, False))
    bounds = [event.what for event in program if event.what != "failure"]
    running = begun.pop() if bounds[-1:] == ["start"] else None
    sessions += [ArcadeSession(begin, begin, True) for begin in begun]
    return sessions if running is None else [*sessions, ArcadeSession(running, running, False)]


def to_csv(report: DayReport) -> str:
    """The matches of a day as CSV, a line each."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\r\n")
    writer.writerow(COLUMNS)
    for match in report.matches:
        row = (match.game, round(match.seconds, 1), match.people, match.ais, match.robots)
        writer.writerow([match.at.isoformat(" ", "seconds"), *row])
    return out.getvalue()
