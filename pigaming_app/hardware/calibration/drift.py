"""Drift monitor: detects that camera or projector moved since the calibration, by four markers in the margins.

The markers are projected while robots drive. The drift is the distance between their observed and calibrated
positions on the mat; the median of ten pictures tolerates a hand or a bad picture.
"""

from collections import deque
from math import hypot

import numpy as np

from pigaming_app.hardware.calibration.boards import ARENA_AT, LIGHT
from pigaming_app.hardware.calibration.ground_plane import GroundPlane, Points
from pigaming_app.hardware.signals import CameraFrame, DetectedMarker, Image
from pigaming_app.hardware.vision.markers import CORNER_IDS, MarkerDetector, dictionary, opencv, window_around

WARN, PAUSE = 5.0, 15.0  # mm
PICTURES = 10  # of the median
PERIOD = 0.06  # s between two measurements: a drift beyond PAUSE pauses within half a second
LOCAL_SEARCH = 0.06  # s between two searches near the last position of a missing marker
FULL_SEARCH = 1.0  # s between two searches of the whole picture
EDGE, QUIET = 84, 16  # canvas px: of a marker, and of its quiet zone
PLACES = ((80, 84), (1840, 84), (1840, 996), (80, 996))  # canvas px: centres, in the margins; between two px


class DriftMonitor:
    """The drift of one calibration. Raises OpenCVMissing."""

    def __init__(self, ground: GroundPlane) -> None:
        self.ground = ground
        self._markers = MarkerDetector(CORNER_IDS)
        self._places = {
            number: np.array(place) - 0.5 - ARENA_AT for number, place in zip(CORNER_IDS, PLACES, strict=True)
        }
        self._seen = {number: self._outline(number) for number in CORNER_IDS}  # last seen
        self._spots = {number: window_around(mark, 1.3) for number, mark in self._seen.items()}
        self._misses: dict[int, deque[Points]] = {number: deque(maxlen=PICTURES) for number in CORNER_IDS}
        self._looked = self._local_search = self._full_search = float("-inf")

    def process(self, frame: CameraFrame) -> None:
        """Measure a picture, at most every PERIOD."""
        if frame.captured - self._looked < PERIOD - 1e-6:
            return
        self._looked = frame.captured
        found = self._markers.recheck(frame.image, list(self._seen.values()))
        found += self._search(frame, [number for number in CORNER_IDS if number not in {m.number for m in found}])
        self.note(found)

    def note(self, marks: list[DetectedMarker]) -> None:
        """Add the detected corner markers of one picture."""
        if not marks:
            return
        seen = self.ground.on_mat(np.concatenate([mark.corners for mark in marks])).reshape(-1, 4, 2).mean(axis=1)
        for mark, place in zip(marks, seen, strict=True):
            self._seen[mark.number] = mark
            self._misses[mark.number].append(place - self._places[mark.number])

    @property
    def mm(self) -> float:
        """The largest drift of a corner, mm; 0 until one was seen in PICTURES pictures."""
        full = [np.median(misses, axis=0) for misses in self._misses.values() if len(misses) == PICTURES]
        return max((hypot(x, y) * self.ground.mm for x, y in full), default=0.0)

    @property
    def seen(self) -> list[DetectedMarker]:
        """The corner markers where they were last seen."""
        return list(self._seen.values())

    def _search(self, frame: CameraFrame, missing: list[int]) -> list[DetectedMarker]:
        """Search for missing markers: near their last positions, and from time to time in the whole picture."""
        if not missing or frame.captured - self._local_search < LOCAL_SEARCH:
            return []
        self._local_search = frame.captured
        near = [self._markers.detect_in(frame.image, self._spots[number], number) for number in missing]
        found = [mark for mark in near if mark is not None]
        if len(found) < len(missing) and frame.captured - self._full_search > FULL_SEARCH:
            self._full_search = frame.captured
            edge = float(np.mean([spot.edge for spot in self._spots.values()]))
            known = [*self._seen.values(), *found]
            found += self._markers.detect_quickly(frame.image, edge, known, dim=False)
        return self._markers.refine(frame.image, found)

    def _outline(self, number: int) -> DetectedMarker:
        """A corner marker at its calibrated position in the picture."""
        half = EDGE / 2.0
        square = half * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
        return DetectedMarker(number, self.ground.to_camera(self._places[number] + square))


def corner_markers() -> list[tuple[int, int, Image]]:
    """The tiles to project: (left, top) on the canvas, and a grey picture with its quiet zone."""
    cv = opencv()
    tiles = []
    for number, (x, y) in zip(CORNER_IDS, PLACES, strict=True):
        tile = np.full((EDGE + 2 * QUIET, EDGE + 2 * QUIET), LIGHT, np.uint8)
        tile[QUIET:-QUIET, QUIET:-QUIET] = np.minimum(cv.aruco.generateImageMarker(dictionary(cv), number, EDGE), LIGHT)
        tiles.append((x - EDGE // 2 - QUIET, y - EDGE // 2 - QUIET, tile))
    return tiles
