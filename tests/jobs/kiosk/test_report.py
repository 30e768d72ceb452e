"""The report of a day on the command line."""

import json
from collections.abc import Callable
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


def test_it_prints_one_object_or_lines(data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", "--json", "--day", "2025-11-23"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert (report["matches"], report["busiest_hour"], report["hours"]) == (3, 11, {"11": {"factory": 3}})
    assert main(["report", "--day", "2025-11-23"]) == 0
    out = capsys.readouterr().out
    for part in ("3 matches", "mean length 1:30, busiest hour 11:00", "robot 1: 4.8 V"):
        assert part in out
    assert main(["report"]) == 0
    assert f"{date.today()}: 0 matches" in capsys.readouterr().out


def test_it_writes_a_csv(data: Path, tmp_path: Path) -> None:
    file = tmp_path / "out" / "day.csv"
    assert main(["report", "--day", "2025-11-23", "--csv", str(file)]) == 0
    assert len(file.read_text().splitlines()) == 4


@pytest.mark.parametrize("day", ["yesterday", "2026-13-01", "", "\0"])
def test_a_wrong_day_is_refused_in_one_line(refused: Callable[..., str], day: str) -> None:
    refused("report", "--day", day)


def test_files_that_cannot_be_read_or_written_are_refused_in_one_line(data: Path, refused: Callable[..., str]) -> None:
    refused("report", "--day", "2025-11-23", "--csv", str(data))
    file = data / FOLDER / "2025-11-23.jsonl"
    file.unlink()
    file.mkdir()
    refused("report", "--day", "2025-11-23")
