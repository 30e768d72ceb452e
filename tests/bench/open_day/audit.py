"""A ledger compared with what the arcade has kept: day log, report, events, high scores, logs, crash reports."""

import json
import statistics
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from datetime import date
from pathlib import Path
from typing import Any

from pigaming_app.events import event_files
from pigaming_app.events.event import Event
from pigaming_app.events.journal import Recorded
from pigaming_app.jobs.kiosk.crash_reports import FOLDER as CRASHES
from pigaming_app.storage.day_log import PlayedMatch, read_day
from pigaming_app.storage.log import CRASH_FILE
from pigaming_app.storage.log import FILE as LOG
from pigaming_app.storage.restarts import restarts
from pigaming_app.storage.scores import FILE as SCORES
from pigaming_app.storage.scores import LENGTH
from pigaming_app.storage.scores.book import parse as parse_scores
from tests.bench.open_day.ledger import Ledger, SeenMatch
from tests.bench.open_day.plan import Day

FLAT_MB = 20.0
SHARE = 2  # times the fair share of matches that a phone waits at most
FULL = ("No space left on device", "the disk is full")  # one is in each line that a log may have then
WARM, TAIL = 1800.0, 1800.0  # s: of a run, after which its memory is read first, and last
SAMPLES = 3  # readings at least in each of both


def of_day(day: Day, ledger: Ledger, data: Path, report: Mapping[str, Any]) -> Iterator[str]:
    """Everything of a day that is not as it has to be."""
    log = played(data, day.times.wall(0.0).date())
    yield from ledger.troubles
    yield from matches_counted_once(ledger, log)
    yield from report_agrees(ledger, log, report, len(day.kills))
    yield from flat(ledger, day.seconds)
    yield from fair(ledger)


def of_files(days: Sequence[Day], ledger: Ledger, data: Path) -> Iterator[str]:
    """What is not as it has to be in the files of an arcade after all its days, of which the ledger is the sum."""
    yield from scores_counted_once(ledger, data)
    yield from clean(data, sum(day.crashes for day in days), any(day.full < day.seconds for day in days))


def played(data: Path, day: date) -> list[PlayedMatch]:
    """All matches of the day log. A damaged line is a problem of the report."""
    records, _ = read_day(data, day)
    return [record for record in records if isinstance(record, PlayedMatch)]


def fair(ledger: Ledger) -> Iterator[str]:
    """Phones that waited for more than twice their share of matches."""
    for wait in ledger.waits:
        if wait.matches > SHARE * wait.fair:
            yield f"visitor {wait.visitor} waited for match {wait.matches}, a fair share is {wait.fair}"


def matches_counted_once(ledger: Ledger, log: Sequence[PlayedMatch]) -> Iterator[str]:
    """Complete matches of the day log against those seen."""
    logged = Counter(key_of(match) for match in log if match.complete)
    must, may = (Counter(match.key for match in matches) for matches in (ledger.settled, ledger.open))
    for key in must - logged:
        yield f"not in the day log: {key}"
    for key in logged - (must + may):
        yield f"in the day log, but never seen, or twice: {key}"


def key_of(match: PlayedMatch) -> tuple[str, str, float, int, int]:
    return match.game, match.at.isoformat(timespec="seconds"), match.seconds, match.people, match.ais


def report_agrees(ledger: Ledger, log: Sequence[PlayedMatch], report: Mapping[str, Any], kills: int) -> Iterator[str]:
    """`main.py report --json` against the ledger and the day log."""
    must, may = len(ledger.settled), len(ledger.open)
    if not must <= report["matches"] <= must + may:
        yield f"the report has {report['matches']} matches; seen were {must}, and {may} at a kill"
    if not ledger.left <= report["left"] <= ledger.left + ledger.playing:
        yield f"the report has {report['left']} left matches; seen were {ledger.left}"
    complete = [match for match in log if match.complete]
    hours = Counter(match.at.hour for match in complete)
    if {hour: sum(games.values()) for hour, games in report["hours"].items()} != {str(h): n for h, n in hours.items()}:
        yield f"the hours of the report, {report['hours']}, are not those of the day log, {dict(hours)}"
    seen = Counter(int(match.began[11:13]) for match in ledger.settled)
    busiest = [hour for hour, count in seen.items() if count >= max(seen.values()) - may]
    if seen and report["busiest_hour"] not in busiest:
        yield f"the busiest hour of the report is {report['busiest_hour']}, seen: {dict(seen)}"
    if report["people"] != sum(match.people for match in complete):
        yield "the people of the report are not those of the day log"
    wanted = {"starts": kills + 1, "crashes": kills, "failures": 0, "skipped_lines": 0}
    for name, value in wanted.items():
        if report[name] != value:
            yield f"the report has {report[name]} {name}, not {value}"


def results_of_events(ledger: Ledger, data: Path) -> Iterator[str]:
    """Each match of people in a finished event has one result in the journal, the one that was seen."""
    for path in {*ledger.events.values()}:
        event, damage = event_files.load(Path(path))
        yield from damage
        if event is None or not event.over:
            yield f"{Path(path).name}: not over"
        if event:
            seen = [match for match in ledger.matches if match.event == path]
            yield from (f"{Path(path).name}, {problem}" for problem in journal_agrees(event, seen))
    found = {str(path) for path in (data / event_files.FOLDER).glob("*.json")}
    for path in found ^ set(ledger.events.values()):
        yield f"{Path(path).name}: an event that was never seen, or is lost"


def journal_agrees(event: Event, seen: Sequence[SeenMatch]) -> Iterator[str]:
    """The results in the journal against those on the screen. Matches of AIs alone may be played in the background."""
    results = [entry.outcome for entry in event.journal if isinstance(entry, Recorded)]
    for key, count in Counter((outcome.fixture, outcome.extra) for outcome in results).items():
        if count > 1:
            yield f"match {_named(*key)}: {count} results"
    by_key = {(outcome.fixture, outcome.extra): outcome for outcome in results}
    for key in {match.fixture_key for match in seen}:
        here = [match for match in seen if match.fixture_key == key]
        settled = [match for match in here if match.settled]
        if len(settled) > 1:
            yield f"match {_named(*key)}: was on the screen {len(settled)} times"
        if key not in by_key:
            if settled:
                yield f"match {_named(*key)}: its result is lost"
        elif dict(by_key[key].scores) not in [dict(match.scores) for match in settled or here]:
            yield f"match {_named(*key)}: {dict(by_key[key].scores)} is not what was seen"
    ais = {entrant.name for entrant in event.entrants if entrant.brain}
    for key, outcome in by_key.items():
        people = {name for place in outcome.places for name in place} - ais
        if people and not outcome.note and key not in {match.fixture_key for match in seen}:
            yield f"match {_named(*key)}: a result that nobody has seen"


def _named(number: int, extra: int) -> str:
    return f"{number}, extra match {extra}" if extra else str(number)


def scores_counted_once(ledger: Ledger, data: Path) -> Iterator[str]:
    """The rows of the high scores against those entered; only rows beyond the tenth may be missing."""
    path = data / SCORES
    content, faults = parse_scores(path.read_text(encoding="utf-8")) if path.exists() else (None, None)
    if faults and faults.count:
        yield f"{faults.count} damaged rows of the high scores"
    tables = content.tables if content else {}
    kept = Counter(
        (table_key(asdict(table)), row.score, row.initials) for table, rows in tables.items() for row in rows
    )
    must, may = Counter(ledger.rows), Counter(ledger.entries)
    for key in (kept - must).elements():
        if not may[key[:2]]:
            yield f"in the high scores, but never entered, or twice: {key}"
        may[key[:2]] -= 1
    timed = {table_key(asdict(table)): table.timed for table in tables}
    for key in (must - kept).elements():
        table, value, _ = key
        better = [row for row in kept.elements() if row[0] == table and beats(row[1], value, timed[table])]
        if len(better) < LENGTH:
            yield f"not in the high scores: {key}"


def beats(value: int, other: int, timed: bool) -> bool:
    """True if a value is as good as another, or better."""
    return value <= other if timed else value >= other


def table_key(table: Mapping[str, Any]) -> str:
    """A table as one text; lengths are floats, as in the file."""
    return json.dumps({**table, "length": float(table["length"])}, sort_keys=True)


def clean(data: Path, kills: int, full: bool = False) -> Iterator[str]:
    """Logs without warnings and stacks, but for a full disk; a crash report for each kill, and none besides."""
    for path in sorted(data.glob(f"{LOG}*")):
        for line in path.read_text(encoding="utf-8").splitlines():
            if not (full and any(text in line for text in FULL)):
                yield f"{path.name}: {line}"
    stacks = data / CRASH_FILE
    if stacks.exists() and stacks.stat().st_size:
        yield f"{CRASH_FILE}: {stacks.read_text(encoding='utf-8')[:2000]}"
    found = [(one.reason, one.detail) for one in restarts(data)]
    if found != [("crash", "ended by SIGKILL")] * kills:
        yield f"restarts: {found}"
    reports = list((data / CRASHES).glob("*.txt"))
    if len(reports) != kills:
        yield f"{len(reports)} crash reports"
    for path in sorted(data.rglob("*.broken-*")):
        yield f"{path.name}: was set aside"


def memory_of_runs(ledger: Ledger) -> list[dict[str, float]]:
    """MB of each run that was long enough, after its warm-up and at its end."""
    found = []
    for life in sorted({one.life for one in ledger.memory}):
        readings = [one for one in ledger.memory if one.life == life]
        begin, end, games = readings[0].at, readings[-1].at, readings[-1].games
        shown = [one for one in readings if one.games == games]  # the first match of a game loads its pictures
        warm = [one.mb for one in shown if one.at >= begin + WARM][:SAMPLES]
        last = [one.mb for one in readings if one.at >= end - TAIL][-SAMPLES:]
        if end - begin >= WARM + TAIL and len(warm) == len(last) == SAMPLES:
            first, final = statistics.median(warm), statistics.median(last)
            hours = (end - begin) / 3600.0
            most = max(one.mb for one in readings)
            found.append({"hours": round(hours, 2), "warm_mb": first, "end_mb": final, "most_mb": most})
    return found


def flat(ledger: Ledger, seconds: float) -> Iterator[str]:
    """Memory that grows or shrinks; a day of several hours must have a run that is long enough."""
    runs = memory_of_runs(ledger)
    for run in runs:
        if abs(run["end_mb"] - run["warm_mb"]) > FLAT_MB:
            yield f"memory from {run['warm_mb']} to {run['end_mb']} MB in {run['hours']} h"
    if not runs and seconds >= 4 * (WARM + TAIL):
        yield "no run was long enough to compare its memory"
