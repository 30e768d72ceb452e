"""The report of a day on the command line."""

import json
from datetime import date, datetime
from pathlib import Path

import pytest

from pigaming_app.jobs.cli import main
from pigaming_app.storage.day_log import FOLDER, Battery, DayLog, PlayedMatch, ProgramEvent


@pytest.fixture
def data(home: Path) -> Path:
    log = DayLog(home / "data")
    log.add(ProgramEvent(datetime(2025, 11, 23, 9), "start"))
    for minute in (0, 10, 20):
        log.add(PlayedMatch(datetime(2025, 11, 23, 11, minute), "factory", 90.0, 4, 0))
    log.add(Battery(datetime(2025, 11, 23, 12), 1, 4.81))
    return home / "data"


def test_it_prints_one_object(data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", "--json", "--day", "2025-11-23"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert (report["matches"], report["busiest_hour"], report["hours"]) == (3, 11, {"11": {"factory": 3}})


def test_it_prints_lines(data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", "--day", "2025-11-23"]) == 0
    out = capsys.readouterr().out
    assert "3 matches" in out
    assert "mean length 1:30, busiest hour 11:00" in out
    assert "robot 1: 4.8 V" in out


def test_today_is_empty(data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report"]) == 0
    assert f"{date.today()}: 0 matches" in capsys.readouterr().out


def test_it_writes_a_csv(data: Path, tmp_path: Path) -> None:
    file = tmp_path / "out" / "day.csv"
    assert main(["report", "--day", "2025-11-23", "--csv", str(file)]) == 0
    assert len(file.read_text().splitlines()) == 4


@pytest.mark.parametrize("day", ["yesterday", "2026-13-01", "", "\0"])
def test_a_wrong_day_is_refused_in_one_line(home: Path, capsys: pytest.CaptureFixture[str], day: str) -> None:
    assert main(["report", "--day", day]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_a_log_that_cannot_be_read_is_refused_in_one_line(data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = data / FOLDER / "2025-11-23.jsonl"
    file.unlink()
    file.mkdir()
    assert main(["report", "--day", "2025-11-23"]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_a_csv_that_cannot_be_written_is_refused_in_one_line(data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", "--day", "2025-11-23", "--csv", str(data)]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
