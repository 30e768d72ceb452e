"""ArUco markers in a picture: whom they belong to and where their corners are, to a fraction of a pixel.

Looking at small regions costs a fraction of looking at a whole picture; where to look, and how often everywhere, is
the tracker's to say.
"""

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.signals import Image, Mark

ROBOT_IDS = (0, 1, 2, 3)
CORNER_IDS = (10, 11, 12, 13)  # projected in the margins of the canvas, see `drift`


class NoVision(Exception):
    """There is no OpenCV; the text is one sentence for the operator."""


class Region(NamedTuple):
    """A part of a picture, px; right and bottom are outside."""

    left: int
    top: int
    right: int
    bottom: int


class Markers:
    """Finds the markers with these ids in pictures. Raises NoVision where OpenCV is missing."""

    def __init__(self, ids: Iterable[int] = ROBOT_IDS) -> None:
        self.ids = frozenset(ids)
        self._cv = opencv()
        self._everywhere = self._detector(3, 23, 10)
        self._nearby = self._detector(15, 15, 1)

    def find(self, image: Image, regions: Sequence[Region] | None = None) -> list[Mark]:
        """The known markers in the regions, or in the whole picture. A number may come twice: that is for the caller
        to judge; the same marker in two regions comes once."""
        if regions is None:
            return self._look(self._everywhere, image, 0, 0)
        found: list[Mark] = []
        for region in regions:
            part = image[region.top : region.bottom, region.left : region.right]
            if min(part.shape) < 16:
                continue
            for mark in self._look(self._nearby, part, region.left, region.top):
                if not any(_same(mark, other) for other in found):
                    found.append(mark)
        return found

    def _look(self, detector: Any, image: Image, left: int, top: int) -> list[Mark]:
        corners, ids = listed(*detector.detectMarkers(np.ascontiguousarray(image))[:2])
        origin = np.array((left, top))
        return [
            Mark(int(number), corner + origin)
            for number, corner in zip(ids, corners, strict=True)
            if int(number) in self.ids
        ]

    def _detector(self, smallest: int, largest: int, step: int) -> Any:
        aruco = self._cv.aruco
        wanted = aruco.DetectorParameters()
        wanted.adaptiveThreshWinSizeMin, wanted.adaptiveThreshWinSizeMax = smallest, largest
        wanted.adaptiveThreshWinSizeStep = step
        wanted.cornerRefinementMethod = aruco.CORNER_REFINE_SUBPIX
        return aruco.ArucoDetector(aruco.getPredefinedDictionary(aruco.DICT_4X4_50), wanted)


def opencv() -> Any:
    """The module cv2. Raises NoVision."""
    try:
        import cv2
    except ImportError as error:
        raise NoVision(
            f"OpenCV is not installed ({error}), so no camera can be used: install opencv-python-headless."
        ) from error
    return cv2


def listed(corners: Any, ids: Any) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """What any OpenCV from 4.7 to 5 answers, in one shape: (n, 4, 2) and (n,)."""
    numbers = np.zeros(0, np.int64) if ids is None else np.asarray(ids, np.int64).reshape(-1)
    if not len(numbers):
        return np.zeros((0, 4, 2)), numbers
    return np.asarray(corners, np.float64).reshape(-1, 4, 2), numbers


def _same(mark: Mark, other: Mark) -> bool:
    """Whether two finds are one marker, seen in two regions that overlap."""
    return mark.number == other.number and bool(np.abs(mark.corners - other.corners).max() < 3.0)
