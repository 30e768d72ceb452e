"""The day log keeps every record through kills and damage; its figures are counted by hand here."""

import os
import signal
import subprocess
import sys
from datetime import date, datetime, timedelta
from pathlib import Path

import pytest
from msgspec.structs import replace

from pigaming_app.scenes.kiosk.day_report import figures, report_of, to_csv
from pigaming_app.storage.day_log import (
    FOLDER,
    KEPT_DAYS,
    MAX_BYTES,
    Battery,
    DamagedLine,
    DayLog,
    PlayedMatch,
    ProgramEvent,
    Record,
    days,
    now,
    parse_line,
    read_day,
    to_line,
)
from tests.processes import python

DAY = date(2026, 11, 23)


def at(hour: int, minute: int = 0) -> datetime:
    return datetime(2026, 11, 23, hour, minute)


MATCH = PlayedMatch(at(14, 3), "pitanks", 180.0, 2, 2, "emulated")
RECORDS: list[Record] = [ProgramEvent(at(9), "start"), MATCH, Battery(at(14, 6), 3, 4.62), ProgramEvent(at(18), "end")]


def test_records_come_back_as_they_were_added(tmp_path: Path) -> None:
    log = DayLog(tmp_path)
    for record in RECORDS:
        log.add(record)
    assert read_day(tmp_path, DAY) == ([replace(record, arcade=log.arcade) for record in RECORDS], 0)
    assert read_day(tmp_path, date(2026, 11, 24)) == ([], 0)
    assert days(tmp_path) == [DAY]


def test_without_a_folder_nothing_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    DayLog().add(MATCH)
    DayLog().delete_old(DAY)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "line",
    [
        "",
        "{",
        "[]",
        "null",
        "\0\0\0",
        '{"kind":"program","what":"start"}',
        '{"kind":"program","what":"start","at":"noon"}',
        '{"kind":"program","what":"start","at":"2026-11-23T09:00:00+01:00"}',
        '{"kind":"program","what":"boom","at":"2026-11-23T09:00:00"}',
        to_line(MATCH).replace("180.0", "-1"),
        to_line(MATCH).replace("180.0", "NaN"),
        to_line(MATCH).replace("180.0", "1e400"),
        to_line(MATCH).replace('"people": 2', '"people": true'),
        to_line(MATCH).replace('"people": 2', '"people": 5'),
        to_line(MATCH).replace("emulated", "imagined"),
        to_line(MATCH).replace('"pitanks"', '"=cmd()"'),
        to_line(MATCH).replace('"complete": true', '"complete": 1'),
        to_line(RECORDS[2]).replace('"robot": 3', '"robot": 5'),
        to_line(MATCH)[:-9],
        to_line(MATCH) + " " * 1000,
        "[" * 200,
    ],
)
def test_a_damaged_line_is_skipped_and_counted(tmp_path: Path, line: str) -> None:
    with pytest.raises(DamagedLine):
        parse_line(line)
    log = DayLog(tmp_path)
    log.add(MATCH)
    with (tmp_path / FOLDER / "2026-11-23.jsonl").open("ab") as file:
        file.write(line.encode() + b"\n\xff\xfe\n")
    log.add(MATCH)
    records, skipped = read_day(tmp_path, DAY)
    assert records == [replace(MATCH, arcade=log.arcade)] * 2
    assert skipped == (2 if line.strip() else 1)


def test_a_line_torn_by_a_power_cut_costs_only_itself(tmp_path: Path) -> None:
    log = DayLog(tmp_path)
    log.add(MATCH)
    file = tmp_path / FOLDER / "2026-11-23.jsonl"
    file.write_bytes(file.read_bytes() + to_line(MATCH).encode()[:40])
    log.add(RECORDS[2])
    records, skipped = read_day(tmp_path, DAY)
    assert ([replace(record, arcade="") for record in records], skipped) == ([MATCH, RECORDS[2]], 1)


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no SIGKILL here")
def test_a_killed_process_loses_no_line(tmp_path: Path) -> None:
    code = (
        "import os, signal, sys\nfrom pathlib import Path\nfrom datetime import datetime\n"
        "from pigaming_app.storage.day_log import DayLog, PlayedMatch\n"
        "log = DayLog(Path(sys.argv[1]))\n"
        "for i in range(7): log.add(PlayedMatch(datetime(2026, 11, 23, 10, i), 'race', 60.0, 1, 3))\n"
        "os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    assert python(code, str(tmp_path)).returncode == -signal.SIGKILL
    assert len(report_of(tmp_path, DAY).matches) == 7


def test_old_days_are_deleted_and_nothing_else(tmp_path: Path) -> None:
    log, today = DayLog(tmp_path), DAY
    kept, old = today - timedelta(days=KEPT_DAYS), today - timedelta(days=KEPT_DAYS + 1)
    for day in (old, kept, today):
        log.add(ProgramEvent(datetime(day.year, day.month, day.day, 9), "start"))
    (tmp_path / FOLDER / "notes.txt").write_text("mine")
    log.delete_old(today)
    assert days(tmp_path) == [kept, today]
    assert (tmp_path / FOLDER / "notes.txt").exists()


def test_a_log_that_cannot_be_written_is_no_failure(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / FOLDER).write_text("in the way")
    log = DayLog(tmp_path)
    log.add(MATCH)
    log.add(MATCH)
    assert len([line for line in caplog.messages if "day log" in line]) == 1


@pytest.mark.parametrize("fits", [0, 40])
def test_lines_wait_until_a_full_disk_has_room_again(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, fits: int
) -> None:
    """The kernel refuses to write more, after some bytes of the line or before any."""
    resource = pytest.importorskip("resource", reason="limits of POSIX")
    log, file = DayLog(tmp_path), tmp_path / FOLDER / "2026-11-23.jsonl"
    log.add(RECORDS[0])
    before, limits = file.stat().st_size, resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (before + fits, limits[1]))
    try:
        log.add(RECORDS[1])
        log.add(RECORDS[2])
        full = file.stat().st_size
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    log.add(RECORDS[3])
    assert full == before
    records, skipped = read_day(tmp_path, DAY)
    assert (sorted(records, key=lambda one: one.at), skipped) == (
        [replace(record, arcade=log.arcade) for record in RECORDS],
        0,
    )
    assert len([line for line in caplog.messages if "day log" in line]) == 1


def test_a_full_file_takes_no_more(tmp_path: Path) -> None:
    file = tmp_path / FOLDER / "2026-11-23.jsonl"
    file.parent.mkdir()
    file.write_bytes(b"\n" * (MAX_BYTES + 1))
    DayLog(tmp_path).add(MATCH)
    assert os.path.getsize(file) == MAX_BYTES + 1
    assert read_day(tmp_path, DAY) == ([], 0)


def played(hour: int, game: str = "pitanks", seconds: float = 60.0, complete: bool = True) -> PlayedMatch:
    return PlayedMatch(at(hour, 10), game, seconds, 2, 1, "simulated", complete)


def test_the_figures_of_a_day() -> None:
    records: list[Record] = [
        ProgramEvent(at(9), "start"),
        played(10),
        played(14, "race", 120.0),
        played(14, "race", 180.0),
        played(14, seconds=5.0, complete=False),
        Battery(at(14, 20), 2, 4.9),
        ProgramEvent(at(14, 30), "failure"),
        ProgramEvent(at(15), "start"),  # after a crash: no end before
        played(15),
        Battery(at(15, 20), 2, 4.5),
        Battery(at(15, 40), 2, 4.7),
        ProgramEvent(at(18), "end"),
        ProgramEvent(at(18, 5), "start"),
    ]
    report = figures(DAY, records, 3)
    assert report.as_json() == {
        "day": "2026-11-23",
        "matches": 4,
        "left": 1,
        "games": {"pitanks": 2, "race": 2},
        "hours": {"10": {"pitanks": 1}, "14": {"race": 2}, "15": {"pitanks": 1}},
        "mean_seconds": 105.0,  # (60 + 120 + 180 + 60) / 4
        "busiest_hour": 14,
        "people": 8,
        "real": 0,
        "starts": 3,
        "crashes": 1,
        "failures": 1,
        "arcades_at_once": 1,
        "open_seconds": 10_800,
        "batteries": {"2": {"last": 4.7, "lowest": 4.5}},
        "skipped_lines": 3,
    }


A, B, C = "a1", "b2", "c3"


def test_arcades_that_overlap_are_no_crashes() -> None:
    records: list[Record] = [
        ProgramEvent(at(9), "start", A),
        ProgramEvent(at(10), "start", B),
        replace(played(10), arcade=A),
        ProgramEvent(at(11), "start", C),
        ProgramEvent(at(12), "end", A),
        ProgramEvent(at(13), "end", C),
        ProgramEvent(at(15), "end", B),
        ProgramEvent(at(16), "start", A + "0"),
        ProgramEvent(at(17), "end", A + "0"),
    ]
    report = figures(DAY, records)
    assert (report.starts, report.crashes, report.at_once, report.open_seconds) == (4, 0, 3, 7 * 3600.0)
    nameless = figures(DAY, [replace(record, arcade="") for record in records])
    assert (nameless.starts, nameless.crashes, nameless.at_once, nameless.open_seconds) == (4, 0, 3, 7 * 3600.0)
    assert report.as_json() == nameless.as_json()


def test_the_crash_of_one_of_two_is_counted_once_and_with_its_last_record() -> None:
    records: list[Record] = [
        ProgramEvent(at(9), "start", A),
        ProgramEvent(at(9, 30), "start", B),
        replace(played(11, seconds=600.0), arcade=A),
        ProgramEvent(at(14), "end", B),
        ProgramEvent(at(15), "start", C),
    ]
    report = figures(DAY, records, going_on={C})
    assert report.crashes == 1
    assert [(one.end, one.crashed) for one in report.sessions[:2]] == [(at(11, 20), True), (at(14), False)]


def test_what_runs_or_ends_on_another_day_has_not_crashed(tmp_path: Path) -> None:
    log, other, lost = DayLog(tmp_path), DayLog(tmp_path), DayLog(tmp_path)
    for one in (log, other, lost):
        one.add(ProgramEvent(at(22), "start"))
    other.add(ProgramEvent(at(22) + timedelta(days=2), "end"))
    assert report_of(tmp_path, DAY).crashes == 2
    log.note("start")
    assert report_of(tmp_path, DAY).crashes == 1
    log.note("end")
    assert report_of(tmp_path, DAY).crashes == 1, "it ended later"
    assert report_of(tmp_path, DAY + timedelta(days=2)).crashes == 0


def test_of_two_real_processes_the_killed_one_has_crashed(tmp_path: Path) -> None:
    code = (
        "import sys\nfrom pathlib import Path\nfrom pigaming_app.storage.day_log import DayLog\n"
        "log = DayLog(Path(sys.argv[1]))\nlog.note('start')\nprint(flush=True)\ninput()\nlog.note('end')\n"
    )
    command = [sys.executable, "-c", code, str(tmp_path)]
    first, second = (subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) for _ in range(2))
    for process in (first, second):
        assert process.stdout
        process.stdout.readline()
    today = now().date()
    report = report_of(tmp_path, today)
    assert (report.starts, report.crashes, report.at_once) == (2, 0, 2)
    first.kill()
    first.communicate(timeout=60)
    assert report_of(tmp_path, today).crashes == 1
    second.communicate(b"\n", 60)
    assert report_of(tmp_path, today).crashes == 1
    DayLog(tmp_path).delete_old(today)
    assert [path.name for path in (tmp_path / FOLDER).iterdir()] == [f"{today}.jsonl"]


def test_a_day_without_matches_has_figures() -> None:
    report = figures(DAY, [])
    assert (report.mean_seconds, report.busiest_hour, report.hours, report.crashes) == (0.0, None, {}, 0)


def test_the_csv_has_a_line_for_each_match() -> None:
    text = to_csv(figures(DAY, [played(10), played(9, "race", 61.25)]))
    assert text.split("\r\n") == [
        "start,game,seconds,people,ais,robots",
        "2026-11-23 09:10:00,race,61.2,2,1,simulated",
        "2026-11-23 10:10:00,pitanks,60.0,2,1,simulated",
        "",
    ]
