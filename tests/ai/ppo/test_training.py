"""A training by PPO: the same bits however it is interrupted or divided, and matches as they were asked for."""

import json
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from pigaming_app.ai.brain.archive import BrainFileError
from pigaming_app.ai.learning.batch import matches as new_matches
from pigaming_app.ai.networks.files import BRAINS, brain_of, decode, encode
from pigaming_app.ai.networks.policy import packed_layers
from pigaming_app.ai.ppo import product
from pigaming_app.ai.ppo import training as training_module
from pigaming_app.ai.ppo.product import trained_network
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.ppo.task import LEARNER, OFF, POOL, LineUp
from pigaming_app.ai.ppo.task_file import parse_task_file
from pigaming_app.ai.ppo.training import Training, in_threads, start_of, whole_layers
from pigaming_app.ai.ppo.win_rates import DuelScore, win_rates
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.game import Setup
from pigaming_app.games.setup import ChoiceError
from tests.ai.ppo.plain import TASK, TINY, play_plain, same


@pytest.fixture(autouse=True)
def _plain(monkeypatch):
    play_plain(monkeypatch)


def trained(updates, threads=1, training=None, planned=4):
    """A training after some updates."""
    training = training or Training(TASK, 5, planned, TINY)
    with ThreadPoolExecutor(threads) as executor:
        for _ in range(updates):
            training.update(in_threads(training, executor), executor)
    return training


@pytest.fixture(scope="module")
def halfway():
    with pytest.MonkeyPatch.context() as patch:
        play_plain(patch)
        return trained(2)


def test_it_goes_on_from_a_checkpoint_as_if_nothing_had_happened(halfway, tmp_path):
    path = tmp_path / "a.checkpoint.npz"
    path.write_bytes(product.encode(halfway))
    other = Training(TASK, 5, 4, TINY)
    product.restore(other, path)
    assert same(other, halfway)
    whole = trained(4, threads=2)
    assert same(trained(2, training=other), whole)
    assert not np.array_equal(whole.learner.policy.weights[0], halfway.learner.policy.weights[0])
    assert whole.decisions > halfway.decisions > 0


def test_the_exploiter_learns_from_duels_with_the_learner_alone_and_is_pooled(halfway, monkeypatch):
    begin = Training(TASK, 5, 4, TINY)
    for fresh, later in zip(begin.learners, halfway.learners, strict=True):
        assert not np.array_equal(fresh.policy.weights[0], later.policy.weights[0])
    first, second = halfway.learners
    assert not np.array_equal(first.policy.weights[0], second.policy.weights[0])
    assert second.policy.steps < first.policy.steps, "it has less experience"
    monkeypatch.setattr(training_module, "POOLED_EVERY", (1, 2))
    pooled = trained(2)
    assert [len(pool) for pool in pooled.pools] == [3, 2]
    networks = [whole_layers(learner.policy.weights) for learner in pooled.learners]
    assert [pool[-1:].tobytes() for pool in pooled.pools] == [packed_layers(layers).tobytes() for layers in networks]


def test_a_damaged_or_foreign_checkpoint_is_refused_in_one_line(halfway, tmp_path):
    raw, path = product.encode(halfway), tmp_path / "a.checkpoint.npz"
    damaged = bytearray(raw)
    damaged[len(raw) // 2] ^= 1
    for content, reason in (
        (b"", "not a checkpoint"),
        (raw[:-100], "damaged"),
        (bytes(damaged), "damaged"),
        (encode(trained_network(halfway, "a")), "not a checkpoint"),
    ):
        path.write_bytes(content)
        with pytest.raises(BrainFileError, match=f"^a.checkpoint.npz: .*{reason}"):
            product.restore(Training(TASK, 5, 4, TINY), path)
    path.write_bytes(raw)
    for other, reason in ((Training(TASK, 6, 4, TINY), "seed"), (Training(TASK, 5, 5, TINY), "updates")):
        with pytest.raises(BrainFileError, match=f"another {reason}$"):
            product.restore(other, path)


def test_the_file_of_the_network_names_its_recipe(halfway):
    network = decode(encode(trained_network(halfway, "mine")), "mine.npz")
    task = parse_task_file(str(network.recipe["task"]))
    assert task.training == TINY
    assert task.rewards
    assert task.rewards["win"] == 2.0
    assert [line_up.seats[1] for line_up in task.line_ups] == ["hand3", "learner", "exploiter", "pool"]
    assert (task.seed, task.updates) == (5, 4)
    assert (network.updates, network.decisions, network.licence) == (2, halfway.decisions, "MIT")
    assert json.dumps(network.recipe)
    played = packed_layers(halfway.layers())
    assert brain_of(network).weights(True).tobytes() == played.tobytes()


def test_progress_is_measured_from_both_sides(halfway):
    """Somebody who stands still is beaten as often as it is out-scored; nobody loses to a robot that never shoots."""
    with ThreadPoolExecutor(1) as threads:
        (score,) = win_rates(TASK, packed_layers(halfway.layers()), 4, threads).values()
    assert sum(score) == 4
    assert score.losses == 0


def begun(monkeypatch, module):
    """The matches that a module of the learner begins from now on."""
    seen: list[Setup] = []

    def noted(setups):
        seen.extend(setups)
        return new_matches(setups)

    monkeypatch.setattr(f"pigaming_app.ai.ppo.{module}.new_matches", noted)
    return seen


def test_what_continues_a_network_begins_with_its_weights_and_values_them_before_it_changes_them():
    shipped = decode((BRAINS / "champion.npz").read_bytes(), "champion.npz")
    training = Training(TASK, 5, 4, replace(TINY, held=2), start=start_of("pitanks", "net"))
    values = training.learner.value.weights[0].copy()
    trained(2, training=training)
    held = trained_network(training, "held")
    for one, other in zip((*held.matrices, *held.biases), (*shipped.matrices, *shipped.biases), strict=True):
        assert np.array_equal(one, other)
    assert held.recipe["start"] == "net"
    assert not np.array_equal(training.learner.value.weights[0], values)
    trained(1, training=training)
    assert not np.array_equal(trained_network(training, "later").matrices[0], shipped.matrices[0])


def test_a_network_that_grows_plays_on_as_before_and_learns_with_all_its_units():
    """New units have nothing to say at first, so all outputs are the same whole numbers."""
    start, random = start_of("pitanks", "net"), np.random.default_rng(4)
    task = replace(TASK, units=start.layers.units + 32, hyper=replace(TINY, held=1, rate=0.05))
    training = Training(task, 5, 4, start=start)
    seen = random.integers(-256, 257, (200, task.encoding.size)) * (random.random((200, task.encoding.size)) < 0.5)
    assert training.layers().logits_of(seen.tolist()) == start.layers.logits_of(seen.tolist())
    rows = np.column_stack([seen / 256, np.ones(len(seen))]).astype(np.float32)
    same = Training(replace(task, units=start.layers.units), 5, 4, start=start).learner.policy.forward(rows)[0]
    first = training.learner.policy.forward(rows)[0]
    assert chances(task, first) == pytest.approx(chances(task, same), abs=1e-5)
    before = [matrix.copy() for matrix in training.learner.policy.weights]
    trained(3, training=training)
    pairs = zip(training.learner.policy.weights, before, strict=True)
    first_layer, second, last = ((matrix != old)[:-1] for matrix, old in pairs)
    new = slice(start.layers.units, None)
    assert first_layer[:, new].any(axis=0).all(), "each new unit learns"
    assert second[new].any(axis=1).all()
    assert second[:, new].any(axis=0).all()
    assert last[new].any(axis=1).all()
    grown = decode(encode(trained_network(training, "grown")), "grown.npz")
    assert grown.units == start.layers.units + 32
    assert brain_of(grown).weights(False)[0].logits_of(seen.tolist()) == training.layers().logits_of(seen.tolist())
    smaller = Training(TASK, 5, 4, TINY, start=start._replace(layers=training.layers()))
    assert smaller.task.units == grown.units, "a network never shrinks"


def chances(task, logits):
    """Probabilities of all choices (outputs, n) from logits."""
    heads = np.split(np.exp(logits), np.cumsum([count for _, count in task.encoding.heads])[:-1])
    return np.concatenate([head / head.sum(axis=0) for head in heads])


def test_who_has_no_weights_cannot_be_continued():
    with pytest.raises(ChoiceError, match=r"^hand3 is not a network"):
        start_of("pitanks", "hand3")
    with pytest.raises(ChoiceError, match=r"^race.npz: it plays race, not pitanks$"):
        start_of("pitanks", str(BRAINS / "race.npz"))


@pytest.mark.parametrize(("game", "variant", "seats"), [("pitanks", "party", 1), ("football", "standard", 2)])
def test_a_network_loses_to_itself_as_often_as_it_wins(game, variant, seats, monkeypatch):
    """Matches come in pairs, with the same seeds and the sides swapped, so one is the other seen by the opponent."""
    seen = begun(monkeypatch, "win_rates")
    task = replace(TASKS[game].against("net", variant), minutes=(0.06,))
    (line_up,) = task.line_ups
    assert line_up.seats.count("learner") == line_up.seats.count("net") == seats
    network = find_brain(game, "net").weights(True)
    with ThreadPoolExecutor(2) as threads:
        (score,) = win_rates(task, network, 4, threads).values()
    assert score.wins == score.losses
    assert sum(score) == 4
    assert {setup.variant for setup in seen} == {variant}
    assert {setup.seed for setup in seen} == {1_000_000, 1_000_001}
    assert all(sum(seat.brain == "ai" for seat in setup.seats) == 2 * seats for setup in seen)


@pytest.mark.parametrize(("game", "variant"), [("pitanks", "party"), ("football", "standard")])
def test_a_network_beats_who_stands_still_on_either_side(game, variant):
    task = replace(TASKS[game].against("idle", variant), minutes=(0.25,))
    with ThreadPoolExecutor(2) as threads:
        (score,) = win_rates(task, find_brain(game, "net").weights(True), 2, threads).values()
    assert score.wins == 2


def test_no_match_of_a_training_has_the_seed_of_a_measurement(monkeypatch):
    seen = begun(monkeypatch, "shard")
    Training(TASK, 5, 4, TINY)
    assert max(setup.seed for setup in seen) < 0


def test_the_first_matches_meet_members_that_the_pool_has():
    """Also where more networks sit on seats than the pool begins with; an index beyond it reads foreign memory."""
    seats = [(LEARNER, name, OFF, OFF) for name in ("level1", "level3", "level5", "net", POOL)]
    task = replace(TASK, line_ups=tuple(LineUp(1, names) for names in seats))
    training = Training(task, 5, 4, replace(TINY, matches=40))
    for shard in training.shards:
        own = shard.minds["family"] == shard._number
        networks = len(shard.cast.weights[shard._number])
        assert networks > 1
        assert shard.minds["row"][own].max() < networks + sum(map(len, training.pools))


@pytest.mark.parametrize("score", [DuelScore(7, 0, 3), DuelScore(120, 31, 49), DuelScore(0, 0, 5)])
def test_the_interval_is_where_the_share_is_two_standard_deviations_off(score):
    """E. B. Wilson, 1927: of a true share p, that found in n matches is sqrt(p (1 - p) / n) off."""
    n = sum(score)
    for end in score.interval:
        assert abs(end - score.share) == pytest.approx(1.959964 * (end * (1 - end) / n) ** 0.5, abs=1e-9)
    assert score.share == (score.wins + score.ties / 2) / n


def test_too_few_matches_are_refused():
    """Four kinds of equal shares, each with a learner, for four shards: one each from 3 on, rounded halves to even."""
    with pytest.raises(ValueError, match="matches: 2 are too few for these line-ups; possible are 3 to 10000"):
        Training(TASK, 1, 1, type(TINY)(matches=2))
