"""Lens distortion: two radial coefficients, k1 and k2, about a centre.

An undistorted point u (from the centre, in units of the picture's width) appears at u (1 + k1 r^2 + k2 r^4), r = |u|:
the radial part of Brown's model (D. C. Brown, 1966). Combined with a homography the unit of length is free, so the
focal length is not needed.
"""

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from pigaming_app.storage.schema import between

ROUNDS = 6  # of Newton's method: to 1e-6 of the width for every lens that maps each point once

Points = NDArray[np.float64]  # (n, 2) px
Side = Annotated[int, between(16, 16_384)]  # px
Centre = Annotated[float, between(0.0, 16_384.0)]  # px
Coefficient = Annotated[float, between(-1e6, 1e6)]


@dataclass(frozen=True)
class Lens:
    """Radial distortion of pictures of `size` px; `centre` in px, by default their middle."""

    size: tuple[Side, Side]
    k1: Coefficient = 0.0
    k2: Coefficient = 0.0
    centre: tuple[Centre, Centre] = (-1.0, -1.0)

    def __post_init__(self) -> None:
        if self.centre[0] < 0.0:
            object.__setattr__(self, "centre", ((self.size[0] - 1) / 2.0, (self.size[1] - 1) / 2.0))

    def distort(self, straight: Points) -> Points:
        """Distort points, (n, 2) px."""
        away = (straight - self.centre) / self.size[0]
        r2 = (away * away).sum(axis=1)
        grown = 1.0 + r2 * (self.k1 + r2 * self.k2)
        return np.asarray(self.centre + away * (grown * self.size[0])[:, None])

    def undistort(self, seen: Points) -> Points:
        """Undistort points, (n, 2) px: the inverse of `bend`, by Newton's method."""
        away = (seen - self.centre) / self.size[0]
        bent = np.sqrt((away * away).sum(axis=1))
        r = bent.copy()
        for _ in range(ROUNDS if self.k1 or self.k2 else 0):
            r2 = r * r
            slope = 1.0 + r2 * (3.0 * self.k1 + r2 * 5.0 * self.k2)
            r -= (r * (1.0 + r2 * (self.k1 + r2 * self.k2)) - bent) / np.maximum(slope, 0.05)
        share = np.divide(r, bent, out=np.ones_like(r), where=bent > 1e-9)
        return np.asarray(self.centre + away * (share * self.size[0])[:, None])
