"""A driver as a plug-in: found, switched on, on offer beside the arcade's own, checked, and left out with one line."""

import json
import shutil
from pathlib import Path

import pytest

from pigaming_app.storage.plugins import found
from pigaming_app.storage.plugins.consent import switch
from pigaming_app.storage.plugins.found import user_folder
from pigaming_app.storage.settings import Settings, folders
from tests.plugins.packages import changed
from tests.processes import ROOT, program


@pytest.fixture
def lines(home: Path) -> Path:
    """The example driver, switched on."""
    folder = user_folder() / "lines"
    shutil.copytree(ROOT / "examples" / "lines", folder, ignore=shutil.ignore_patterns("__pycache__"))
    switch("lines", True)
    return folder


def test_a_driver_is_found_and_is_no_game(lines: Path) -> None:
    plugins = {plugin.name: plugin for plugin in found.found()}
    assert plugins["lines"].drives
    assert not plugins["football"].drives
    ended = program("play", "lines", "--headless")
    assert ended.returncode == 2
    assert "lines" in ended.stderr
    assert "lines: on, a driver, in" in program("games").stdout


def test_its_promises_are_checked(lines: Path) -> None:
    ended = program("robots", "check", "lines", "--json")
    assert (ended.returncode, ended.stderr) == (0, "")
    assert json.loads(ended.stdout)["for_matches"] is True


def test_it_is_a_radio_mode(lines: Path) -> None:
    ended = program("robots", "--radio", "lines", "--port", "/dev/nowhere", "--json")
    assert "/dev/nowhere" in json.loads(ended.stdout)["radio"]
    assert Settings.load(folders().config)[0].radio == "lines"


@pytest.mark.parametrize("silence", ["None", "0.31"])
def test_robots_that_stop_too_late_play_no_match(lines: Path, silence: str) -> None:
    changed(lines / "driver.py", "silence=SILENCE", f"silence={silence}")
    ended = program("play", "pitanks", "--real", "1", "--radio", "lines")
    assert ended.returncode == 2
    assert ended.stderr.startswith("PiGaming: --radio: Robots of radio mode Lines of text ")
    ended = program("robots", "check", "lines")
    assert ended.returncode == 1
    assert "Robots of radio mode Lines of text" in ended.stdout


LATE = "if self._now - self._driven[robot] >= SILENCE or"


def test_a_word_that_its_emulated_robots_do_not_keep_plays_no_match(lines: Path) -> None:
    """Nor is such a radio mode kept in the settings."""
    changed(lines / "driver.py", LATE, LATE.replace("SILENCE", "0.5"))
    ended = program("play", "pitanks", "--real", "1", "--radio", "lines")
    assert ended.returncode == 2
    assert "their emulation does not stop by itself in time: robots check lines" in ended.stderr.splitlines()[-1]
    program("robots", "--radio", "lines", "--port", "/dev/nowhere", "--json")
    assert Settings.load(folders().config)[0].radio == Settings().radio


def test_an_error_of_its_emulated_robots_is_one_line(lines: Path) -> None:
    line = changed(lines / "driver.py", "self._now += STEP", "self._now += 'a'")
    ended = program("robots", "check", "lines")
    assert ended.returncode == 2
    start = f"PiGaming: robots check lines: its emulated robots failed: driver.py, line {line}: TypeError: "
    assert ended.stderr.splitlines()[-1].startswith(start)


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ('name="lines"', 'name="dots"', "its driver is named dots"),
        ("DRIVER = RobotDriver(", "DRIVER = dict(", "DRIVER is no RobotDriver"),
        ("BAUD, ROBOTS =", "BAUD ROBOTS =", "driver.py, line "),
        ("silence=SILENCE", 'silence="0.2"', "driver.py, line "),
    ],
)
def test_a_faulty_one_is_left_out_in_one_line(lines: Path, old: str, new: str, reason: str) -> None:
    changed(lines / "driver.py", old, new)
    ended = program("robots", "check", "lines")
    assert ended.returncode == 2
    assert "Traceback" not in ended.stderr
    assert f"The driver lines in {lines} is left out: {reason}" in ended.stderr
    assert "no driver 'lines'" in ended.stderr


def test_a_mat_whose_driver_is_gone_says_so(lines: Path) -> None:
    Settings(radio="lines").save(folders().config)
    switch("lines", False)
    ended = program("play", "pitanks", "--real", "1")
    assert ended.returncode == 2
    assert "The driver lines is not installed" in ended.stderr
