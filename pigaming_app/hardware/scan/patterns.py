"""The 14 pictures of a scan: white, black, and sine fringes across both axes in two periods and three phases.

The coarse period is longer than any displacement by a thing's height, the fine one measures it (three-step phase
shifting with two-frequency unwrapping; S. Zhang, Optics and Lasers in Engineering 48, 2010).
"""

from math import pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.boards import CANVAS, LIGHT
from pigaming_app.hardware.signals import Image

STEPS = 3
PERIODS = (
    (160.0, 32.0),
    (180.0, 36.0),
)  # canvas px, coarse and fine, across x and y: whole numbers of them on the canvas


class Fringes(NamedTuple):
    """One set of fringes: 0: across x, 1: across y; the period in canvas px."""

    axis: int
    period: float


class Pattern(NamedTuple):
    """A picture to project: a uniform `level`, or step 0 to 2 of a set of fringes."""

    level: float = 0.0  # share of LIGHT
    fringes: Fringes | None = None
    step: int = 0

    def picture(self) -> Image:
        """The picture, (1080, 1920) grey."""
        if self.fringes is None:
            return np.full((CANVAS[1], CANVAS[0]), round(LIGHT * self.level), np.uint8)
        axis, period = self.fringes
        at = np.arange(CANVAS[axis])
        wave = 0.5 + 0.5 * np.cos(2.0 * pi * (at / period - self.step / STEPS))
        line = np.rint(LIGHT * wave).astype(np.uint8)
        return np.ascontiguousarray(np.broadcast_to(line if axis == 0 else line[:, None], (CANVAS[1], CANVAS[0])))


SETS = tuple(Fringes(axis, period) for axis in (0, 1) for period in PERIODS[axis])  # coarse x, fine x, coarse y, fine y
WHITE, BLACK = Pattern(1.0), Pattern(0.0)
PATTERNS = (WHITE, BLACK, *(Pattern(0.0, fringes, step) for fringes in SETS for step in range(STEPS)))


def flat_phase(fringes: Fringes, start: float, count: int) -> NDArray[np.float32]:
    """Phase on the flat mat at `count` canvas px from `start` on along the axis of these fringes, rad."""
    return np.asarray(2.0 * pi / fringes.period * (start + np.arange(count)), dtype=np.float32)
