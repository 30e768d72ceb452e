"""Programs from the command line: their keys, and the two examples in matches without a window."""

import json
import os
import shutil
import stat
import subprocess
import sys
from pathlib import Path
from subprocess import PIPE

import pytest

ROOT = Path(__file__).resolve().parents[3]
URL = "ws://127.0.0.1:8789/"


def bots(home: Path, *words: str) -> subprocess.CompletedProcess[str]:
    return main(home, "bots", *words)


def main(home: Path, *words: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "pigaming_app", *words]
    environment = {**os.environ, "PIGAMING_HOME": str(home)}
    return subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False, timeout=300)


def test_a_bot_is_added_gets_a_new_key_and_is_removed(tmp_path: Path) -> None:
    first = json.loads(bots(tmp_path, "--add", "ada", "--json").stdout)["keys"]["ada"]
    second = json.loads(bots(tmp_path, "--add", "ada", "--json").stdout)["keys"]["ada"]
    assert first != second
    assert len(bytes.fromhex(second)) == 16
    file = tmp_path / "config" / "bots.json"
    if os.name != "nt":
        assert stat.S_IMODE(file.stat().st_mode) == 0o600
    assert f"bot:ada          key {second}" in bots(tmp_path).stdout
    assert "no bots" in bots(tmp_path, "--remove", "ada").stdout


@pytest.mark.parametrize("words", [("--add", "A b"), ("--add", ""), ("--add", "x" * 13), ("--remove", "eve")])
def test_a_wrong_name_is_refused_in_one_line(tmp_path: Path, words: tuple[str, str]) -> None:
    done = bots(tmp_path, *words)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1


def test_a_damaged_book_has_no_bots_and_a_bot_that_is_unknown_is_no_brain(tmp_path: Path) -> None:
    (tmp_path / "config").mkdir()
    (tmp_path / "config" / "bots.json").write_text("{")
    assert json.loads(bots(tmp_path, "--json").stdout) == {"keys": {}}
    assert "cannot be read" in bots(tmp_path, "--add", "ada").stderr
    done = main(tmp_path, "duel", "pitanks", "bot:ada", "level1", "--matches", "2")
    assert done.returncode == 2
    assert "no brain 'bot:ada'" in done.stderr


@pytest.mark.long
def test_the_examples_play_duels_as_their_page_prints_it(tmp_path: Path) -> None:
    """One after the other: the port is the same."""
    for program in ("hunter.py", "hunter.mjs"):
        plays_a_duel(tmp_path, program)


def plays_a_duel(tmp_path: Path, program: str) -> None:
    key = json.loads(bots(tmp_path, "--add", "ada", "--json").stdout)["keys"]["ada"]
    file, runs, environment = ROOT / "examples" / "bots" / program, [sys.executable], dict(os.environ)
    if program.endswith(".mjs"):
        if not shutil.which("npm"):
            pytest.skip("no npm: apt-get install nodejs npm")
        subprocess.run(["npm", "install", "--silent", "--prefix", str(tmp_path), "ws@8"], check=True, timeout=120)
        file, runs = Path(shutil.copy(file, tmp_path)), ["node"]  # beside the package
    words = ["duel", "pitanks", "bot:ada", "random", "--matches", "4", "--minutes", "1", "--json"]
    command = [sys.executable, "-m", "pigaming_app", *words]
    environment["PIGAMING_HOME"] = str(tmp_path)
    with subprocess.Popen(command, cwd=ROOT, env=environment, stdout=PIPE, stderr=PIPE, text=True) as game:
        assert game.stderr
        assert URL in game.stderr.readline()
        bot = subprocess.run([*runs, str(file), URL, "ada", key], capture_output=True, text=True, timeout=300)
        out, errors = game.communicate(timeout=60)
    assert game.returncode == 0, errors
    assert "closed with 1001" in bot.stdout, bot.stderr
    result = json.loads(out)
    assert result["wins"] == 4
    assert result["mean_score_left"] > 3
