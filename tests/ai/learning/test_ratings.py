"""Ratings: the formula by hand, finite values for any results, and coverage of the intervals."""

import itertools
import random
from math import log10

import pytest

from pigaming_app.ai.learning.ratings import ratings

SWEEP, DRAW, HALF = (2.0, 0.0), (1.0, 1.0), (1.5, 0.5)  # points from the two matches of a seed


def test_three_wins_of_four_by_hand():
    """With the prior tie 3.5 points against 1.5: 400 log10(3.5 / 1.5) points apart, symmetric about 0."""
    strong, weak = ratings(2, {(0, 1): [SWEEP, DRAW]}, seed=1)
    assert strong.rating == pytest.approx(200 * log10(3.5 / 1.5))
    assert weak.rating == pytest.approx(-strong.rating)


def test_a_tie_counts_as_half_a_win_for_each():
    each_won_twice, all_ties = {(0, 1): [SWEEP, (0.0, 2.0)]}, {(0, 1): [DRAW, DRAW]}
    assert [r.rating for r in ratings(2, each_won_twice, 1)] == [r.rating for r in ratings(2, all_ties, 1)] == [0, 0]
    a_win_and_a_tie = ratings(2, {(0, 1): [HALF]}, seed=1)[0]
    assert a_win_and_a_tie.rating == pytest.approx(200 * log10(2.0 / 1.0))  # 1.5 + 0.5 against 0.5 + 0.5


def test_who_has_won_every_match_has_a_finite_rating_with_a_long_way_up():
    best, last = ratings(2, {(0, 1): [SWEEP] * 50}, seed=1)
    assert best.rating == pytest.approx(200 * log10(100.5 / 0.5))
    assert best.low < best.rating < best.high < 1000
    assert best.high - best.rating > best.rating - best.low, "nobody knows how much better"
    assert last.high == pytest.approx(-best.low)


def test_more_matches_say_more():
    widths = []
    for n in (5, 50, 500):
        best, _ = ratings(2, {(0, 1): [SWEEP, DRAW, DRAW, HALF] * n}, seed=1)
        widths.append(best.high - best.low)
    assert widths == sorted(widths, reverse=True)
    assert widths[0] / widths[2] == pytest.approx(10.0, rel=0.2), "as the root of their number"


def test_the_same_seed_draws_the_same_intervals_and_any_seed_the_same_ratings():
    shares = {(0, 1): [SWEEP, HALF], (0, 2): [SWEEP, SWEEP], (1, 2): [DRAW, HALF]}
    one, two, other = (ratings(3, shares, seed) for seed in (7, 7, -3))
    assert one == two
    assert [r.rating for r in one] == [r.rating for r in other]
    assert one != other


def test_in_what_order_brains_are_named_does_not_matter():
    shares = {(0, 1): [SWEEP, HALF], (0, 2): [SWEEP, SWEEP], (1, 2): [DRAW, HALF]}
    turned = {(2 - j, 2 - i): [(b, a) for a, b in seen] for (i, j), seen in shares.items()}
    one, other = ratings(3, shares, 1), ratings(3, turned, 1)
    for mine, theirs in zip(one, reversed(other), strict=True):
        assert mine.rating == pytest.approx(theirs.rating, abs=1e-6)


def test_ratings_find_the_strengths_that_made_the_results():
    """95 % of known strengths lie within their intervals; fewer than 88 % of 160 would not be chance."""
    rng, truth, inside = random.Random(5), [150.0, 50.0, -20.0, -180.0], 0
    for league in range(40):
        shares = {}
        for i, j in itertools.combinations(range(4), 2):
            share = 1 / (1 + 10 ** ((truth[j] - truth[i]) / 400))
            won = [(rng.random() < share) + (rng.random() < share) for _ in range(40)]
            shares[i, j] = [(float(w), 2.0 - w) for w in won]
        found = ratings(4, shares, league, draws=400)
        assert sum(one.rating for one in found) == pytest.approx(0.0, abs=1e-4)
        inside += sum(one.low <= true <= one.high for one, true in zip(found, truth, strict=True))
    assert 0.88 * 160 <= inside <= 160
