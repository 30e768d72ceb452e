"""Plug-in games: found, switched on, loaded by part; one that fails is left out with one line."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from pigaming_app.jobs.new_game import write
from pigaming_app.storage.plugins import consent, found
from pigaming_app.storage.plugins.consent import is_on, switch
from pigaming_app.storage.plugins.found import Plugin, user_folder

ROOT = Path(__file__).resolve().parents[3]
LEFT_OUT = "PiGaming: The game tag in {folder} is left out: {reason}\n"


@pytest.fixture
def tag(home: Path) -> Path:
    """The package of a new game that is switched on."""
    folder = user_folder() / "tag"
    write(folder, "tag")
    switch("tag", True)
    return folder


def program(*words: str) -> subprocess.CompletedProcess[str]:
    """The program in a process of its own, with this test's folders."""
    command = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), *words]
    environment = os.environ | {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"}
    return subprocess.run(command, capture_output=True, text=True, env=environment, timeout=120)


def play() -> subprocess.CompletedProcess[str]:
    return program("play", "tag", "--headless", "--speed", "max", "--minutes", "0.1", "--seats", "hard,easy", "--json")


def test_a_new_game_plays_at_once(tag: Path) -> None:
    ended = play()
    assert (ended.returncode, ended.stderr) == (0, "")
    assert json.loads(ended.stdout)["game"] == "tag"


def test_games_are_found_in_the_users_folder_and_beside_the_program(tag: Path) -> None:
    plugins = {plugin.name: plugin for plugin in found.found()}
    assert plugins["tag"].folder == tag
    assert not plugins["tag"].own
    assert all(plugin.own == (plugin.folder.parent == ROOT) for plugin in plugins.values())


def test_a_package_without_a_proper_name_is_no_game(tag: Path) -> None:
    for name in ("Tag", "2tag", "tag-2", "x" * 25):
        write(user_folder() / name, "tag")
    (user_folder() / "notes").mkdir()
    assert [plugin.name for plugin in found.found() if not plugin.own] == ["tag"]


def test_a_new_plug_in_runs_no_code_before_it_is_switched_on(tag: Path) -> None:
    trace = tag.parent / "ran"
    source = tag / "__init__.py"
    source.write_text(f"open({str(trace)!r}, 'w').close()\n" + source.read_text())
    (user_folder().parent.parent / "config" / consent.FILE).unlink()
    ended = play()
    assert ended.returncode == 2
    assert ended.stderr == (f"PiGaming: the game tag in {tag} is new, and runs code of its own: main.py games on tag\n")
    assert "tag: new" in program("games").stdout
    assert not trace.exists()
    assert program("games", "on", "tag").returncode == 0
    assert play().returncode == 0
    assert trace.exists()


def test_one_that_is_switched_off_is_named(tag: Path) -> None:
    assert program("games", "off", "tag").stdout == "tag is off, from the next start on\n"
    assert f"the game tag in {tag} is switched off: main.py games on tag" in play().stderr


@pytest.mark.parametrize(
    ("file", "old", "new", "reason"),
    [
        ("rules.py", "REACH = 60.0", "REACH = 60.0 +", "rules.py, line 15: SyntaxError: invalid syntax"),
        ("rules.py", "REACH = 60.0", "REACH = SIXTY", "rules.py, line 15: NameError: name 'SIXTY' is not defined."),
        ("__init__.py", "GAME = ", "THIS = ", "__init__.py: GAME is missing."),
        ("__init__.py", 'name="tag"', 'name="tick"', "its game is named tick, not tag."),
        ("__init__.py", "GAME = Game(", "GAME = dict(", "GAME is no Game."),
        ("__init__.py", "GAME = ", "raise SystemExit(3)\nGAME = ", "__init__.py, line 7: SystemExit: 3."),
    ],
)  # fmt: skip
def test_one_that_fails_is_left_out_with_file_and_reason(tag: Path, file: str, old: str, new: str, reason: str) -> None:
    source = tag / file
    assert old in source.read_text()
    source.write_text(source.read_text().replace(old, new))
    ended = program("duel", "pitanks", "easy", "idle", "--matches", "2", "--minutes", "0.05")
    assert ended.returncode == 0
    assert ended.stderr.startswith(LEFT_OUT.format(folder=tag, reason=reason).rstrip("\n"))
    assert ended.stderr.count("\n") == 1
    assert "is left out: see above" in play().stderr


@pytest.mark.parametrize(
    ("file", "old", "new", "reason"),
    [
        ("screens.py", "SCREENS = ", "SCREENS = 1 or ", "SCREENS is no GameScreens"),
        ("text/en.toml", 'arena_tag = "Arena"', "", "text/en.toml lacks setup.arena_tag"),
        ("text/en.toml", "[games]", "[games", "text/en.toml: "),
    ],
)
def test_one_that_cannot_be_shown_is_not_on_the_screens(tag: Path, file: str, old: str, new: str, reason: str) -> None:
    source = tag / file
    assert old in source.read_text()
    source.write_text(source.read_text().replace(old, new, 1))
    code = "from pigaming_app.scenes.views.registry import shown_games; print(*shown_games())"
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, timeout=60)
    assert "tag" not in ended.stdout.split()
    assert {"pitanks", "factory", "race"} <= {*ended.stdout.split()}
    assert f"The game tag in {tag} is left out: {reason}" in ended.stderr


def test_only_a_plug_ins_own_replays_depend_on_its_rules(tag: Path) -> None:
    code = "from pigaming_app.games.engine_hash import engine_hash as h; print(h('pitanks'), h('tag'))"

    def hashes() -> list[str]:
        return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT).stdout.split()

    before = hashes()
    assert before[0] != before[1]
    rules, brain = tag / "rules.py", tag / "ai.py"
    brain.write_text(brain.read_text().replace("PERIOD = 5", "PERIOD = 6"))
    assert hashes() == before
    rules.write_text(rules.read_text().replace("REACH = 60.0", "REACH = 61.0"))
    after = hashes()
    assert after[0] == before[0]
    assert after[1] != before[1]


@pytest.mark.parametrize("text", ["", "[]", "{", '{"tag": 1}', '{"../tag": true}', "\x00"])
def test_damaged_decisions_switch_nothing_on(home: Path, text: str) -> None:
    file = home / "config" / consent.FILE
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    assert is_on(Plugin("tag", "tag", home)) is None
    assert is_on(Plugin("football", "pigaming_football", home, own=True)) is True


@pytest.mark.parametrize("name", ["Tag", "2", "a-b", "x" * 25, "", "../x", "pitanks"])
def test_a_new_game_needs_a_new_name(home: Path, name: str) -> None:
    ended = program("new-game", name)
    assert ended.returncode == 2
    assert ended.stderr.count("\n") == 1
    assert not user_folder().exists()
