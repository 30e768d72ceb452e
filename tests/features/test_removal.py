"""The arcade without its features, each alone and all together, in processes without their packages; their pages."""

import re
import subprocess
import sys
from collections.abc import Sequence
from itertools import cycle
from pathlib import Path

import pytest

from pigaming_app.games.registry import games
from pigaming_app.jobs.bench.test import paths_of
from pigaming_app.jobs.features import every_feature
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.scenes.features.registry import NAMES, features

ROOT = Path(__file__).resolve().parents[2]
ROOMS = {feature.name: feature.rooms for feature in every_feature()}
TILES = [*games(), "howto", "ladder", "events", "lab", "editor", "replays", "options"]
CORE_GAMES = [game for game in games() if game not in ROOMS]
CORE_JOBS = ("play pitanks --headless --minutes 0.05 --seats level3,level2,off,off", "doctor")
WOVEN = {"events", "mat"}  # offer more than a tile
NEEDED_BY = {"events": {"events", "ladder"}, "learning": {"lab"}, "brain": {"lab"}}


def without(rooms: Sequence[str], home: Path, *words: str) -> "subprocess.CompletedProcess[str]":
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
    assert {*ROOMS} - {*NAMES} == {"learning", "gym", "bench", "bundle", "onnx", "factory", "race", "balance"}
    for feature in every_feature():
        places = [ROOT / "pigaming_app" / room.replace(".", "/") for room in feature.rooms]
        assert all(place.is_dir() or place.with_suffix(".py").is_file() for place in places), feature.name


CASES = [
    pytest.param(name, game, marks=() if name in WOVEN else pytest.mark.again)
    for name, game in zip(ROOMS, cycle(CORE_GAMES), strict=False)
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
    toured = without(rooms, tmp_path, "tour", CORE_GAMES[0])
    assert toured.stderr == ""
    assert toured.stdout.splitlines() == [f"tiles: {' '.join(CORE_GAMES)} options", "done"]


def test_jobs_of_the_core_run_and_those_of_features_are_refused(tmp_path: Path) -> None:
    rooms = tuple(room for of_one in ROOMS.values() for room in of_one)
    ran = without(rooms, tmp_path, *CORE_JOBS)
    assert (ran.returncode, ran.stderr) == (0, "")
    assert ran.stdout.splitlines()[-1] == "All is well."
    event, onnx = "event new cup.json", "play --seats a.onnx"
    lines = ("--kiosk", event, onnx, "report", "robots", "calibrate", "train ppo", "bench", "test")
    refused = without(rooms, tmp_path, *lines)
    assert (refused.returncode, refused.stdout) == (2, "")
    told = re.findall(r"^PiGaming: .* (?:in|of) this installation(?:; there are .*)?$", refused.stderr, re.M)
    assert len(told) == len(lines) == refused.stderr.count("\n")


GAMES_AWAY = [game for game in games() if game in ROOMS]


@pytest.mark.long
@pytest.mark.again
@pytest.mark.parametrize("game", GAMES_AWAY)
def test_jobs_play_another_game_than_one_that_is_missing(game: str, tmp_path: Path) -> None:
    ran = without(ROOMS[game], tmp_path, *CORE_JOBS)
    assert (ran.returncode, ran.stderr) == (0, "")
    assert ran.stdout.splitlines()[-1] == "All is well."


@pytest.mark.parametrize("game", GAMES_AWAY)
def test_jobs_refuse_a_game_that_is_missing(game: str, tmp_path: Path) -> None:
    out = "train ppo --out a.npz", "train qlearning --out a.npz"
    jobs = ["play", "people", "exploits", "fairness", "league", "bench", *out]
    jobs = [f"{job} {game}" for job in jobs] + [f"duel {game} level1 level2"]
    jobs += [f"event new cup.json --format grandprix --entrants ANA,BEA --game {game}"]
    refused = without(ROOMS[game], tmp_path, *jobs)
    assert (refused.returncode, refused.stdout) == (2, "")
    there = ", ".join(other for other in games() if other != game)
    told = [line.startswith(f"PiGaming: no game '{game}'; there are {there}") for line in refused.stderr.splitlines()]
    assert told == [True] * len(jobs), refused.stderr


@pytest.mark.parametrize("feature", every_feature(), ids=ROOMS)
def test_a_feature_has_a_short_page_with_its_rooms_and_its_command(feature) -> None:
    folder = ROOT / "pigaming_app"
    text = (folder / feature.rooms[0].replace(".", "/") / "README.md").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 40
    assert text.endswith(f"`python3 main.py test --feature {feature.name}`\n")
    rooms = re.findall(r"^\| (.*?) \|", text, re.M)[1:]
    named = {name for cell in rooms for name in re.findall(r"`(.*?)`", cell)}
    assert all((folder / name).exists() or (ROOT / name).exists() for name in named), named
    for room in feature.rooms:
        path = room.replace(".", "/")
        assert {path, f"{path}/", f"{path}.py"} & named, room


@pytest.mark.parametrize("name", ROOMS)
def test_the_paths_of_a_feature_mirror_its_rooms(name: str) -> None:
    paths = paths_of(name)
    assert paths
    assert all((ROOT / path).exists() for path in paths)


def test_an_unknown_feature_is_refused() -> None:
    with pytest.raises(Refusal, match="no feature 'cheese'; there are attract, brain"):
        paths_of("cheese")
