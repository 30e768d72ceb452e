"""The arcade without its features: each alone, and all together, in processes in which their packages are missing."""

import re
import subprocess
import sys
from itertools import cycle
from pathlib import Path

import pytest

from pigaming_app.games.registry import games
from pigaming_app.jobs.features import every_feature
from pigaming_app.scenes.features.registry import NAMES, features

ROOT = Path(__file__).resolve().parents[2]
ROOMS = {feature.name: feature.rooms for feature in every_feature()}
TILES = [*games(), "howto", "ladder", "events", "lab", "editor", "replays", "options"]
WOVEN = {"events", "phones", "kiosk", "mat"}  # offer more than a tile
NEEDED_BY = {"events": {"events", "ladder"}, "learning": {"lab"}, "brain": {"lab"}}


def without(rooms: tuple[str, ...], home: Path, *words: str) -> "subprocess.CompletedProcess[str]":
    """What a process prints that has no such rooms."""
    return subprocess.run(
        [sys.executable, "-X", "pigaming", "-W", "error", "-m", "tests.features.without", *rooms, "--", *words],
        cwd=ROOT,
        env={"PATH": "", "HOME": str(home), "PIGAMING_HOME": str(home), "PYGAME_HIDE_SUPPORT_PROMPT": "1"},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


def test_every_feature_is_there() -> None:
    assert tuple(feature.name for feature in features()) == NAMES
    assert {*ROOMS} - {*NAMES} == {"learning", "gym", "bench", "bundle", "onnx"}
    for feature in every_feature():
        places = [ROOT / "pigaming_app" / room.replace(".", "/") for room in feature.rooms]
        assert all(place.is_dir() or place.with_suffix(".py").is_file() for place in places), feature.name


CASES = [
    pytest.param(name, game, marks=() if name in WOVEN else pytest.mark.again)
    for name, game in zip(ROOMS, cycle(games()), strict=False)
]


@pytest.mark.long
@pytest.mark.parametrize(("name", "game"), CASES)
def test_the_arcade_runs_without_a_feature(name: str, game: str, tmp_path: Path) -> None:
    toured = without(ROOMS[name], tmp_path, "tour", game)
    gone = NEEDED_BY.get(name, {name})
    assert toured.stderr == ""
    assert toured.stdout.splitlines() == [f"tiles: {' '.join(tile for tile in TILES if tile not in gone)}", "done"]


def test_the_arcade_runs_without_all_of_them(tmp_path: Path) -> None:
    rooms = tuple(room for of_one in ROOMS.values() for room in of_one)
    toured = without(rooms, tmp_path, "tour", *games())
    assert toured.stderr == ""
    assert toured.stdout.splitlines() == [f"tiles: {' '.join(games())} options", "done"]


def test_jobs_of_the_core_run_and_those_of_features_are_refused(tmp_path: Path) -> None:
    rooms = tuple(room for of_one in ROOMS.values() for room in of_one)
    played = without(
        rooms, tmp_path, "play", "race", "--headless", "--minutes", "0.05", "--seats", "level3,level2,off,off"
    )
    assert (played.returncode, played.stderr) == (0, "")
    examined = without(rooms, tmp_path, "doctor")
    assert examined.stdout.splitlines()[-1] == "All is well."
    event, onnx = "event new cup.json", "play --seats a.onnx"
    for line in ("--kiosk", event, onnx, "report", "robots", "calibrate", "train ppo", "bench", "test"):
        words = line.split()
        refused = without(rooms, tmp_path, *words)
        assert (refused.returncode, refused.stdout) == (2, "")
        assert re.fullmatch(r"PiGaming: .* (in|of) this installation(; there are .*)?\n", refused.stderr)
