"""Corner pin: a perspective warp of the picture into a quadrangle, for a projector that hangs askew over the mat, or
shines on it by a mirror: a quadrangle that runs the other way round turns the picture over.

OpenCV warps with the nearest pixel: 3 to 4 ms for 1920 x 1080. Corners are the targets of the picture's corners in
canvas px, top left first, clockwise unless the picture is turned over.
"""

from collections.abc import Sequence
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.ground_plane import project
from pigaming_app.hardware.calibration.solver import homography
from pigaming_app.hardware.vision.markers import opencv
from pigaming_app.storage.messages import OperatorError, OperatorMessage

CANVAS = (1920, 1080)
STRAIGHT = (0.0, 0.0, 1920.0, 0.0, 1920.0, 1080.0, 0.0, 1080.0)
MIN_SIDE = 0.2  # of the canvas's sides; smaller is unplayable

Pixels = NDArray[np.uint8]  # (height, width, 4)


def is_degenerate(corners: Sequence[float]) -> bool:
    """True if no picture fits these corners: they cross, are nearly collinear, or leave it tiny."""
    if len(corners) != 8 or not all(isfinite(value) for value in corners):
        return True
    points = np.array(corners, dtype=np.float64).reshape(4, 2)
    sides = np.roll(points, -1, axis=0) - points
    after = np.roll(sides, -1, axis=0)
    turns = sides[:, 0] * after[:, 1] - sides[:, 1] * after[:, 0]
    turns *= np.sign(turns.sum())
    return bool(turns.min() < MIN_SIDE * CANVAS[0] * MIN_SIDE * CANVAS[1])


def turned_over(corners: Sequence[float]) -> tuple[float, ...]:
    """These corners left for right, as for a mirror; empty ones are STRAIGHT."""
    return tuple(value if i % 2 else CANVAS[0] - value for i, value in enumerate(corners or STRAIGHT))


def is_turned_over(corners: Sequence[float]) -> bool:
    """True if these corners turn the picture over."""
    return bool(corners) and corners[0] > corners[2]


def pin_of(corners: Sequence[float]) -> "CornerPin | None":
    """The pin for these corners; None if they are straight. Raises OperatorError or OpenCVMissing."""
    return None if tuple(corners) == STRAIGHT else CornerPin(corners)


class CornerPin:
    """A corner pin for windows of any size. Raises OperatorError or OpenCVMissing."""

    def __init__(self, corners: Sequence[float]) -> None:
        if is_degenerate(corners):
            raise OperatorError(OperatorMessage("corners"))
        opencv()
        self.corners = tuple(corners)

    def fit(self, size: tuple[int, int]) -> "PerspectiveWarp":
        """The warp for a window of `size` px."""
        return PerspectiveWarp(self.corners, size)


class PerspectiveWarp:
    """The warp of the canvas into these corners in a window of `size` px. Raises OpenCVMissing."""

    def __init__(self, corners: Sequence[float], size: tuple[int, int] = CANVAS) -> None:
        self._cv = opencv()
        self.size = size
        grown = np.array((size[0] / CANVAS[0], size[1] / CANVAS[1]))
        target = np.array(corners, dtype=np.float64).reshape(4, 2) * grown
        self._matrix = homography(np.array(STRAIGHT).reshape(4, 2), target)  # between pixel edges
        middle, edge = np.eye(3), np.eye(3)  # OpenCV counts from pixel centres
        middle[:2, 2], edge[:2, 2] = 0.5, -0.5
        self._pixels = edge @ self._matrix @ middle

    def apply(self, picture: Pixels) -> Pixels:
        """The whole window with the canvas's picture in it, black outside the corners. Both (height, width, 4)."""
        warped = self._cv.warpPerspective(picture, self._pixels, self.size, flags=self._cv.INTER_NEAREST)
        return np.asarray(warped, np.uint8)

    def to_canvas(self, at: tuple[float, float]) -> tuple[float, float]:
        """The canvas point under a window point, px: the inverse of the warp."""
        there = np.linalg.inv(self._matrix).astype(np.float64)
        x, y = project(there, np.array([at], dtype=np.float64))[0].tolist()
        return x, y
