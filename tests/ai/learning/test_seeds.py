"""No measurement plays a start that a training may have played: every match that is begun is watched."""

from concurrent.futures import ThreadPoolExecutor

import gymnasium
import pytest

import pigaming_app.gym  # noqa: F401  (registers the environments)
from pigaming_app.ai.learning import league
from pigaming_app.ai.learning.training import TableTraining
from pigaming_app.ai.ppo.training import Training, in_threads
from pigaming_app.ai.qlearning.recipe import RECIPES
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError
from pigaming_app.sim.rng import SEEDS, seeded, training_seed
from tests.ai.ppo.plain import TASK, TINY, play_plain


@pytest.fixture
def begun(monkeypatch):
    """The seeds of all matches of PiTanks that are begun."""
    game, seeds = games()["pitanks"], []

    def start(match, arena, setup):
        seeds.append(setup.seed)
        begin(match, arena, setup)

    begin = game.start
    object.__setattr__(game, "start", start)
    yield seeds
    object.__setattr__(game, "start", begin)


def test_matches_of_trainings_have_negative_seeds(begun, monkeypatch):
    play_plain(monkeypatch)
    training = Training(TASK, 5, 2, TINY)
    with ThreadPoolExecutor(1) as executor:
        training.update(in_threads(training, executor), executor)
    table = TableTraining(RECIPES[1], 3, fast=False, minutes=0.02)
    table.run(10)
    env = gymnasium.make("PiTanks-v0", compiled=False, minutes=0.05)
    for seed in range(5):
        env.reset(seed=seed)
    assert begun
    assert max(begun) < 0


def test_matches_of_measurements_have_seeds_from_0(begun):
    league.duel("pitanks", "idle", "random", 6, 0, minutes=0.05, arena=None, fast=False)
    assert sorted(set(begun)) == [0, 1, 2]
    with pytest.raises(ChoiceError, match="--seed: -1"):
        league.duel("pitanks", "idle", "random", 6, -1, minutes=0.05, arena=None, fast=False)


def test_seeds_of_minds_are_disjoint_as_well():
    """A mind's seed is four times the match's and its seat, and `seeded` takes 64 bits of it."""
    bits = (1 << 64) - 1
    highest, lowest = 4 * (SEEDS - 1) + 3, 4 * training_seed(SEEDS - 1)
    assert 0 <= highest < (lowest & bits) < (4 * training_seed(0) + 3) & bits == bits
    assert 0 <= seeded(training_seed(SEEDS - 1)) < 1 << 31
