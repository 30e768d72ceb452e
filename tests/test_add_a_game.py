"""docs/add-a-game.md: its files make a game, and each of its commands runs."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from pigaming_app.storage.plugins.consent import switch
from pigaming_app.storage.plugins.found import user_folder
from tests.plugins.packages import FILES, PAGE, ROOT, write_tag

COMMANDS = re.findall(r"^    python3 main\.py (.*)$", PAGE, re.M)
LEVEL = re.findall(r"^```python\n(from pathlib.*?)^```", PAGE, re.M | re.S)
SHORTER = {
    "play tag": "play tag --headless --speed max --minutes 0.2 --seats level1,level5",
    "play tag --seats human,tag.npz,tag.npz,level5": "play tag --headless --minutes 0.05 --seats idle,tag.npz",
    "train ppo tag --minutes 3 --out tag.npz": "train ppo tag --updates 2 --set matches=16 --out tag.npz",
    "duel tag tag.npz level5 --matches 200 --minutes 1 --seed 100": "duel tag tag.npz level5 --matches 2 --minutes 0.2",
}


@pytest.fixture
def tag(home: Path) -> Path:
    """The package of Tag, as the page makes it."""
    switch("tag", True)
    return write_tag(user_folder() / "tag")


def run(command: str) -> str:
    words = [sys.executable, "-X", "pigaming", "main.py", *shlex.split(command)]
    environment = os.environ | {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"}
    ended = subprocess.run(words, capture_output=True, text=True, cwd=ROOT, env=environment, timeout=1800)
    assert ended.returncode == 0, (command, ended.stdout[-2000:], ended.stderr)
    return ended.stdout


def test_the_page_has_the_files_of_a_game_in_this_style() -> None:
    assert {*FILES} == {"rules.py", "ai.py", "screens.py", "editor.py", "network.py", "training.py"}
    for name, code in FILES.items():
        for tool in (("check", "--ignore", "INP"), ("format", "--check")):
            words = [sys.executable, "-m", "ruff", *tool, "--quiet", f"--stdin-filename=tests/{name}", "-"]
            assert subprocess.run(words, input=code, text=True, cwd=ROOT).returncode == 0, name


def test_tag_is_played_by_its_rules(tag: Path) -> None:
    points = run("play tag --headless --speed max --minutes 0.5 --seats level5,level5,level5,level5 --seed 1 --json")
    scores = [int(score) for score in re.findall(r'"score": (\d+)', points)]
    assert len(scores) == 4
    assert 3 * 29 <= sum(scores) <= 3 * 30, "three robots score each second"
    assert len({*scores}) > 1, "it was passed on"


@pytest.mark.again
@pytest.mark.long(first=True)
def test_every_command_of_the_page_runs_and_the_network_becomes_a_level(tag: Path, tmp_path: Path) -> None:
    assert len(COMMANDS) == 11
    assert COMMANDS[0] == "new-game tag"
    assert {*SHORTER} < {*COMMANDS}
    for command in COMMANDS[1:]:
        run(re.sub(r"\btag\.(npz|png)", rf"{tmp_path}/tag.\1", SHORTER.get(command, command)))
    assert (tmp_path / "tag.png").stat().st_size > 50_000
    (tag / "brains").mkdir()
    (tmp_path / "tag.npz").rename(tag / "brains" / "tag.npz")
    (snippet,) = LEVEL
    (tag / "ai.py").write_text(f"{FILES['ai.py']}\n{snippet}", encoding="utf-8")
    run("play tag --headless --minutes 0.1 --seats level5,level4")
    code = "from pigaming_app.ai.registry import BRAINS\nfrom pigaming_app.ai.explanations.registry import explain_of\n"
    code += "print(*(k for k, b in BRAINS['tag'].items() if explain_of(b, 'tag')))"
    explained = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, timeout=60)
    assert explained.stdout.split() == ["idle", "random", "level5"], "networks explain themselves"
