"""Camera height by a robot on projected outlines, with a check of the mat's measured width.

`place` is the outline to project; the caller confirms each projected frame by `mark_shown`.
"""

from dataclasses import replace
from math import inf

import numpy as np

from pigaming_app.hardware.calibration.camera_position import height_by_robot
from pigaming_app.hardware.calibration.camera_task import CameraTask
from pigaming_app.hardware.calibration.ground_plane import MAX_KEYSTONE, CalibrationError, GroundPlane, keystone
from pigaming_app.hardware.calibration.procedure import LIT
from pigaming_app.hardware.calibration.site import CalibrationSite
from pigaming_app.hardware.signals import CameraFrame, DetectedMarker
from pigaming_app.hardware.vision.discovery import CameraId
from pigaming_app.hardware.vision.markers import WEARERS, MarkerDetector
from pigaming_app.storage.messages import OperatorMessage

PLACES = ((320.0, 220.0), (1280.0, 220.0), (1280.0, 680.0), (320.0, 680.0))  # arena px of the outlines
NEAR = 90.0  # arena px, radius of an outline within which a robot counts as on it
STILL = 12  # pictures without motion
MAX_JITTER = 1.0  # camera px, standard deviation of a robot at rest
TIMEOUT = 120.0  # s to put a robot down


class HeightProcedure(CameraTask):
    """Observes a robot on each outline of PLACES in turn and solves for the camera's position.

    At the end `found` is the ground with the camera's foot and height, and `marker_mm` the apparent size of the robot's
    marker: if it is far from the true size, the mat was measured wrongly.
    """

    def __init__(self, site: CalibrationSite, number: CameraId, ground: GroundPlane) -> None:
        super().__init__(site, number)
        self.ground = ground
        self.found: GroundPlane | None = None
        self.marker_mm = 0.0
        self.seen: list[tuple[float, float]] = []  # camera px, one for each outline done
        self._markers: MarkerDetector | None = None
        self._recent: list[DetectedMarker] = []
        self._marks: list[DetectedMarker] = []  # one for each outline done
        self._begun = self._shown = inf

    @property
    def place(self) -> int | None:
        """Index of the expected outline in PLACES; None when finished."""
        return None if self.found or self.fault else len(self.seen)

    @property
    def finished(self) -> bool:
        return self.place is None

    @property
    def steady(self) -> float:
        """Share of the required pictures in which the robot has stood still, 0..1."""
        return min(1.0, len(self._recent) / STILL)

    def mark_shown(self, place: int) -> None:
        """Confirm that the outline of `place` is projected."""
        if place == self.place and self._shown == inf:
            self._shown = self._begun = self.site.clock()
            self.site.stand(*PLACES[place])

    def process(self, frame: CameraFrame) -> None:
        if self.place is None or frame.captured < max(self._shown + LIT, self._since + self.site.settle):
            return
        if frame.captured > self._begun + TIMEOUT:
            self.give_up(OperatorMessage("nobody"))
            return
        self._markers = self._markers or MarkerDetector(WEARERS)
        here = [mark for mark in self._markers.detect(frame.image) if self._is_near(mark, self.place)]
        if len(here) != 1 or (self._recent and here[0].number != self._recent[0].number):
            self._recent = []
            return
        self._recent.append(here[0])
        del self._recent[:-STILL]
        if len(self._recent) == STILL and _jitter(self._recent) < MAX_JITTER:
            self._note()

    def _is_near(self, mark: DetectedMarker, place: int) -> bool:
        away = self.ground.on_mat(mark.corners).mean(axis=0) - np.array(PLACES[place])
        return float(away @ away) < NEAR * NEAR

    def _note(self) -> None:
        """Note the position of a robot at rest; after the last outline, solve."""
        x, y = np.median([mark.corners.mean(axis=0) for mark in self._recent], axis=0).tolist()
        self.seen.append((x, y))
        corners = np.median([mark.corners for mark in self._recent], axis=0)
        self._marks.append(DetectedMarker(self._recent[-1].number, corners))
        self._recent, self._shown = [], inf
        if len(self.seen) < len(PLACES):
            return
        try:
            found = height_by_robot(self.ground, PLACES, self.seen)
        except CalibrationError as error:
            self.give_up(error.message)
            return
        sizes = [found.edge_mm(mark) for mark in self._marks]
        if (share := keystone(np.array(PLACES), sizes)) > MAX_KEYSTONE:
            self.give_up(OperatorMessage("keystone", share=round(100 * share)))
            return
        self.marker_mm = sizes[-1]
        self.found = replace(found, quality=found.quality.with_edge(found.weakest_edge))


def _jitter(marks: list[DetectedMarker]) -> float:
    """Standard deviation of a marker's centre, camera px."""
    return float(np.std([mark.corners.mean(axis=0) for mark in marks], axis=0).max())
