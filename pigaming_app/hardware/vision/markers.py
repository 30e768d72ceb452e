"""ArUco markers in a picture: whose they are and where.

Looking near where a marker must be costs a tenth of a millisecond, looking through a small copy of the whole picture
twenty times that, and through all of it in every way two hundred times: which and when is the tracker's to say.
"""

import os
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.messages import OperatorError, OperatorMessage
from pigaming_app.hardware.signals import DetectedMarker, Image
from pigaming_app.hardware.vision.subpixel import refined

ROBOT_IDS = (0, 1, 2, 3)
CORNER_IDS = (10, 11, 12, 13)  # projected in the margins of the canvas, see `drift`
READABLE = 23.0  # px of an edge down to which a marker is shrunk for a quick look (HARDWARE.md: 96 % from 22, 52 at 14)
SMALLEST = 0.5  # scale of a quick look's picture: below, noise is no longer averaged
DIM, LIFT = 60.0, 6.0  # what is darker is lifted to that, by so much at most: OpenCV thresholds in absolute greys
SHARPER = 2.5
PLENTY = 30.0  # px of an edge that are enough anywhere
NARROW, WIDE = 0.6, 1.6  # an edge is this much of what is expected, at least and at most
NEAR, FAR = 1.3, 1.6  # what is brighter than so many medians of a region, or of a picture, is dimmed to that
QUIETLY = {
    "OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT": "1",  # s that a dead camera holds up its reader
    "OPENCV_VIDEOIO_MSMF_ENABLE_HW_TRANSFORMS": "0",  # which take half a minute to open a camera on Windows
    "OPENCV_LOG_LEVEL": "ERROR",
}


class OpenCVMissing(OperatorError):
    """There is no OpenCV."""


class SearchWindow(NamedTuple):
    """A square of a picture in which to look, px, and the edge of the marker that is expected there."""

    x: float  # the middle
    y: float
    half: float
    edge: float


class MarkerDetector:
    """Finds the markers with these ids. Raises OpenCVMissing where OpenCV is missing.

    Their corners are right to a pixel or two before `exact`. A number may come twice from every method but `near`: that
    is for the caller to judge.
    """

    def __init__(self, ids: Iterable[int]) -> None:
        self.ids = frozenset(ids)
        self._cv = opencv()
        self._detectors: dict[tuple[tuple[int, int], float, float], Any] = {}

    def everywhere(self, image: Image) -> list[DetectedMarker]:
        """All that can be found in the whole picture, in three ways: slow and thorough."""
        return self._look(self._detector((3, 23), 0.03, 4.0), image)

    def glance(
        self, image: Image, edge: float, known: Sequence[DetectedMarker] = (), dim: bool = True
    ) -> list[DetectedMarker]:
        """What is found in a small copy of the whole picture, if edges are about so many px, besides what is known.

        `dim`: look past what is projected across markers; without, past a mat as dark as their black.
        """
        scale, rate = max(SMALLEST, READABLE / edge), 4.0 * edge / max(image.shape)
        if scale > 0.9:
            scale, small = 1.0, image
        else:
            small = self._cv.resize(image, None, fx=scale, fy=scale, interpolation=self._cv.INTER_LINEAR)
        detector = self._detector((9, 9), NARROW * rate, WIDE * rate)
        found = []
        for mark in self._look(detector, self._dimmed(small, FAR) if dim else small):
            rough = DetectedMarker(mark.number, (mark.corners + 0.5) / scale - 0.5)
            if not same(rough, known):
                x, y = rough.corners.mean(axis=0).tolist()
                found.append(self.near(image, SearchWindow(x, y, 1.5 * edge, edge), mark.number))
        return [mark for mark in found if mark is not None]

    def near(self, image: Image, spot: SearchWindow, number: int) -> DetectedMarker | None:
        """The marker with this number in a square of the picture; a large one is looked for in a smaller copy."""
        left, top = max(0, round(spot.x - spot.half)), max(0, round(spot.y - spot.half))
        part = image[top : max(0, round(spot.y + spot.half)), left : max(0, round(spot.x + spot.half))]
        if min(part.shape) < 2.0 * spot.edge * NARROW:
            return None
        rate, fold = 4.0 * spot.edge / max(part.shape), max(1, int(spot.edge / PLENTY))
        if fold > 1:
            part = self._cv.resize(part, None, fx=1.0 / fold, fy=1.0 / fold, interpolation=self._cv.INTER_AREA)
        edge = spot.edge / fold
        window = max(5, round(edge / 3.0) | 1)
        for i, windows in enumerate(((window, window), (window, window), (3, 3 * window))):
            picture = part if i == 2 else self._dimmed(part if i == 0 else self._sharp(part, edge), NEAR)
            for mark in self._look(self._detector(windows, NARROW * rate, WIDE * rate), picture):
                if mark.number == number:
                    return DetectedMarker(number, (mark.corners + 0.5) * fold - 0.5 + np.array((left, top)))
        return None

    def exact(self, image: Image, marks: Sequence[DetectedMarker]) -> list[DetectedMarker]:
        """The same markers with their corners right to a few hundredths of a pixel."""
        found, _ = refined(self._cv, image, _stacked(marks))
        return [DetectedMarker(mark.number, corner) for mark, corner in zip(marks, found, strict=True)]

    def still(self, image: Image, marks: Sequence[DetectedMarker]) -> list[DetectedMarker]:
        """Those of the markers that are within a few pixels of where they were, exactly. Whose they are is not read."""
        found, well = refined(self._cv, image, _stacked(marks))
        return [DetectedMarker(mark.number, corner) for mark, corner, ok in zip(marks, found, well, strict=True) if ok]

    def _dimmed(self, image: Image, medians: float) -> Image:
        """The picture with nothing in it brighter than so many of its medians; lifted if that is dark.

        What is projected across a marker draws edges on it, but nothing is darker than its black.
        """
        sample = image[::4, ::4].reshape(-1)
        middle = float(np.partition(sample, sample.size // 2)[sample.size // 2])
        top = min(255.0, medians * middle)
        cut = self._cv.min(image, top)
        return np.asarray(cut if top > DIM else self._cv.convertScaleAbs(cut, alpha=min(DIM / max(top, 1.0), LIFT)))

    def _sharp(self, part: Image, edge: float) -> Image:
        """Against motion and a lens out of focus: more of what is finer than a twelfth of a marker."""
        soft = self._cv.GaussianBlur(part, (0, 0), edge / 12.0)
        return np.asarray(self._cv.addWeighted(part, 1.0 + SHARPER, soft, -SHARPER, 0.0))

    def _look(self, detector: Any, image: Image) -> list[DetectedMarker]:
        corners, ids = listed(*detector.detectMarkers(np.ascontiguousarray(image))[:2])
        pairs = zip(ids.tolist(), corners, strict=True)
        return [DetectedMarker(number, corner) for number, corner in pairs if number in self.ids]

    def _detector(self, windows: tuple[int, int], smallest: float, largest: float) -> Any:
        """One that thresholds with one window or three; perimeters as shares of the picture's longer side."""
        smallest, largest = round(smallest, 2), round(largest, 2)
        key = (windows, smallest, largest)
        if key not in self._detectors:
            aruco = self._cv.aruco
            wanted = aruco.DetectorParameters()
            wanted.adaptiveThreshWinSizeMin, wanted.adaptiveThreshWinSizeMax = windows
            wanted.adaptiveThreshWinSizeStep = max(1, (windows[1] - windows[0]) // 2)
            wanted.minMarkerPerimeterRate, wanted.maxMarkerPerimeterRate = smallest, largest
            self._detectors[key] = aruco.ArucoDetector(aruco.getPredefinedDictionary(aruco.DICT_4X4_50), wanted)
        return self._detectors[key]


def _stacked(marks: Sequence[DetectedMarker]) -> NDArray[np.float64]:
    """The corners of all, (n, 4, 2)."""
    return np.array([mark.corners for mark in marks]).reshape(-1, 4, 2)


def same(mark: DetectedMarker, known: Sequence[DetectedMarker]) -> bool:
    """Whether a marker is one of those that are known: the middles are nearer than half an edge."""
    for other in known:
        away = mark.corners.mean(axis=0) - other.corners.mean(axis=0)
        if mark.number == other.number and float(away @ away) < 0.25 * mean_edge(mark.corners) ** 2:
            return True
    return False


def mean_edge(corners: NDArray[np.float64]) -> float:
    """The mean edge of a quadrangle (4, 2)."""
    sides = corners - np.roll(corners, 1, axis=0)
    return float(np.sqrt((sides * sides).sum(axis=1)).mean())


def opencv() -> Any:
    """The module cv2, told before its import what it reads only then. Raises OpenCVMissing."""
    for name, value in QUIETLY.items():
        os.environ.setdefault(name, value)
    try:
        import cv2
    except ImportError as error:
        raise OpenCVMissing(OperatorMessage("no_opencv")) from error
    return cv2


def listed(corners: Any, ids: Any) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """What any OpenCV from 4.7 to 5 answers, in one shape: (n, 4, 2) and (n,)."""
    numbers = np.zeros(0, np.int64) if ids is None else np.asarray(ids, np.int64).reshape(-1)
    if not len(numbers):
        return np.zeros((0, 4, 2)), numbers
    return np.asarray(corners, np.float64).reshape(-1, 4, 2), numbers
