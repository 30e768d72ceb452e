"""Nonlinear least squares by Levenberg-Marquardt, with a numerical Jacobian, bounds and a robust Huber cost.

Damping scales the diagonal (D. W. Marquardt, 1963); residuals beyond `huber` count linearly (P. J. Huber, 1964).
"""

from collections.abc import Callable
from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

ITERATIONS = 60
STEP = 1e-6  # step of the forward differences, for parameters of the order of 1
TOLERANCE = 1e-12  # relative decrease of the cost below which the fit has converged
MAX_DAMPING = 1e8  # above it no step decreases the cost

Vector = NDArray[np.float64]


class Minimum(NamedTuple):
    """Parameters of least cost, (k,), and that cost: half the sum of squares if `huber` is infinite."""

    at: Vector
    cost: float


def least_squares(
    residuals_of: Callable[[Vector], Vector],
    start: Vector,
    iterations: int = ITERATIONS,
    steps: Vector | float = STEP,
    bounds: tuple[Vector, Vector] | None = None,
    huber: float = inf,
    tolerance: float = TOLERANCE,
) -> Minimum:
    """Minimise the cost of `residuals_of`, (k,) -> (n,), from `start` (k,), within `bounds`, lower and upper (k,).

    Residuals beyond `huber` count linearly; `steps` are those of the numerical Jacobian.
    """
    low, high = bounds or (np.full(len(start), -inf), np.full(len(start), inf))
    steps = np.full(len(start), steps) if isinstance(steps, float) else steps
    at, damping = np.clip(start, low, high), 1e-3
    residuals = residuals_of(at)
    cost = _cost(residuals, huber)
    for _ in range(iterations):
        weights = np.sqrt(np.minimum(1.0, huber / np.maximum(np.abs(residuals), 1e-9)))
        jacobian = _jacobian(residuals_of, at, residuals, steps, bounds) * weights[:, None]
        square, gradient = jacobian.T @ jacobian, jacobian.T @ (residuals * weights)
        while True:
            step = np.linalg.solve(square + damping * np.diag(np.diag(square) + 1e-12), -gradient)
            tried = np.clip(at + step, low, high)
            new_residuals = residuals_of(tried)
            lower = _cost(new_residuals, huber)
            if lower < cost or damping > MAX_DAMPING:
                break
            damping *= 10.0
        if not lower < cost:
            break
        done = cost - lower < tolerance * cost
        at, residuals, cost, damping = tried, new_residuals, lower, max(damping * 0.1, 1e-12)
        if done:
            break
    return Minimum(at, cost)


def _jacobian(
    residuals_of: Callable[[Vector], Vector],
    at: Vector,
    residuals: Vector,
    steps: Vector,
    bounds: tuple[Vector, Vector] | None,
) -> Vector:
    """The Jacobian by forward differences, (n, k)."""
    columns = []
    for i, step in enumerate(steps):
        shifted = at.copy()
        shifted[i] += step
        columns.append((residuals_of(shifted if bounds is None else np.clip(shifted, *bounds)) - residuals) / step)
    return np.stack(columns, axis=1)


def _cost(residuals: Vector, huber: float) -> float:
    if huber == inf:
        return 0.5 * float(residuals @ residuals)
    size = np.abs(residuals)
    return float(np.sum(np.where(size <= huber, 0.5 * size**2, huber * (size - 0.5 * huber))))
