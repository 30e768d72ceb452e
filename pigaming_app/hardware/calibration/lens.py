"""How a lens bends straight lines: two radial coefficients, k1 and k2, round a centre.

A straight point u (in units of the picture's width, from the centre) is seen at u (1 + k1 r^2 + k2 r^4), r = |u|: the
radial part of Brown's model (D. C. Brown, 1966). With a homography behind it the unit of length is free, so the focal
length need not be known.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

ROUNDS = 6  # of Newton: to 1e-6 of the width for every lens that shows each point once

Points = NDArray[np.float64]  # (n, 2) px


@dataclass(frozen=True)
class Lens:
    """The lens of a camera with pictures of `size` px; `centre` of the bending in px, by default their middle."""

    size: tuple[int, int]
    k1: float = 0.0
    k2: float = 0.0
    centre: tuple[float, float] = (-1.0, -1.0)

    def __post_init__(self) -> None:
        if self.centre[0] < 0.0:
            object.__setattr__(self, "centre", ((self.size[0] - 1) / 2.0, (self.size[1] - 1) / 2.0))

    def bend(self, straight: Points) -> Points:
        """Where the camera sees straight points."""
        away = (straight - self.centre) / self.size[0]
        r2 = (away * away).sum(axis=1)
        grown = 1.0 + r2 * (self.k1 + r2 * self.k2)
        return np.asarray(self.centre + away * (grown * self.size[0])[:, None])

    def straighten(self, seen: Points) -> Points:
        """Where points that the camera sees would be without bending: the inverse of `bend`."""
        away = (seen - self.centre) / self.size[0]
        bent = np.sqrt((away * away).sum(axis=1))
        r = bent.copy()
        for _ in range(ROUNDS if self.k1 or self.k2 else 0):
            r2 = r * r
            slope = 1.0 + r2 * (3.0 * self.k1 + r2 * 5.0 * self.k2)
            r -= (r * (1.0 + r2 * (self.k1 + r2 * self.k2)) - bent) / np.maximum(slope, 0.05)
        share = np.divide(r, bent, out=np.ones_like(r), where=bent > 1e-9)
        return np.asarray(self.centre + away * (share * self.size[0])[:, None])
