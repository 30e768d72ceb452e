"""Periods and lapses, from times that NumPy draws as the hands do."""

import numpy as np
import pytest

from pigaming_app.ai.people.fit.statistics import LONGEST, Lapses, density, lapses_of, period_of


def times(period, odds, length, unseen, count, seed=1):
    """Times between visible decisions, in ticks."""
    draw = np.random.default_rng(seed)
    single = 1 + (period * draw.uniform(0.7, 1.3, 4 * count)).astype(int)
    lapse = np.where(
        draw.random(4 * count) < 1.0 - (1.0 - odds) ** single, 1 + (2.0 * length * draw.random(4 * count)), 0
    )
    ends = np.cumsum(single + lapse.astype(int))[draw.random(4 * count) >= unseen]
    return np.diff(ends)[:count]


@pytest.mark.parametrize("period", [10.0, 16.0, 25.0])
def test_the_period_is_found_though_half_of_the_decisions_are_not_seen(period: float) -> None:
    assert period_of(times(period, 0.001, 40.0, 0.5, 600), 0.0) == pytest.approx(period, rel=0.03)


@pytest.mark.parametrize(("odds", "length"), [(0.001, 35.0), (0.002, 75.0)])
def test_lapses_are_found(odds: float, length: float) -> None:
    found = lapses_of(times(14.0, odds, length, 0.02, 6000), np.array([], int), 14.0, -3.0)
    assert np.exp(found.odds) == pytest.approx(odds, rel=0.15)
    assert np.exp(found.length) == pytest.approx(length, rel=0.15)


def test_chances_add_up() -> None:
    assert density(14.0, Lapses(-7.0, 3.5, -3.0)).sum() == pytest.approx(1.0, abs=0.01)
    assert len(density(14.0, Lapses(-7.0, 3.5, -3.0))) == LONGEST
