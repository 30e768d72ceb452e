"""Strength ratings from pairwise results after Bradley and Terry, with confidence intervals.

A brain of strength s beats one of strength t with probability s / (s + t) (Biometrika 39, 1952, 324-345). A tie counts
as half a win for each. Ratings are 400 log10 s with mean 0, the scale of chess: a lead of 100 points means 64 wins in
100, 200 points 76, 400 points 91.

Every pair gets one fictitious tie as a prior, so that a brain that won every match still has a finite rating. The
intervals are a Bayesian bootstrap (Rubin, Ann. Stat. 9, 1981, 130-134) with random weights on each seed's result, from
both sides, and on the prior.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import log
from typing import Any

DRAWS = 2000  # bootstrap replicates
SCALE = 400.0 / log(10.0)  # points per factor of e in strength
STEPS, LONGEST = 100, 2.0  # Newton's method: iteration limit, and step limit in factors of e
SMALL = 1e-9  # step size at convergence

Shares = Mapping[tuple[int, int], Sequence[tuple[float, float]]]


@dataclass(frozen=True)
class Rating:
    """A brain's rating and its 95 % interval, in points."""

    rating: float
    low: float
    high: float


def ratings(count: int, shares: Shares, seed: int, draws: int = DRAWS) -> list[Rating]:
    """Ratings of brains 0 to count - 1, with mean 0.

    `shares`: for each pair i < j, the points of i and of j under each seed, 1 for a win and 1/2 for a tie. Equal seeds
    draw equal intervals.
    """
    import numpy as np

    rng = np.random.default_rng(seed % 2**32)
    points = np.zeros((1 + draws, count, count))  # row 0: as observed; the others: bootstrap replicates
    for (i, j), results in shares.items():
        units, counts = np.unique(np.array([*results, (0.5, 0.5)]), axis=0, return_counts=True)
        weights = np.vstack([counts, rng.gamma(counts, size=(draws, len(units)))])  # equal units drawn together
        weights[1:] *= counts.sum() / weights[1:].sum(axis=1, keepdims=True)
        points[:, i, j], points[:, j, i] = (weights @ units).T
    estimates = SCALE * likeliest(points)
    low, high = np.percentile(estimates[1:], (2.5, 97.5), axis=0)
    rows = zip(estimates[0], low, high, strict=True)
    return [Rating(*(round(float(x), 6) + 0.0 for x in row)) for row in rows]  # no -0.0


def likeliest(points: Any) -> Any:
    """Maximum-likelihood log strengths with mean 0, shape (n, k), from the points of i against j, shape (n, k, k).

    Each pair must have met and each brain must have won something. Newton's method on a concave likelihood.
    """
    import numpy as np

    n, k, _ = points.shape
    met, won = points + points.transpose(0, 2, 1), points.sum(axis=2)
    strength = np.zeros((n, k))
    for _ in range(STEPS):
        share = 1.0 / (1.0 + np.exp(strength[:, None, :] - strength[:, :, None]))
        gradient = won - (met * share).sum(axis=2)
        hessian = -met * share * (1.0 - share)  # negated, as the step needs it
        hessian[:, range(k), range(k)] = -hessian.sum(axis=2)
        step = np.linalg.solve(hessian + 1.0 / k, gradient[:, :, None])[:, :, 0]  # 1/k preserves the mean
        longest = np.abs(step).max(axis=1, keepdims=True)
        strength += step * np.minimum(1.0, LONGEST / np.maximum(longest, SMALL))
        if longest.max() < SMALL:
            break
    return strength - strength.mean(axis=1, keepdims=True)
