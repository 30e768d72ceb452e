"""Detection of ArUco markers in camera images: ids and corners.

A search near a predicted position takes about 0.1 ms, a search of the downscaled image 20 times that, and the thorough
search 200 times. The tracker decides when to run which.
"""

import os
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.signals import DetectedMarker, Image
from pigaming_app.hardware.vision.subpixel import refined
from pigaming_app.storage.messages import OperatorError, OperatorMessage

ROBOT_IDS = (16, 17, 43, 45)  # of the robots 0 to 3: those missed least of all that blocks and corners leave free
WEARERS = {number: robot for robot, number in enumerate(ROBOT_IDS)}
CORNER_IDS = (10, 11, 12, 13)  # projected in the margins of the canvas, see `drift`, or printed
RIM_IDS = (14, 15, 18)  # printed between those
CELLS = 6  # of a marker with its black border, without the quiet zone
READABLE = 23.0  # px of a marker's edge in a downscaled image: 96 % are detected from 22 px, 52 % at 14 px
SMALLEST = 0.5  # lowest scale of a downscaled image; below, noise is no longer averaged
DIM, LIFT = (
    60.0,
    6.0,
)  # darker images are scaled up to this grey, by this factor at most: OpenCV's threshold is absolute
SHARPER = 2.5  # gain of the unsharp mask
PLENTY = 30.0  # px of a marker's edge that always suffice; larger markers are downscaled
NARROW, WIDE = 0.6, 1.6  # bounds of an edge, as shares of the expected one
NEAR, FAR = 1.3, 1.6  # clipping level in medians of a search window, and of a whole image
QUIETLY = {
    "OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT": "1",  # s for which a dead camera blocks its reader
    "OPENCV_VIDEOIO_MSMF_ENABLE_HW_TRANSFORMS": "0",  # they delay opening a camera by half a minute on Windows
    "OPENCV_LOG_LEVEL": "ERROR",
}


class OpenCVMissing(OperatorError):
    """OpenCV is not installed."""


class SearchWindow(NamedTuple):
    """A square region of an image to search, and the expected edge of the marker, px."""

    x: float  # centre
    y: float
    half: float
    edge: float


def window_around(mark: DetectedMarker, reach: float) -> SearchWindow:
    """The window to search for a marker that moves little; `reach`: half its width, in edges."""
    (x, y), edge = mark.corners.mean(axis=0).tolist(), mean_edge(mark.corners)
    return SearchWindow(x, y, reach * edge, edge)


class MarkerDetector:
    """Detector of the markers with these ids. Raises OpenCVMissing.

    Corners are accurate to 1-2 px before `refine`. Every method but `detect_in` may return the same id twice;
    the caller decides how to treat duplicates.
    """

    def __init__(self, ids: Iterable[int]) -> None:
        self.ids = frozenset(ids)
        self._cv = opencv()
        self._detectors: dict[tuple[tuple[int, int], float, float], Any] = {}

    def detect(self, image: Image) -> list[DetectedMarker]:
        """All markers in the whole image, by three threshold windows: thorough and slow."""
        return self._look(self._detector((3, 23), 0.03, 4.0), image)

    def detect_quickly(
        self, image: Image, edge: float, known: Sequence[DetectedMarker] = (), dim: bool = True
    ) -> list[DetectedMarker]:
        """Markers in the downscaled image that are not in `known`. `edge`: expected edge in the full image, px.

        `dim`: clip bright projections across markers; without it, markers on a mat as dark as their black are found.
        """
        scale, rate = max(SMALLEST, READABLE / edge), 4.0 * edge / max(image.shape)
        if scale > 0.9:
            scale, small = 1.0, image
        else:
            small = self._cv.resize(image, None, fx=scale, fy=scale, interpolation=self._cv.INTER_LINEAR)
        detector = self._detector((9, 9), NARROW * rate, WIDE * rate)
        marks = []
        for mark in self._look(detector, self._dimmed(small, FAR) if dim else small):
            rough = DetectedMarker(mark.number, (mark.corners + 0.5) / scale - 0.5)
            if not is_known(rough, known):
                x, y = rough.corners.mean(axis=0).tolist()
                marks.append(self.detect_in(image, SearchWindow(x, y, 1.5 * edge, edge), mark.number))
        return [mark for mark in marks if mark is not None]

    def detect_in(self, image: Image, spot: SearchWindow, number: int) -> DetectedMarker | None:
        """The marker with this id in the search window, or None; large markers are downscaled first."""
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
                    return DetectedMarker(mark.number, (mark.corners + 0.5) * fold - 0.5 + np.array((left, top)))
        return None

    def refine(self, image: Image, marks: Sequence[DetectedMarker]) -> list[DetectedMarker]:
        """The same markers with corners accurate to a few hundredths of a pixel."""
        corners, _ = refined(self._cv, image, _stacked(marks))
        return [DetectedMarker(mark.number, corner) for mark, corner in zip(marks, corners, strict=True)]

    def recheck(self, image: Image, marks: Sequence[DetectedMarker]) -> list[DetectedMarker]:
        """Markers still within a few px of these positions, with exact corners; their ids are not read again."""
        corners, valid = refined(self._cv, image, _stacked(marks))
        return [
            DetectedMarker(mark.number, corner) for mark, corner, ok in zip(marks, corners, valid, strict=True) if ok
        ]

    def _dimmed(self, image: Image, medians: float) -> Image:
        """The image clipped at this multiple of its median grey, and scaled up if that is dark.

        Projected light draws false edges across a marker but never makes anything darker than its black.
        """
        sample = image[::4, ::4].reshape(-1)
        middle = float(np.partition(sample, sample.size // 2)[sample.size // 2])
        top = min(255.0, medians * middle)
        cut = self._cv.min(image, top)
        return np.asarray(cut if top > DIM else self._cv.convertScaleAbs(cut, alpha=min(DIM / max(top, 1.0), LIFT)))

    def _sharp(self, part: Image, edge: float) -> Image:
        """Unsharp mask against motion blur and defocus, with a radius of a twelfth of a marker."""
        soft = self._cv.GaussianBlur(part, (0, 0), edge / 12.0)
        return np.asarray(self._cv.addWeighted(part, 1.0 + SHARPER, soft, -SHARPER, 0.0))

    def _look(self, detector: Any, image: Image) -> list[DetectedMarker]:
        corners, ids = detections(*detector.detectMarkers(np.ascontiguousarray(image))[:2])
        pairs = zip(ids.tolist(), corners, strict=True)
        return [DetectedMarker(number, corner) for number, corner in pairs if number in self.ids]

    def _detector(self, windows: tuple[int, int], smallest: float, largest: float) -> Any:
        """A cached OpenCV detector. `windows`: threshold windows, px; perimeters as shares of the longer image side."""
        smallest, largest = round(smallest, 2), round(largest, 2)
        key = (windows, smallest, largest)
        if key not in self._detectors:
            aruco = self._cv.aruco
            parameters = aruco.DetectorParameters()
            parameters.adaptiveThreshWinSizeMin, parameters.adaptiveThreshWinSizeMax = windows
            parameters.adaptiveThreshWinSizeStep = max(1, (windows[1] - windows[0]) // 2)
            parameters.minMarkerPerimeterRate, parameters.maxMarkerPerimeterRate = smallest, largest
            self._detectors[key] = aruco.ArucoDetector(dictionary(self._cv), parameters)
        return self._detectors[key]


def _stacked(marks: Sequence[DetectedMarker]) -> NDArray[np.float64]:
    """Corners of all markers, (n, 4, 2)."""
    return np.array([mark.corners for mark in marks]).reshape(-1, 4, 2)


def is_known(mark: DetectedMarker, known: Sequence[DetectedMarker]) -> bool:
    """True if a marker is among the known ones: same id, centres less than half an edge apart."""
    for other in known:
        away = mark.corners.mean(axis=0) - other.corners.mean(axis=0)
        if mark.number == other.number and float(away @ away) < 0.25 * mean_edge(mark.corners) ** 2:
            return True
    return False


def mean_edge(corners: NDArray[np.float64]) -> float:
    """Mean edge length of a quadrangle (4, 2), px."""
    sides = corners - np.roll(corners, 1, axis=0)
    return float(np.sqrt((sides * sides).sum(axis=1)).mean())


def opencv() -> Any:
    """The module cv2, with the environment variables it reads on import set. Raises OpenCVMissing."""
    for name, value in QUIETLY.items():
        os.environ.setdefault(name, value)
    try:
        import cv2
    except ImportError as error:
        raise OpenCVMissing(OperatorMessage("no_opencv")) from error
    return cv2


def dictionary(cv: Any) -> Any:
    """The ArUco dictionary of all markers."""
    return cv.aruco.getPredefinedDictionary(cv.aruco.DICT_4X4_50)


def cells(number: int) -> NDArray[np.bool_]:
    """The black cells of a marker, (6, 6) bool. Raises OpenCVMissing."""
    cv = opencv()
    return np.asarray(cv.aruco.generateImageMarker(dictionary(cv), number, CELLS) < 128)


def detections(corners: Any, ids: Any) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Corners (n, 4, 2) and ids (n,) from the output of any OpenCV from 4.7 to 5."""
    numbers = np.zeros(0, np.int64) if ids is None else np.asarray(ids, np.int64).reshape(-1)
    if not len(numbers):
        return np.zeros((0, 4, 2)), numbers
    return np.asarray(corners, np.float64).reshape(-1, 4, 2), numbers
