"""The figures of a day, from its log: matches per hour and game, mean length, busiest hour, crashes, batteries."""

import csv
import io
import itertools
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import date
from pathlib import Path
from typing import Any

from pigaming_app.events.day_log import Battery, PlayedMatch, ProgramEvent, Record, read_day

COLUMNS = ("start", "game", "seconds", "people", "ais", "robots")


@dataclass(frozen=True)
class BatteryFigures:
    """Battery of one robot, V: the last reading and the lowest."""

    last: float
    lowest: float


@dataclass(frozen=True)
class DayReport:
    """The figures of a day. Matches that were left before their end count as `left` only.

    `crashes`: starts of the arcade that no end came before the next start, as after a crash, a hang or a power cut.
    `failures`: screens that failed, after which the title returned. `skipped`: damaged lines of the log.
    """

    day: date
    matches: tuple[PlayedMatch, ...] = ()  # complete ones, by their start
    left: int = 0
    starts: int = 0
    crashes: int = 0
    failures: int = 0
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
            "batteries": {
                str(robot): {"last": figures.last, "lowest": figures.lowest}
                for robot, figures in self.batteries.items()
            },
            "skipped_lines": self.skipped,
        }


def report_of(data: Path, day: date) -> DayReport:
    """The figures of a day. Raises OSError."""
    return figures(day, *read_day(data, day))


def figures(day: date, records: Sequence[Record], skipped: int = 0) -> DayReport:
    """The figures of the records of a day."""
    played = [record for record in records if isinstance(record, PlayedMatch)]
    program = [record.what for record in records if isinstance(record, ProgramEvent)]
    readings: dict[int, list[float]] = {}
    for record in records:
        if isinstance(record, Battery):
            readings.setdefault(record.robot, []).append(record.volts)
    return DayReport(
        day=day,
        matches=tuple(sorted((match for match in played if match.complete), key=lambda match: match.at)),
        left=sum(not match.complete for match in played),
        starts=program.count("start"),
        crashes=_crashes(program),
        failures=program.count("failure"),
        batteries={robot: BatteryFigures(volts[-1], min(volts)) for robot, volts in sorted(readings.items())},
        skipped=skipped,
    )


def _crashes(program: Sequence[str]) -> int:
    """Starts that follow a start without an end between them."""
    bounds = [what for what in program if what != "failure"]
    return sum(pair == ("start", "start") for pair in itertools.pairwise(bounds))


def to_csv(report: DayReport) -> str:
    """The matches of a day as CSV, a line each."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\r\n")
    writer.writerow(COLUMNS)
    for match in report.matches:
        row = (match.game, f"{match.seconds:.1f}", match.people, match.ais, match.robots)
        writer.writerow([match.at.isoformat(" ", "seconds"), *row])
    return out.getvalue()
