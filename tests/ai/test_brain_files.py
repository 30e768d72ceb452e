"""Paths of files as names of brains: in matches, duels and leagues, and refused in one line."""

import os
import shutil
from pathlib import Path

import pytest

from pigaming_app import ASSETS
from pigaming_app.ai.brain_files import display_name, is_path
from pigaming_app.ai.learning.league import league
from pigaming_app.ai.networks.files import encode
from pigaming_app.ai.registry import find_brain, known_brains, new_match
from pigaming_app.games.replay import decode, to_match
from pigaming_app.games.replay import encode as encode_replay
from pigaming_app.games.setup import ChoiceError, make_setup
from pigaming_app.sim.record import digest
from tests.ai.networks.random_network import random_network
from tests.matches import finished


@pytest.fixture
def brains(tmp_path, monkeypatch):
    """A folder with two networks of the same name and a table, all of them from elsewhere."""
    monkeypatch.chdir(tmp_path)
    for seed, name in enumerate(("mine.npz", "my brains/mine.npz", "my brains/quick one.npz")):
        Path(name).parent.mkdir(exist_ok=True)
        Path(name).write_bytes(encode(random_network(seed)))
    shutil.copy(ASSETS / "brains" / "q1.npz", "table.npz")


def test_a_match_with_files_on_all_seats_is_replayed_under_their_paths(brains):
    names = ["mine.npz", "my brains/mine.npz", "table.npz", os.path.abspath("my brains/quick one.npz")]
    setup = make_setup("pitanks", names, None, 0.1, 1, None, None, known_brains("pitanks", names))
    match = finished(new_match(setup))
    replay = decode(encode_replay(match), "a.replay")
    assert [seat.brain for seat in replay.setup.seats] == names
    again = finished(to_match(replay))
    assert digest(again.state) == digest(match.state)


def test_a_file_is_read_once_by_whatever_way_it_is_named(brains):
    first = find_brain("pitanks", "mine.npz")
    Path("mine.npz").unlink()
    assert find_brain("pitanks", "./my brains/../mine.npz") is first
    assert find_brain("pitanks", "my brains/mine.npz") is not first


def test_a_league_names_files_by_their_stems_if_those_differ(brains):
    result = league("pitanks", ["mine.npz", "my brains/mine.npz", "table.npz", "idle"], 2, 1, minutes=0.05, fast=False)
    names = {"mine.npz", "my brains/mine.npz", "table", "idle"}
    assert {row.brain for row in result.standings} == names
    assert {name for duel in result.duels for name in (duel.left, duel.right)} == names


def test_names_on_screens():
    assert display_name("q1") == "q1"
    assert display_name("a/b c/mine.npz") == display_name("C:\\b\\mine.NPZ") == "mine"
    assert display_name("/tmp/a-network-with-a-long-name.npz") == "a-network-with-…"
    assert is_path(".\\mine")
    assert not is_path("mine")


@pytest.mark.parametrize(
    ("game", "name", "reason"),
    [
        ("pitanks", "none.npz", "none.npz: cannot be read"),
        ("pitanks", "C:\\none.npz", "none.npz: cannot be read"),
        ("pitanks", "my brains/", "my brains: cannot be read"),
        ("pitanks", "a\0b.npz", "not the name of a file"),
        ("race", "mine.npz", "mine.npz: it plays pitanks, not race"),
        ("factory", "table.npz", "table.npz: it plays pitanks, not factory"),
        ("pitanks", "text.npz", "text.npz: neither a network nor a trained table"),
        ("pitanks", "cut.npz", "cut.npz: "),
        ("pitanks", "mine", "no brain 'mine'; there are idle, "),
    ],
)
def test_a_file_that_is_no_brain_of_the_game_is_refused_in_one_line(brains, game, name, reason):
    Path("text.npz").write_text("hello")
    Path("cut.npz").write_bytes(Path("table.npz").read_bytes()[:5000])
    with pytest.raises(ChoiceError) as refused:
        find_brain(game, name)
    assert reason in str(refused.value)
    assert str(refused.value).isprintable()
