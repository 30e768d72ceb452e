"""Auto finds the strength that suits a person, whoever it is and wherever it begins."""

import random
from math import exp
from statistics import mean

import pytest

from pigaming_app.ai.auto import Estimate
from pigaming_app.ai.brain.effort import AUTO

LAST = len(AUTO) - 1


def series(suited, first, seed, matches=12):
    """Wins of somebody against whom strength `suited` is even: a logistic law, as in ratings, and noise of the day."""
    chance, estimate, wins = random.Random(seed), Estimate(first), []
    for _ in range(matches):
        strength = estimate.strength
        end = min(max(chance.gauss(suited, 1.0), strength - 2), strength + 2)
        even = 1.0 / (1.0 + exp(0.8 * (0.5 * (strength + end) - suited) + 0.4))  # 40 of 100 if it suits
        wins.append(float(chance.random() < even))
        estimate.update(min(max(end, 0.0), LAST) / LAST, wins[-1])
    return wins


@pytest.mark.parametrize("suited", [1.0, 3.0, 5.0, 6.5])
@pytest.mark.parametrize("first", [0, 4, LAST])
def test_it_suits_after_three_matches_from_any_start(suited, first):
    wins = [series(suited, first, seed)[3:] for seed in range(300)]
    assert 0.3 < mean(map(mean, wins)) < 0.5


def test_the_strength_divides_the_beliefs_evenly():
    estimate = Estimate()
    estimate.beliefs = [0.0, 5.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
    assert estimate.strength == 1
    estimate.beliefs[5] = 4.0
    assert estimate.strength in (2, 3)


@pytest.mark.parametrize("effort", [0.0, 0.3, 1.0])
def test_a_victory_never_makes_it_weaker_nor_a_defeat_stronger(effort):
    for first in range(LAST + 1):
        won, lost = Estimate(first), Estimate(first)
        won.update(effort, 1.0)
        lost.update(effort, 0.0)
        assert lost.strength <= Estimate(first).strength + 1
        assert lost.strength <= won.strength


def test_it_follows_somebody_who_learns():
    """Ten defeats, then ten victories: what was believed first does not last."""
    estimate = Estimate(LAST)
    for _ in range(10):
        estimate.update(estimate.strength / LAST, 0.0)
    assert estimate.strength <= 1
    for _ in range(10):
        estimate.update(estimate.strength / LAST, 1.0)
    assert estimate.strength >= LAST - 1
