"""A robot that is put on projected outlines tells where the camera hangs, and how well the mat was measured.

Which outline must be projected stands in `place`; whoever projects it says so (`shown`).
"""

from math import inf

import numpy as np

from pigaming_app.hardware.calibration import camera_task as looking
from pigaming_app.hardware.calibration.camera_position import height_by_robot
from pigaming_app.hardware.calibration.camera_task import NO_PICTURE, CameraTask
from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane
from pigaming_app.hardware.calibration.procedure import LIT
from pigaming_app.hardware.calibration.site import CalibrationSite
from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.signals import CameraFrame, DetectedMarker
from pigaming_app.hardware.vision.markers import ROBOT_IDS, MarkerDetector

PLACES = ((320.0, 220.0), (1280.0, 220.0), (1280.0, 680.0), (320.0, 680.0))  # arena px of the outlines
NEAR = 90.0  # arena px from an outline within which a robot is meant to stand on it
STILL = 12  # pictures in which a robot must not move
UNREST = 1.0  # px of the camera that it may tremble
PATIENCE = 120.0  # s for somebody to put a robot down


class HeightProcedure(CameraTask):
    """A robot is put on one outline after the other; where the camera sees it says how high the camera hangs.

    At the end `found` is the ground with the camera's place, and `marker_mm` how large the robot's marker seems: far
    from its true size, the mat was measured wrongly.
    """

    def __init__(self, site: CalibrationSite, number: int, ground: GroundPlane) -> None:
        super().__init__(site, number)
        self.ground = ground
        self.found: GroundPlane | None = None
        self.marker_mm = 0.0
        self.seen: list[tuple[float, float]] = []  # camera px, by place
        self._markers: MarkerDetector | None = None
        self._lately: list[DetectedMarker] = []
        self._begun = self._shown = inf

    @property
    def place(self) -> int | None:
        """Which outline of PLACES is waited for; None: it is over."""
        return None if self.found or self.trouble else len(self.seen)

    @property
    def steady(self) -> float:
        """For how much of the time it needs the robot has stood still, 0..1."""
        return min(1.0, len(self._lately) / STILL)

    def shown(self, place: int) -> None:
        """The outline of this place is projected."""
        if place == self.place and self._shown == inf:
            self._shown = self._begun = self.site.clock()
            self.site.stand(*PLACES[place])

    def look(self, frame: CameraFrame) -> None:
        if self.place is None or frame.captured < max(self._shown + LIT, self._since + self.site.settle):
            return
        if frame.captured > self._begun + PATIENCE:
            self.give_up(OperatorMessage("nobody"))
            return
        self._markers = self._markers or MarkerDetector(ROBOT_IDS)
        here = [mark for mark in self._markers.everywhere(frame.image) if self._is_near(mark, self.place)]
        if len(here) != 1 or (self._lately and here[0].number != self._lately[0].number):
            self._lately = []
            return
        self._lately.append(here[0])
        del self._lately[:-STILL]
        if len(self._lately) == STILL and _tremble(self._lately) < UNREST:
            self._note()

    def idle(self, seconds: float, trouble: OperatorMessage | None) -> None:
        if seconds > looking.BLIND and self.place is not None:
            self.give_up(trouble or NO_PICTURE)

    def _is_near(self, mark: DetectedMarker, place: int) -> bool:
        away = self.ground.on_mat(mark.corners).mean(axis=0) - np.array(PLACES[place])
        return float(away @ away) < NEAR * NEAR

    def _note(self) -> None:
        """The robot stands: take its place down; after the last, all is known."""
        x, y = np.median([mark.corners.mean(axis=0) for mark in self._lately], axis=0).tolist()
        self.seen.append((x, y))
        last, self._lately, self._shown = self._lately[-1], [], inf
        if len(self.seen) < len(PLACES):
            return
        try:
            found = height_by_robot(self.ground, PLACES, self.seen)
        except CalibrationError as trouble:
            self.give_up(trouble.message)
            return
        self.marker_mm = found.edge_mm(last)
        self.found = found


def _tremble(marks: list[DetectedMarker]) -> float:
    """By how many px of the camera a marker's middle moved, standard deviation."""
    return float(np.std([mark.corners.mean(axis=0) for mark in marks], axis=0).max())
