"""A population: who is met how often, who joins and goes, and the same bits whatever happens in between."""

from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from pigaming_app.ai.networks.policy import packed_layers
from pigaming_app.ai.ppo import population as population_module
from pigaming_app.ai.ppo import product
from pigaming_app.ai.ppo import training as training_module
from pigaming_app.ai.ppo.population import EXPLOITED, MEMORY, PATIENCE, Pool, Population
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.ppo.shard import Shard
from pigaming_app.ai.ppo.training import Training, in_threads, start_of, whole_layers
from tests.ai.ppo.plain import TASK, TINY, play_plain, same

POPULATED = TASK.populated()
SMALL = replace(TINY, held=1)


@pytest.fixture(autouse=True)
def _plain(monkeypatch):
    play_plain(monkeypatch)
    monkeypatch.setattr(training_module, "SELF_EVERY", 2)


def trained(updates, threads=1, training=None, start=None):
    training = training or Training(POPULATED, 5, 4, SMALL, start=start)
    with ThreadPoolExecutor(threads) as executor:
        for _ in range(updates):
            training.update(in_threads(training, executor), executor)
    return training


def second(outcomes, members):
    """The chances by their definition: whole histories, in rational numbers."""
    memory, weights = Fraction(MEMORY), []
    for place in range(members):
        scores = [Fraction(score) for one, score in outcomes if one == place]
        ages = [memory ** (len(scores) - 1 - k) for k in range(len(scores))]
        won = sum((age * score for age, score in zip(ages, scores, strict=True)), Fraction())
        weights.append((1 - (won + 1) / (sum(ages, Fraction()) + 2)) ** 2)
    return [float(weight / sum(weights)) for weight in weights]


def test_a_member_is_met_the_more_often_the_more_it_wins():
    random, population = np.random.default_rng(3), Population()
    places = [population.place_of(0, k, most=5) for k in range(4)]
    assert places == [1, 2, 3, 4]
    outcomes = [(int(place), float(random.integers(3)) / 2) for place in random.integers(4, size=60)]
    for k in range(0, 60, 7):
        population.note(outcomes[k : k + 7])
    assert population.chances == pytest.approx(second(outcomes, 5), rel=1e-9)
    beaten = Population()
    beaten.place_of(0, 0, most=2)
    beaten.note([(0, 1.0)] * 30 + [(1, 0.0)] * 30)
    assert beaten.chances[1] > 100 * beaten.chances[0]


def test_who_is_least_often_met_leaves_a_full_pool():
    population = Population()
    for k in range(2):
        population.place_of(0, k, most=3)
    population.note([(0, 0.5), (1, 1.0), (1, 1.0), (2, 0.0)])
    assert population.place_of(1, 7, most=3) == 1
    assert population.joined[1] == [1, 7]
    assert population.members[1].matches == 0.0


def test_an_exploiter_is_done_when_it_wins_or_after_a_while():
    population = Population()
    population.note([(EXPLOITED, 0.0)] * 10)
    assert not population.exploiter_is_done(10), "too few matches"
    population.note([(EXPLOITED, 0.0)] * 40)
    assert population.exploiter_is_done(10)
    population.next_exploiter(10)
    population.note([(EXPLOITED, 1.0)] * 60)
    assert not population.exploiter_is_done(9 + PATIENCE)
    assert population.exploiter_is_done(10 + PATIENCE)
    assert population.members[0].matches == 0.0, "an exploiter's matches are no member's"


def test_matches_are_begun_by_these_chances():
    shard = Shard(POPULATED, [line_up for line_up in POPULATED.line_ups if "pool" in line_up.seats] * 4, seed=1)
    rows = np.concatenate([shard.cast.weights[shard._number]] * 3)
    chances, base = np.array([0.7, 0.0, 0.3]), len(shard.cast.weights[shard._number])
    met: Counter[int] = Counter()
    for k in range(400):
        shard._begin(k % 4, Pool(rows, chances))
        (seat,) = (seat for seat in range(4) if shard.minds["family"][k % 4, seat] == shard._number)
        met[int(shard.minds["row"][k % 4, seat]) - base] += 1
    assert met.keys() == {0, 2}
    assert met[0] == pytest.approx(280, abs=4 * (400 * 0.7 * 0.3) ** 0.5)


@pytest.mark.parametrize("scores", [(3, 1), (1, 3), (2, 2)])
def test_the_end_of_a_match_is_noted_for_the_member_that_played_it(scores):
    pool = [line_up for line_up in POPULATED.line_ups if "pool" in line_up.seats]
    others = [line_up for line_up in POPULATED.line_ups if "exploiter" in line_up.seats or "hand3" in line_up.seats]
    shard = Shard(POPULATED, [*pool, *others], seed=2)
    rows = np.concatenate([shard.cast.weights[shard._number]] * 3)
    shard._begin(0, Pool(rows, np.array([0.0, 0.0, 1.0])))
    for i, line_up in enumerate(shard.line_ups):
        own = next(k for k in range(4) if shard.minds["family"][i, k] == -2)
        shard.matches["over"][i] = 1
        shard.matches["robots"]["score"][i, own], shard.matches["robots"]["score"][i, 1 - own] = scores
        assert set(line_up.seats) & {"pool", "exploiter", "hand3"}
    score = {(3, 1): 1.0, (1, 3): 0.0, (2, 2): 0.5}[scores]
    assert sorted(shard._outcomes().tolist()) == [[EXPLOITED, score], [2, score]]


def test_a_quarter_of_the_matches_is_against_exploiters_and_one_against_the_pool():
    for game, seats in (("race", ("learner", "pool", "off", "off")), ("football", ("learner", "pool") * 2)):
        task = TASKS[game].populated()
        shares = {name: sum(one.share for one in task.line_ups if name in one.seats) for name in ("pool", "exploiter")}
        total = sum(line_up.share for line_up in task.line_ups)
        assert shares["exploiter"] * 4 == total
        assert task.line_ups[-1].seats == seats
        assert task.line_ups[-1].share * 4 == total
        assert task.learners == ("learner", "exploiter")


def test_the_next_exploiter_starts_from_the_present_weights_and_the_last_one_joins(monkeypatch):
    monkeypatch.setattr(population_module, "PATIENCE", 3)
    training = trained(2)
    first, exploiter = training.learners
    assert len(training.pools[0]) == 2, "the network as it began, and a copy"
    assert not np.array_equal(first.policy.weights[0], exploiter.policy.weights[0])
    gone = packed_layers(whole_layers(exploiter.policy.weights))
    training = trained(1, training=training)
    assert training.population.joined == [[0, 0], [0, 2], [1, 3]]
    for one, other in zip(first.policy.weights, exploiter.policy.weights, strict=True):
        assert np.array_equal(one, other)
    assert exploiter.policy.steps == 0
    assert not exploiter.policy.means[0].any()
    assert len(training.pools[0]) == 3
    assert training.pools[0][2].tobytes() != gone[0].tobytes(), "it has learned since"
    trained(1, training=training)
    assert not np.array_equal(first.policy.weights[0], exploiter.policy.weights[0])


def test_it_goes_on_from_a_checkpoint_bit_for_bit_whatever_the_threads(tmp_path, monkeypatch):
    monkeypatch.setattr(population_module, "PATIENCE", 2)
    start = start_of("pitanks", "net")
    half, path = trained(2, start=start), tmp_path / "a.checkpoint.npz"
    path.write_bytes(product.encode(half))
    other = Training(POPULATED, 5, 4, SMALL, start=start)
    product.restore(other, path)
    assert same(other, half)
    whole = trained(4, threads=2, start=start)
    assert same(trained(2, training=other), whole)
    numbers, _ = whole.state()
    assert numbers["population"]["joined"] == [[0, 0], [0, 2], [1, 2], [0, 4], [1, 4]]
    assert sum(matches for _, matches in numbers["population"]["members"]) > 0
