"""How strong each of several brains is, from whom it beat: ratings after Bradley and Terry, with intervals.

A brain of strength s beats one of strength t with probability s / (s + t) (Biometrika 39, 1952, 324-345). A tie counts
as half a win for each. Strengths are told as ratings with mean 0, 400 (log10 s), as chess does: 100 points more are 64
wins in 100, 200 more 76, 400 more 91.

Every pair is lent one tie that nobody played, so that even who has won every match has a finite rating. The intervals
are a Bayesian bootstrap (Rubin, Ann. Stat. 9, 1981, 130-134): what was seen under one seed, from both sides, has a
random weight, and so has the lent tie.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import log
from typing import Any

DRAWS = 2000  # of the bootstrap
SCALE = 400.0 / log(10.0)  # points for a factor of e in strength
STEPS, LONGEST = 100, 2.0  # of Newton's method: how many at most, and how far one may go, in factors of e
SMALL = 1e-9  # a step that no longer matters

Shares = Mapping[tuple[int, int], Sequence[tuple[float, float]]]


@dataclass(frozen=True)
class Rating:
    """A brain's rating, and the interval in which it lies with a probability of 95 %."""

    rating: float
    low: float
    high: float


def ratings(count: int, shares: Shares, seed: int, draws: int = DRAWS) -> list[Rating]:
    """The ratings of brains 0 to count - 1, whose mean is 0.

    `shares`: for a pair i < j what came of each seed: the points of i and those of j, 1 for a win and 1/2 for a tie.
    The same seed draws the same intervals.
    """
    import numpy as np

    chance = np.random.default_rng(seed % 2**32)
    points = np.zeros((1 + draws, count, count))  # the first as it was, the others as they might have been
    for (i, j), seen in shares.items():
        units, often = np.unique(np.array([*seen, (0.5, 0.5)]), axis=0, return_counts=True)
        weights = np.vstack([often, chance.gamma(often, size=(draws, len(units)))])  # equal units drawn together
        weights[1:] *= often.sum() / weights[1:].sum(axis=1, keepdims=True)
        points[:, i, j], points[:, j, i] = (weights @ units).T
    found = SCALE * likeliest(points)
    low, high = np.percentile(found[1:], (2.5, 97.5), axis=0)
    rows = zip(found[0], low, high, strict=True)
    return [Rating(*(round(float(x), 6) + 0.0 for x in row)) for row in rows]  # no -0.0


def likeliest(points: Any) -> Any:
    """The logarithms of the likeliest strengths, mean 0, shape (n, k), for `points` that i won against j, (n, i, j).

    Each pair must have met, and each have won something. Newton's method on a concave likelihood.
    """
    import numpy as np

    n, k, _ = points.shape
    met, won = points + points.transpose(0, 2, 1), points.sum(axis=2)
    strength = np.zeros((n, k))
    for _ in range(STEPS):
        share = 1.0 / (1.0 + np.exp(strength[:, None, :] - strength[:, :, None]))
        slope = won - (met * share).sum(axis=2)
        bend = -met * share * (1.0 - share)
        bend[:, range(k), range(k)] = -bend.sum(axis=2)
        move = np.linalg.solve(bend + 1.0 / k, slope[:, :, None])[:, :, 0]  # 1/k keeps the mean where it is
        longest = np.abs(move).max(axis=1, keepdims=True)
        strength += move * np.minimum(1.0, LONGEST / np.maximum(longest, SMALL))
        if longest.max() < SMALL:
            break
    return strength - strength.mean(axis=1, keepdims=True)
