"""Delay from commands to seen motion: the way that each wheel was commanded is correlated with the way that it rolled.

Ways are compared over BAND, so that slip and drift do not add up. Gain, friction and lag of the motors are fitted as
well, so that they are not mistaken for dead time; moments at which the robot was pushed or held count little.
"""

from collections.abc import Iterable, Sequence
from math import exp, inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.signals import Fix

STEP = 0.005  # s, resolution of the model
DELAYS = np.arange(60)  # search grid, in STEP; between its values by a parabola
LAGS = np.arange(0.05, 0.115, 0.01)  # s, search grid: time constants of motors
ANY_LAG = np.arange(0.02, 0.20, 0.01)  # s
USUAL_ECHO, USUAL_WAIT = 0.050, 0.015  # s, of a radio within the dead time of an unmeasured robot
BAND = 4  # fixes between the two ends of a way
FEWEST = 20  # fixes
OUTLIER = 3.0  # px, error of a way from which the robot was pushed or held
FITS = 2  # fits without outliers
UNSURE = 0.3  # share of the ways, in squares, that may stay unexplained
SURE = 0.004  # s, standard deviation of a measurement that counts
TINY = 1e-9  # against division by zero: of a wheel that stood

Floats = NDArray[np.float64]


class MotionDelay(NamedTuple):
    """The delay, s; its standard deviation, s: infinite if nothing was found; the time constant of the motors, s."""

    seconds: float
    error: float
    lag: float


class DriveTrace(NamedTuple):
    """What a robot was commanded, s and px/s of left and right wheel, and its fixes, by the camera's own stamps."""

    robot: int
    sent: Sequence[tuple[float, float, float]]
    seen: Sequence[Fix]
    base: float  # px between the wheels

    def delay(self) -> float | None:
        """Delay from commands to seen motion, s; None if the robot hardly drove."""
        found = motion_delay(self.sent, self.seen, self.base)
        return found.seconds if found.error < SURE else None


NONE = MotionDelay(0.0, inf, 0.0)


def motion_delay(
    sent: Sequence[tuple[float, float, float]], seen: Sequence[Fix], base: float, lags: Floats = LAGS
) -> MotionDelay:
    """The fit to the commanded speeds of left and right wheel (s, and any unit) and the fixes of a robot.

    `base`: px between the wheels.
    """
    if len(seen) < FEWEST or not sent:
        return NONE
    captured, ways = _rolled(seen, base)
    sent_at, *wheels = np.array(sent).T
    first = min(sent_at[0], captured[0]) - DELAYS[-1] * STEP
    place = (captured - first) / STEP
    latest = np.searchsorted(sent_at, np.arange(first, captured[-1] + STEP, STEP), side="right") - 1
    at = place.astype(int)[:, None] - DELAYS
    part = (place % 1.0)[:, None]
    costs = np.zeros((len(lags), len(DELAYS)))
    rolled = 0.0
    for way, wheel in zip(ways, wheels, strict=True):
        speeds = np.where(latest < 0, 0.0, wheel[latest])
        gone = way[BAND:] - way[:-BAND]
        rolled += float(gone @ gone)
        for cost, lag in zip(costs, lags, strict=True):
            cost += _unexplained(
                gone, *(_between(_low_pass(each, lag), at, part) for each in (speeds, np.sign(speeds)))
            )
    least = costs.min(axis=0)
    best = int(least.argmin())
    if not 0 < best < len(DELAYS) - 1 or least[best] > UNSURE * rolled:
        return NONE
    below, middle, above = least[best - 1 : best + 2].tolist()
    bend = max(below - 2.0 * middle + above, TINY)
    noise = middle * BAND / (2 * len(seen))
    return MotionDelay(
        STEP * (best + 0.5 * (below - above) / bend),
        STEP * float(np.sqrt(2.0 * noise / bend)),
        float(lags[costs[:, best].argmin()]),
    )


def common_delay(delays: Iterable[float], spread: float = 0.010) -> float:
    """Delay that these robots have in common, s: the mean of those within `spread` of the least; 0 without any."""
    found = sorted(delays)
    alike = [delay for delay in found if delay <= found[0] + spread]
    return sum(alike) / len(alike) if alike else 0.0


def network_delay(echo: float | None, wait: float, accounted: float = 0.0) -> float:
    """Delay of a command beyond the usual one, s, by the echo of the radio and by how long commands wait for it.

    `accounted`: s of it that the robot's dead time contains.
    """
    return max(0.0, 0.5 * ((echo or 0.0) - USUAL_ECHO) - accounted) + wait - USUAL_WAIT


def _rolled(seen: Sequence[Fix], base: float) -> tuple[Floats, tuple[Floats, Floats]]:
    """Times of the fixes, and how far the left and the right wheel had rolled by then, px."""
    _, x, y, heading, captured = np.array(seen).T
    heading = np.unwrap(heading)
    middle = 0.5 * (heading[1:] + heading[:-1])
    ahead = np.concatenate(((0.0,), np.cumsum(np.diff(x) * np.cos(middle) + np.diff(y) * np.sin(middle))))
    turned = 0.5 * base * heading
    return captured, (ahead + turned, ahead - turned)


def _between(speeds: Floats, at: NDArray[np.int64], part: Floats) -> Floats:
    """Ways at these speeds over BAND rows of `at`, indices into them, plus `part` of a step."""
    way = np.cumsum(speeds) * STEP
    reached = way[at] + part * STEP * speeds[np.minimum(at + 1, len(speeds) - 1)]
    return np.asarray(reached[BAND:] - reached[:-BAND])


def _unexplained(gone: Floats, way: Floats, signs: Floats) -> Floats:
    """Squares of the ways `gone` that no sum of both explains, for each column, outliers limited."""
    error, weights = gone[:, None], np.ones_like(way)
    for _ in range(FITS):
        a, b, c = (weights * way * way).sum(0), (weights * way * signs).sum(0), (weights * signs * signs).sum(0)
        p, q = gone @ (weights * way), gone @ (weights * signs)
        a, c = a * (1.0 + TINY) + TINY, c * (1.0 + TINY) + TINY
        area = a * c - b * b
        error = gone[:, None] - (c * p - b * q) / area * way - (a * q - b * p) / area * signs
        weights = (OUTLIER / np.maximum(OUTLIER, np.abs(error))) ** 2
    return np.asarray(np.minimum(error * error, OUTLIER * OUTLIER).sum(0))


def _low_pass(commanded: Floats, lag: float) -> Floats:
    """Response of first-order motors with this time constant, s."""
    decay = exp(-STEP / lag)
    response = (1.0 - decay) * decay ** np.arange(int(8.0 * lag / STEP) + 1)
    return np.asarray(np.convolve(commanded, response)[: len(commanded)])
