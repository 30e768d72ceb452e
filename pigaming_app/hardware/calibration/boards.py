"""Projected calibration boards: 7 x 5 markers over the whole canvas, and a held-out board for verification.

`BoardSamples` accumulates a board's markers over several pictures. The held-out board has its markers elsewhere, so
its errors are those of the calibration, not the residuals of the fit.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.ground_plane import CalibrationError, Points
from pigaming_app.hardware.signals import CameraFrame, Image
from pigaming_app.hardware.vision.markers import CORNER_IDS, WEARERS, MarkerDetector, dictionary, opencv
from pigaming_app.hardware.vision.sharpness import LightField, blur_of, contrasts_of
from pigaming_app.storage.messages import OperatorMessage

CANVAS = (1920, 1080)
ARENA_AT = (160.0, 140.0)  # px, the arena's top left corner on the canvas
COLUMNS, ROWS = 7, 5
FRAMES = 10  # pictures to average
BLUR_EVERY = 4  # pictures between two measurements of the blur
MIN_MARKERS = 26  # of 35
MAX_SHAKE = 1.5  # camera px, standard deviation of a corner; above it something moves
LIGHT = 235  # grey level of the board's background: below full, to avoid overexposure


@dataclass(frozen=True)
class CalibrationBoard:
    """A board centred at `middle`, its marker centres `pitch` apart, in canvas px."""

    middle: tuple[float, float]
    pitch: tuple[float, float]
    edge: int = 132  # of a marker

    @property
    def corners(self) -> dict[int, Points]:
        """The corners of each marker in ArUco's order, arena px, (4, 2).

        Pixel coordinates refer to pixel centres: a marker that fills pixels 10..13 has edges at 9.5 and 13.5.
        """
        half = self.edge / 2.0
        square = np.array([(-half, -half), (half, -half), (half, half), (-half, half)])
        return {number: square + centre - np.array(ARENA_AT) - 0.5 for number, centre in self._centres().items()}

    def picture(self) -> Image:
        """The picture to project: (1080, 1920), grey."""
        cv = opencv()
        page = np.full((CANVAS[1], CANVAS[0]), LIGHT, np.uint8)
        for number, (x, y) in self._centres().items():
            left, top = round(x - self.edge / 2), round(y - self.edge / 2)
            marker = cv.aruco.generateImageMarker(dictionary(cv), number, self.edge)
            page[top : top + self.edge, left : left + self.edge] = np.minimum(marker, LIGHT)
        return page

    def _centres(self) -> dict[int, NDArray[np.float64]]:
        (x, y), (wide, high) = self.middle, self.pitch
        return {
            BOARD_IDS[row * COLUMNS + column]: np.array(
                (x + (column - (COLUMNS - 1) / 2) * wide, y + (row - (ROWS - 1) / 2) * high)
            )
            for row in range(ROWS)
            for column in range(COLUMNS)
        }


BOARD_IDS = tuple(number for number in range(50) if number not in {*WEARERS, *CORNER_IDS})[-COLUMNS * ROWS :]
BOARD = CalibrationBoard((960.0, 540.0), (270.0, 208.0))
HELD_OUT = CalibrationBoard((976.0, 553.0), (238.0, 182.0))  # every marker at least 16 px off its position on the first


class BoardSamples:
    """Detected markers of a board, accumulated over pictures. Raises OpenCVMissing."""

    def __init__(self, numbers: Iterable[int] = BOARD_IDS) -> None:
        self._markers = MarkerDetector(numbers)
        self._seen: dict[int, list[Points]] = {}
        self._blurs: dict[int, list[float]] = {}
        self._lights: dict[int, list[float]] = {}  # grey levels
        self._newest: Image | None = None
        self.frames = 0
        self.size = (0, 0)  # of the pictures

    def add(self, frame: CameraFrame) -> int:
        """Detect the board's markers in one more picture; returns their number."""
        self.frames += 1
        self.size = (frame.image.shape[1], frame.image.shape[0])
        marks = self._markers.refine(frame.image, self._markers.detect(frame.image))
        self._newest = frame.image
        for mark, light in zip(marks, contrasts_of(frame.image, marks).tolist(), strict=True):
            self._seen.setdefault(mark.number, []).append(mark.corners)
            self._lights.setdefault(mark.number, []).append(light)
        if self.frames % BLUR_EVERY == 1:
            for mark in marks:
                self._blurs.setdefault(mark.number, []).extend(blur_of(opencv(), frame.image, [mark]))
        return len(marks)

    @property
    def ready(self) -> bool:
        """True after FRAMES pictures."""
        return self.frames >= FRAMES

    def blur(self) -> float:
        """Blur of the board's softest tenth of markers, standard deviation in camera px; 0 if none was clear."""
        blurs = [*self._typical_blurs().values()]
        return float(np.percentile(blurs, 90.0)) if blurs else 0.0

    def light(self) -> LightField:
        """Light over the field: its darkest tenth of markers, each at its darkest."""
        lows = {number: min(lights) for number, lights in self._lights.items()}
        means = [float(np.mean(lights)) for lights in self._lights.values()]
        swings = [np.ptp(lights) / max(np.mean(lights), 1.0) for lights in self._lights.values()]
        if not lows:
            return LightField()
        share, blurs = np.percentile([*lows.values()], 10.0) / max(np.median(means), 1.0), self._typical_blurs()
        softest = max(blurs, key=lambda number: blurs[number], default=-1)
        flicker = min(1.0, float(np.percentile(swings, 90.0)))
        return LightField(min(1.0, float(share)), flicker, softest, min(lows, key=lambda number: lows[number]))

    @property
    def mirrored(self) -> bool:
        """True if the newest picture shows the board in a mirror."""
        if self._newest is None:
            return False
        return len(self._markers.detect(np.ascontiguousarray(self._newest[:, ::-1]))) > len(self._markers.ids) // 3

    def _typical_blurs(self) -> dict[int, float]:
        return {number: float(np.median(blurs)) for number, blurs in self._blurs.items() if blurs}

    def corners(self) -> Mapping[int, Points]:
        """Median corners of the markers seen in at least half of the pictures, camera px. Raises CalibrationError."""
        often = {number: np.array(seen) for number, seen in self._seen.items() if 2 * len(seen) >= self.frames}
        self.check(often)
        shake = float(np.median([seen.std(axis=0).max() for seen in often.values()]))
        if shake > MAX_SHAKE:
            raise CalibrationError(OperatorMessage("moves", shake=f"{shake:.1f}"))
        return {number: np.median(seen, axis=0) for number, seen in often.items()}

    def check(self, often: Mapping[int, object]) -> None:
        """Raises CalibrationError if these markers are too few."""
        if len(often) < MIN_MARKERS:
            if self.mirrored:
                raise CalibrationError(OperatorMessage("mirrored"))
            raise CalibrationError(OperatorMessage("few", seen=len(often), all=COLUMNS * ROWS, needed=MIN_MARKERS))
        if empty := _empty_corner(often):
            raise CalibrationError(OperatorMessage(empty))


def _empty_corner(seen: Mapping[int, object]) -> str:
    """The message key of the first corner block (2 x 2 markers) without a visible marker; "" if each has one."""
    for name, top, left in (("top_left", 0, 0), ("top_right", 0, 5), ("bottom_left", 3, 0), ("bottom_right", 3, 5)):
        block = [BOARD_IDS[(top + i) * COLUMNS + left + j] for i in (0, 1) for j in (0, 1)]
        if not any(number in seen for number in block):
            return name
    return ""
