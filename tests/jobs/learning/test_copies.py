"""Frozen copies of a training, and their league."""

import json
from functools import partial

import pytest

from pigaming_app.ai.learning import league as leagues
from pigaming_app.ai.networks.files import decode
from pigaming_app.jobs.cli import main
from pigaming_app.jobs.learning.train import copies, ppo_training
from tests.ai.ppo.plain import SET, play_plain


@pytest.fixture
def played(monkeypatch):
    """The setups of the league's matches; plain and short ones."""
    play_plain(monkeypatch)
    for measured in ("MEASURED", "MEASURED_AT_END"):
        monkeypatch.setattr(ppo_training, measured, 1)
    setups, play = [], leagues.play_duel

    def noted(some, left, right, fast):
        setups.extend(some)
        return play(some, left, right, fast)

    monkeypatch.setattr(copies, "MATCHES", 2)
    monkeypatch.setattr(leagues, "play_duel", noted)
    monkeypatch.setattr(leagues, "league", partial(leagues.league, fast=False))
    return setups


def weights(path):
    return [matrix.tobytes() for matrix in decode(path.read_bytes(), path.name).matrices]


def test_a_league_rates_the_copies_by_matches_that_no_training_plays(tmp_path, played, capsys):
    folder = tmp_path / "copies"
    job = ["train", "ppo", "pitanks", *SET, "--out", str(tmp_path / "a.npz"), "--copies", str(folder), "--json"]
    assert main([*job, "--updates", "2"]) == 0
    names = [f"a_000000{k}" for k in range(3)]
    files = sorted(folder.iterdir())
    assert [file.stem for file in files] == names
    assert len({tuple(weights(file)) for file in files}) == 3
    assert weights(files[-1]) == weights(tmp_path / "a.npz")
    league = json.loads(capsys.readouterr().out)["copies"]
    assert sorted(row["brain"] for row in league["standings"]) == names
    assert len(league["duels"]) == 3
    assert {(setup.seed, setup.arena) for setup in played} == {(1_000_000, "classic")}
    files[1].unlink()
    (folder / "a_0000099.npz").write_text("of a longer training")
    assert main([*job, "--updates", "2", "--resume"]) == 0
    league = json.loads(capsys.readouterr().out)["copies"]
    assert sorted(row["brain"] for row in league["standings"]) == [names[0], *names[2:]]
