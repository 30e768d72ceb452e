"""Nonlinear least squares by Levenberg-Marquardt, with a numerical Jacobian, bounds and a robust Huber cost.

Damping scales the diagonal (D. W. Marquardt, 1963); residuals beyond `huber` count linearly (P. J. Huber, 1964).
"""

from collections.abc import Callable
from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

ROUNDS = 60
NUDGE = 1e-6  # step of the forward differences, for parameters of the order of 1
SETTLED = 1e-12  # relative decrease of the cost below which the fit has converged
MAX_DAMPING = 1e8  # above it no step decreases the cost

Vector = NDArray[np.float64]


class Minimum(NamedTuple):
    """Parameters of least cost, (k,), and that cost: half the sum of squares if `huber` is infinite."""

    at: Vector
    cost: float


def least_squares(
    residual: Callable[[Vector], Vector],
    start: Vector,
    rounds: int = ROUNDS,
    nudges: Vector | float = NUDGE,
    bounds: tuple[Vector, Vector] | None = None,
    huber: float = inf,
    settled: float = SETTLED,
) -> Minimum:
    """Minimize the cost of `residual`, (k,) -> (n,), from `start` (k,), within `bounds` (lower and upper, each (k,)).

    Residuals beyond `huber` count linearly; `nudges` are the steps of the numerical Jacobian.
    """
    low, high = bounds or (np.full(len(start), -inf), np.full(len(start), inf))
    steps = np.full(len(start), nudges) if isinstance(nudges, float) else nudges
    at, damping = np.clip(start, low, high), 1e-3
    errors = residual(at)
    cost = _cost(errors, huber)
    for _ in range(rounds):
        weights = np.sqrt(np.minimum(1.0, huber / np.maximum(np.abs(errors), 1e-9)))
        slope = _jacobian(residual, at, errors, steps, bounds) * weights[:, None]
        square, pull = slope.T @ slope, slope.T @ (errors * weights)
        while True:
            step = np.linalg.solve(square + damping * np.diag(np.diag(square) + 1e-12), -pull)
            tried = np.clip(at + step, low, high)
            new_errors = residual(tried)
            lower = _cost(new_errors, huber)
            if lower < cost or damping > MAX_DAMPING:
                break
            damping *= 10.0
        if not lower < cost:
            break
        done = cost - lower < settled * cost
        at, errors, cost, damping = tried, new_errors, lower, max(damping * 0.1, 1e-12)
        if done:
            break
    return Minimum(at, cost)


def _jacobian(
    residual: Callable[[Vector], Vector],
    at: Vector,
    errors: Vector,
    nudges: Vector,
    bounds: tuple[Vector, Vector] | None,
) -> Vector:
    """The Jacobian by forward differences, (n, k)."""
    columns = []
    for i, nudge in enumerate(nudges):
        nudged = at.copy()
        nudged[i] += nudge
        columns.append((residual(nudged if bounds is None else np.clip(nudged, *bounds)) - errors) / nudge)
    return np.stack(columns, axis=1)


def _cost(errors: Vector, huber: float) -> float:
    if huber == inf:
        return 0.5 * float(errors @ errors)
    size = np.abs(errors)
    return float(np.sum(np.where(size <= huber, 0.5 * size**2, huber * (size - 0.5 * huber))))
