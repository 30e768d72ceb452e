"""Crash reports and the list of restarts: their contents, their number, damaged files."""

import signal
from datetime import datetime, timedelta
from pathlib import Path

import pygame
import pytest

from pigaming_app import __version__
from pigaming_app.jobs.kiosk.crash_reports import FOLDER, KEPT, Evidence, crash_log_size, keep_report
from pigaming_app.jobs.kiosk.supervisor import RunEnd
from pigaming_app.storage.log import CRASH_FILE, FILE
from pigaming_app.storage.restarts import FILE as RESTARTS
from pigaming_app.storage.restarts import MAX_BYTES, Restart, append_restart, restarts

KILLED = RunEnd(-signal.SIGKILL, 61.25, 3600)
NOW = datetime(2026, 5, 9, 14, 30)


def test_a_report_holds_versions_the_last_lines_the_new_stacks_and_the_screen(tmp_path: Path) -> None:
    (tmp_path / CRASH_FILE).write_text("stacks of yesterday\n")
    before = crash_log_size(tmp_path)
    with (tmp_path / CRASH_FILE).open("a") as file:
        file.write("stacks of today\n")
    (tmp_path / FILE).write_text("older\n" + "x" * 30_000 + "\nnewest\n")
    red = ((2, 1), b"\xff\0\0" * 2)
    keep_report(tmp_path, KILLED, Evidence(["Traceback\n"], red, before), NOW)
    (text,), (picture,) = (list((tmp_path / FOLDER).glob(f"*.{kind}")) for kind in ("txt", "png"))
    report = text.read_text()
    for part in (
        f"PiGaming {__version__}",
        "ended by SIGKILL",
        "61.2 s",
        "3600 frames",
        "numpy",
        "Traceback",
        "newest",
    ):
        assert part in report
    assert "stacks of today" in report
    assert "stacks of yesterday" not in report
    assert "older" not in report
    shown = pygame.image.load(picture)
    assert (shown.get_size(), shown.get_at((1, 0))[:3]) == ((2, 1), (255, 0, 0))
    (restart,) = restarts(tmp_path)
    assert (restart.reason, restart.detail, restart.seconds) == ("crash", "ended by SIGKILL", 61.2)
    assert (tmp_path / restart.report) == text
    assert restart.time.startswith("2026-05-09T14:30:00")


def test_twenty_reports_are_kept_with_their_pictures(tmp_path: Path) -> None:
    for second in range(KEPT + 3):
        picture = None if second % 2 else ((1, 1), b"\0\0\0")
        keep_report(tmp_path, KILLED, Evidence((), picture, 0), NOW + timedelta(milliseconds=second))
    texts, pictures = (sorted((tmp_path / FOLDER).glob(f"*.{kind}")) for kind in ("txt", "png"))
    assert len(texts) == KEPT
    assert texts[0].stem.endswith("-003")
    assert {path.stem for path in pictures} < {path.stem for path in texts}
    assert len(restarts(tmp_path)) == KEPT + 3


def test_a_hang_is_described() -> None:
    assert (RunEnd(None, 9.0, 1, 5.2).reason, RunEnd(None, 9.0, 1, 5.2).detail) == ("hang", "no frame for 5 s")
    assert RunEnd(3, 1.0, 1).detail == "exit code 3"
    assert RunEnd(-250, 1.0, 1).detail == "ended by signal 250"


def test_damaged_lines_are_left_out_and_a_torn_one_spoils_no_other(tmp_path: Path) -> None:
    assert restarts(tmp_path) == []
    one = Restart("2026-05-09T14:30:00+01:00", "hang", "no frame for 5 s", 12.5, "crashes/a.txt")
    append_restart(tmp_path, one)
    with (tmp_path / RESTARTS).open("ab") as file:
        file.write(b'[1]\n{"time": 3}\nnull\n{"time": "2026-05-')
    append_restart(tmp_path, one)
    assert restarts(tmp_path) == [one, one]


def test_a_long_list_loses_its_older_half(tmp_path: Path) -> None:
    line = Restart("2026-05-09T14:30:00+01:00", "crash", "x" * 50_000)
    for _ in range(11):
        append_restart(tmp_path, line)
    assert len(restarts(tmp_path)) in range(3, 9)
    assert (tmp_path / RESTARTS).stat().st_size < MAX_BYTES + 60_000


def test_a_folder_in_its_place_is_an_error(tmp_path: Path) -> None:
    (tmp_path / RESTARTS).mkdir()
    with pytest.raises(OSError, match="not a file"):
        append_restart(tmp_path, Restart("", "crash"))
