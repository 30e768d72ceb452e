"""Whether camera or projector were moved since the calibration: four markers in the margins of the picture say so.

They are projected for as long as robots drive. Where the calibration says that they are seen, less where they truly
are, is the drift; the median of ten pictures, so that a hand or a bad picture does no harm.
"""

from collections import deque
from math import hypot

import numpy as np

from pigaming_app.hardware.calibration.boards import ARENA_AT, LIGHT
from pigaming_app.hardware.calibration.ground_plane import GroundPlane, Points
from pigaming_app.hardware.signals import CameraFrame, DetectedMarker, Image
from pigaming_app.hardware.vision.markers import CORNER_IDS, MarkerDetector, SearchWindow, mean_edge, opencv

WARN, PAUSE = 5.0, 15.0  # mm
PICTURES = 10  # whose median counts
PERIOD = 0.06  # s between two looks: what is worse than PAUSE pauses within half a second
SEEK = 0.06  # s between two searches for one that is not where it was
SEARCH = 1.0  # s between looks everywhere for it
EDGE, QUIET = 84, 16  # canvas px: of a marker, and of the light round it
PLACES = ((80, 84), (1840, 84), (1840, 996), (80, 996))  # canvas px: their middles, in the margins beside the arena


class DriftMonitor:
    """The drift of one calibration. Raises OpenCVMissing where OpenCV is missing."""

    def __init__(self, ground: GroundPlane) -> None:
        self.ground = ground
        self._markers = MarkerDetector(CORNER_IDS)
        self._places = {
            number: place - np.array(ARENA_AT) for number, place in zip(CORNER_IDS, _centres(), strict=True)
        }
        self._seen = {number: self._outline(number) for number in CORNER_IDS}  # where each was seen last
        self._spots = {number: _spot(mark) for number, mark in self._seen.items()}
        self._misses: dict[int, deque[Points]] = {number: deque(maxlen=PICTURES) for number in CORNER_IDS}
        self._looked = self._sought = self._searched = float("-inf")

    def see(self, frame: CameraFrame) -> None:
        """Look at a picture, if it is time to."""
        if frame.captured - self._looked < PERIOD - 1e-6:
            return
        self._looked = frame.captured
        found = self._markers.still(frame.image, list(self._seen.values()))
        found += self._further(frame, [number for number in CORNER_IDS if number not in {m.number for m in found}])
        self.note(found)

    def note(self, marks: list[DetectedMarker]) -> None:
        """Take in the corner markers of one picture."""
        if not marks:
            return
        seen = self.ground.on_mat(np.concatenate([mark.corners for mark in marks])).reshape(-1, 4, 2).mean(axis=1)
        for mark, place in zip(marks, seen, strict=True):
            self._seen[mark.number] = mark
            self._misses[mark.number].append(place - self._places[mark.number])

    @property
    def mm(self) -> float:
        """By how much the corner that moved most has moved; 0 until one was seen in ten pictures."""
        full = [np.median(misses, axis=0) for misses in self._misses.values() if len(misses) == PICTURES]
        return max((hypot(x, y) * self.ground.mm for x, y in full), default=0.0)

    def _further(self, frame: CameraFrame, missing: list[int]) -> list[DetectedMarker]:
        """Those that are not where they were: near there at first, and from time to time everywhere."""
        if not missing or frame.captured - self._sought < SEEK:
            return []
        self._sought = frame.captured
        near = [self._markers.near(frame.image, self._spots[number], number) for number in missing]
        found = [mark for mark in near if mark is not None]
        if len(found) < len(missing) and frame.captured - self._searched > SEARCH:
            self._searched = frame.captured
            edge = float(np.mean([spot.edge for spot in self._spots.values()]))
            known = [*self._seen.values(), *found]
            found += self._markers.glance(frame.image, edge, known, dim=False)
        return self._markers.exact(frame.image, found)

    def _outline(self, number: int) -> DetectedMarker:
        """A corner marker as the calibration says that it is seen."""
        half = EDGE / 2.0
        square = half * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
        return DetectedMarker(number, self.ground.seen_at(self._places[number] + square))


def _spot(mark: DetectedMarker) -> SearchWindow:
    """Where to look for a marker that was there."""
    (x, y), edge = mark.corners.mean(axis=0).tolist(), mean_edge(mark.corners)
    return SearchWindow(x, y, 1.3 * edge, edge)


def corner_markers() -> list[tuple[int, int, Image]]:
    """What to project: (left, top) on the canvas, and a grey picture with its own light round it."""
    cv = opencv()
    words = cv.aruco.getPredefinedDictionary(cv.aruco.DICT_4X4_50)
    found = []
    for number, (x, y) in zip(CORNER_IDS, PLACES, strict=True):
        tile = np.full((EDGE + 2 * QUIET, EDGE + 2 * QUIET), LIGHT, np.uint8)
        tile[QUIET:-QUIET, QUIET:-QUIET] = np.minimum(cv.aruco.generateImageMarker(words, number, EDGE), LIGHT)
        found.append((x - EDGE // 2 - QUIET, y - EDGE // 2 - QUIET, tile))
    return found


def _centres() -> Points:
    """The middles of the markers; that of an even number of px lies between two of them."""
    return np.array(PLACES) - 0.5
