"""A game from elsewhere learns by `train ppo`: by its task, by a task file of its own, and with no task at all."""

from pathlib import Path

import pytest

from pigaming_app.ai.networks.files import MAX_BYTES
from pigaming_app.storage.plugins.consent import switch
from pigaming_app.storage.plugins.found import user_folder
from tests.ai.ppo.plain import SET
from tests.plugins.packages import changed, write_tag
from tests.processes import Ended, python

JOBS = """
import sys
from pigaming_app.ai.ppo import shard, win_rates
from pigaming_app.jobs.cli import main
from pigaming_app.jobs.learning.train import ppo_training
from tests.ai.ppo.plain import plain_loop

shard.loop_of = win_rates.loop_of = plain_loop
ppo_training.MEASURED = ppo_training.MEASURED_AT_END = ppo_training.MEASURED_AGAINST = 1
for words in sys.argv[1:]:
    if code := main(words.split()):
        sys.exit(code)
"""
SMALL = " ".join([*SET, "--set matches=16"])
TRAIN = f"train ppo tag --updates 1 {SMALL} --out tag.npz"


@pytest.fixture
def tag(home: Path) -> Path:
    switch("tag", True)
    return write_tag(user_folder() / "tag")


def run(folder: Path, *jobs: str) -> Ended:
    return python(JOBS, *jobs, cwd=folder)


def test_a_game_with_a_task_learns_is_exploited_and_prints_a_file_by_which_it_learns(tag: Path, tmp_path: Path) -> None:
    changed(tag / "training.py", "minutes=(1.0,)", "minutes=(0.05,)")
    ended = run(tmp_path, TRAIN, f"exploit tag.npz --decisions 40 {SMALL}", "train task tag", "train task tag.npz")
    assert ended.returncode == 0, ended.stderr
    assert "against tag.npz: " in ended.stdout, "its rival's score"
    assert (tmp_path / "rival_tag.npz").stat().st_size < MAX_BYTES
    of_game, of_network = ("game =" + text for text in ended.stdout.split("game =")[1:])
    assert 'seats = ["learner", "level1", "level1", "level1"]' in of_game
    assert "updates = 1\n" in of_network
    (tmp_path / "mine.toml").write_text(of_network.replace("units = 64", "units = 8"))
    (tag / "brains").mkdir()
    (tag / "brains" / "tag.task.toml").write_text(of_game.replace("match_minutes = [0.05]", "match_minutes = [0.07]"))
    ended = run(tmp_path, f"{TRAIN} --task mine.toml", "train task tag.npz", "train task tag")
    assert ended.returncode == 0, ended.stderr
    assert "units = 8\n" in ended.stdout
    assert "match_minutes = [0.07]" in ended.stdout, "that of the game, beside its network"
    (tag / "brains" / "tag.task.toml").write_text("speed = 1")
    ended = run(tmp_path, TRAIN)
    assert ended.returncode == 1
    assert "is left out: tag.task.toml: speed is not a key here; there are game, seed, " in ended.stderr


def test_a_game_with_an_encoding_alone_learns_by_its_points(tag: Path, tmp_path: Path) -> None:
    (tag / "training.py").unlink()
    ended = run(tmp_path, "train task tag")
    assert ended.returncode == 0, ended.stderr
    assert "[rewards]\npoint = 0.5\nlead = 0.5\n" in ended.stdout
    (tmp_path / "mine.toml").write_text(ended.stdout.replace("match_minutes = [1.0]", "match_minutes = [0.05]"))
    ended = run(tmp_path, f"{TRAIN} --task mine.toml")
    assert ended.returncode == 0, ended.stderr
    assert "against level3: " in ended.stdout
    (tag / "brains").mkdir()
    (tag / "brains" / "tag.task.toml").write_text("speed = 1")
    ended = run(tmp_path, TRAIN)
    assert ended.returncode == 1
    assert "is left out: tag.task.toml: speed is not a key here" in ended.stderr
