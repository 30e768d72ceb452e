"""Decisions a second and lapses of attention, by maximum likelihood from the times between visible decisions.

A person decides after 0.7 to 1.3 mean periods; a lapse of up to twice its mean length comes in between now and then;
some decisions change nothing that can be seen. Times are in ticks.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from pigaming_app.ai.people.fit.wishes import Array

LONGEST = 300  # ticks; longer times count as these
ROUNDS = 90  # of the search
FLOOR = 1e-5  # probability of a time that the model excludes


class Lapses(NamedTuple):
    """Logarithms of the odds per tick and of the mean length in ticks; log-odds of a decision that shows nothing."""

    odds: float
    length: float
    unseen: float


def period_of(times: Array, unseen: float) -> float:
    """The mean period. `unseen`: log-odds of an invisible decision from which the search begins."""
    counts = _counts(times)

    def cost(x: Array) -> float:
        return -float(counts @ np.log(density(np.exp(x[0]), Lapses(x[1], x[2], x[3])) + FLOOR))

    first = [np.array([np.log(period), np.log(0.001), np.log(40.0), unseen]) for period in np.geomspace(7.0, 45.0, 40)]
    return float(np.exp(searched(cost, min(first, key=cost), (0.05, 0.7, 0.5, 0.7))[0]))


def lapses_of(times: Array, cut: Array, period: float, unseen: float) -> Lapses:
    """The lapses of somebody with this period. `cut`: times after which nothing more is known."""
    counts, ended = _counts(times), _counts(cut)

    def cost(x: Array) -> float:
        chances = density(period, Lapses(*x))
        later = np.clip(1.0 - np.cumsum(chances), FLOOR, 1.0)
        return -float(counts @ np.log(chances + FLOOR) + ended @ np.log(later))

    starts = [np.array([np.log(odds), np.log(length), unseen]) for odds, length in ((0.001, 40.0), (0.002, 20.0))]
    found = [searched(cost, start, (0.7, 0.5, 0.7)) for start in starts]
    return Lapses(*min(found, key=cost))


def density(period: float, lapses: Lapses) -> Array:
    """Chance of each time between two visible decisions, from 0 to LONGEST - 1."""
    if not 4.0 < period < 70.0 or lapses.odds > -1.6 or not 0.0 < lapses.length < 5.3:
        return np.zeros(LONGEST)
    ticks = np.arange(LONGEST)
    free = np.clip(np.minimum(ticks, 1.3 * period) - np.maximum(ticks - 1, 0.7 * period), 0.0, None) / (0.6 * period)
    away = np.clip(np.minimum(ticks, 2.0 * np.exp(lapses.length) + 1.0) - np.maximum(ticks - 1, 0), 0.0, 1.0)
    rate = np.exp(lapses.odds) * period
    once = _after(free, away / away.sum())
    known = np.exp(-rate) * (free + rate * once + 0.5 * rate**2 * _after(once, away / away.sum()))
    unseen = 1.0 / (1.0 + np.exp(-lapses.unseen))
    total, several = np.array(known), known
    for _ in range(6 if unseen > 0.1 else 2):
        several = unseen * _after(several, known)
        total += several
    return np.array((1.0 - unseen) * total)


def searched(cost: Callable[[Array], float], start: Array, steps: tuple[float, ...], rounds: int = ROUNDS) -> Array:
    """The minimum near `start`, by the simplex method of Nelder and Mead (The Computer Journal 7, 1965)."""
    points = [start, *(start + step * row for step, row in zip(steps, np.eye(len(start)), strict=True))]
    costs = [cost(point) for point in points]
    for _ in range(rounds):
        order = np.argsort(costs)
        points, costs = [points[i] for i in order], [costs[i] for i in order]
        middle = np.mean(points[:-1], axis=0)
        tried = [middle + reach * (middle - points[-1]) for reach in (1.0, 2.0, -0.5)]
        beyond = cost(tried[0])
        if beyond < costs[0]:
            far = cost(tried[1])
            points[-1], costs[-1] = (tried[1], far) if far < beyond else (tried[0], beyond)
        elif beyond < costs[-2]:
            points[-1], costs[-1] = tried[0], beyond
        elif (inside := cost(tried[2])) < costs[-1]:
            points[-1], costs[-1] = tried[2], inside
        else:
            points = [points[0], *(0.5 * (points[0] + point) for point in points[1:])]
            costs = [costs[0], *(cost(point) for point in points[1:])]
    return points[int(np.argmin(costs))]


def _after(first: Array, second: Array) -> Array:
    return np.convolve(first, second)[:LONGEST]


def _counts(times: Array) -> Array:
    return np.bincount(np.minimum(times, LONGEST - 1), minlength=LONGEST).astype(float)
