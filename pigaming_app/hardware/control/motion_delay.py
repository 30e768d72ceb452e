"""Delay from commands to seen motion: the way that the wheels were commanded is correlated with the seen heading.

The lag of the motors is fitted as well, so that it is not mistaken for dead time.
"""

from collections.abc import Iterable, Sequence
from math import exp
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

STEP = 0.005  # s, resolution of the model
DELAYS = np.arange(0.0, 0.30, 0.005)  # s, search grid; between its values by a parabola
TINY = 1e-9  # against division by zero: of wheels that turn alike
LAGS = np.arange(0.02, 0.20, 0.01)  # s, search grid
USUAL_ECHO = 0.050  # s, of a radio within the dead time of an unmeasured robot
USUAL_LAGS = np.arange(0.05, 0.115, 0.01)  # s

Floats = NDArray[np.float64]


class MotionDelay(NamedTuple):
    """The delay, s; the time constant of the motors, s; what is left unexplained, rad RMS."""

    seconds: float
    lag: float
    residual: float


def motion_delay(
    sent: Sequence[tuple[float, float, float]], seen: Sequence[tuple[float, float]], lags: Floats = LAGS
) -> MotionDelay:
    """The fit to the commanded speeds of left and right wheel (s, and any unit) and seen headings (s, rad)."""
    sent_at, *wheels = np.array(sent).T
    captured, headings = np.array(seen).T
    grid = np.arange(sent_at[0], captured[-1] + STEP, STEP)
    latest = np.maximum(np.searchsorted(sent_at, grid, side="right") - 1, 0)
    headings = np.unwrap(headings)
    headings = headings - headings.mean()
    times, best = captured[:, None] - DELAYS, (np.inf, 0.0, 0.0)
    for lag in lags:
        ways = [np.interp(times, grid, np.cumsum(_low_pass(wheel[latest], float(lag))) * STEP) for wheel in wheels]
        costs = _unexplained(headings, *(way - way.mean(axis=0) for way in ways))
        best = min(best, (*_lowest(costs), float(lag)))
    return MotionDelay(best[1], best[2], float(np.sqrt(max(0.0, best[0]) / len(headings))))


def common_delay(delays: Iterable[float], spread: float = 0.010) -> float:
    """Delay that these robots have in common, s: the mean of those within `spread` of the least; 0 without any."""
    found = sorted(delays)
    alike = [delay for delay in found if delay <= found[0] + spread]
    return sum(alike) / len(alike) if alike else 0.0


def network_delay(echo: float | None) -> float:
    """Delay of a command in a slow network beyond the usual one, s, by the echo of the radio."""
    return max(0.0, 0.5 * ((echo or 0.0) - USUAL_ECHO))


def _unexplained(headings: Floats, left: Floats, right: Floats) -> Floats:
    """Squares of the headings that no sum of both ways explains, for each column of them."""
    a, b, c = (left * left).sum(axis=0), (left * right).sum(axis=0), (right * right).sum(axis=0)
    p, q = headings @ left, headings @ right
    a, c = a * (1.0 + TINY) + TINY, c * (1.0 + TINY) + TINY
    return np.asarray(headings @ headings - (c * p * p - 2.0 * b * p * q + a * q * q) / (a * c - b * b))


def _lowest(costs: Floats) -> tuple[float, float]:
    """The lowest cost and its delay, s, by a parabola through the lowest values."""
    i = int(costs.argmin())
    if not 0 < i < len(costs) - 1:
        return float(costs[i]), float(DELAYS[i])
    below, middle, above = costs[i - 1 : i + 2].tolist()
    bend = max(below - 2.0 * middle + above, 1e-12)
    return middle, float(DELAYS[i]) + 0.5 * float(DELAYS[1]) * (below - above) / bend


def _low_pass(commanded: Floats, lag: float) -> Floats:
    """Response of first-order motors with this time constant, s."""
    decay = exp(-STEP / lag)
    response = (1.0 - decay) * decay ** np.arange(int(8.0 * lag / STEP) + 1)
    return np.asarray(np.convolve(commanded, response)[: len(commanded)])
