"""Figures of a day of the arcade: matches per hour and game, mean length, busiest hour, crashes, batteries."""

import argparse
import json
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from pigaming_app.jobs.terminal.options import JsonOption, option, path
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.scenes.kiosk.day_report import DayReport, report_of, to_csv
from pigaming_app.storage.parsing import describe_error, quote
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.settings import folders


def _day(text: str) -> date:
    """A date such as 2026-11-23."""
    try:
        return date.fromisoformat(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{quote(text)} is not a date such as 2026-11-23") from None


@dataclass(frozen=True, kw_only=True)
class ReportOptions(JsonOption):
    """The day, and a file for its matches."""

    day: date | None = option("default: today", _day, metavar="YYYY-MM-DD")
    csv: Path | None = option("write the matches of the day, a line each", path, metavar="FILE")


def run(options: ReportOptions) -> int:
    """Print the figures. Raises Refusal or NotSaved."""
    wanted = options.day or date.today()
    try:
        report = report_of(folders().data, wanted)
    except OSError as error:
        raise Refusal(f"the log of {wanted}: cannot be read ({describe_error(error)})") from None
    if options.csv:
        write_atomic(options.csv, to_csv(report).encode())
    print(json.dumps(report.as_json()) if options.json else "\n".join(lines(report)))
    return 0


def lines(report: DayReport) -> list[str]:
    """The figures as lines of text."""
    minutes, seconds = divmod(round(report.mean_seconds), 60)
    busiest = report.busiest_hour
    out = [f"{report.day}: {len(report.matches)} matches, {report.left} left before their end"]
    if busiest is not None:
        names = list(report.games)
        out.append(f"mean length {minutes}:{seconds:02}, busiest hour {busiest}:00")
        out.append("        " + "".join(f"{name:>12}" for name in (*names, "all")))
        for hour, counts in report.hours.items():
            row = [counts.get(name, 0) for name in names]
            out.append(f"{hour:>5}:00" + "".join(f"{count:12}" for count in (*row, sum(row))))
    out.append(f"starts {report.starts}, crashes {report.crashes}, failed screens {report.failures}")
    if report.sessions:
        hours, minutes = divmod(round(report.open_seconds / 60), 60)
        out.append(f"open for {hours}:{minutes:02} h, at most {report.at_once} arcades at once")
    for robot, volts in report.batteries.items():
        out.append(f"robot {robot}: {volts.last:.1f} V, lowest {volts.lowest:.1f} V")
    if report.skipped:
        out.append(f"{report.skipped} damaged lines of the log were skipped")
    return out
