"""Calibration by markers that are printed on the floor, with any screen beside it.

Four stand in the corners, where the drift monitor looks for them; three more along the rim, if they are there, fix the
distortion of the lens. Three corners of each marker are fitted, the fourth of each verifies; then all are fitted.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from pigaming_app.hardware.calibration.boards import ARENA_AT, BoardSamples
from pigaming_app.hardware.calibration.camera_position import height_by_ruler
from pigaming_app.hardware.calibration.camera_task import CameraTask
from pigaming_app.hardware.calibration.drift import EDGE, PLACES
from pigaming_app.hardware.calibration.ground_plane import PRINTED, CalibrationError, GroundPlane, Points
from pigaming_app.hardware.calibration.quality import assessed
from pigaming_app.hardware.calibration.site import CalibrationSite, Measurements
from pigaming_app.hardware.calibration.solver import Residuals, solve, verify, with_verification
from pigaming_app.hardware.signals import CameraFrame
from pigaming_app.hardware.vision.discovery import CameraId
from pigaming_app.hardware.vision.markers import CORNER_IDS, RIM_IDS
from pigaming_app.storage.messages import OperatorMessage

RIM = ((80, 540), (960, 70), (1840, 540))  # canvas px: centres of the markers along the rim, as PLACES
PRINTED_PLACES = dict(zip((*CORNER_IDS, *RIM_IDS), (*PLACES, *RIM), strict=True))
TIMEOUT = 30.0  # s
WHOLE, FITTED, VERIFIED = (0, 1, 2, 3), (0, 1, 2), (3,)  # corners of each marker


@dataclass(frozen=True)
class PrintedMarkers:
    """The printed markers, or some corners of each."""

    part: tuple[int, ...] = WHOLE

    @property
    def corners(self) -> dict[int, Points]:
        """The corners of each marker in ArUco's order, arena px, (n, 2)."""
        square = EDGE / 2.0 * np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])[list(self.part)]
        return {number: square + place - np.array(ARENA_AT) - 0.5 for number, place in PRINTED_PLACES.items()}

    def of(self, seen: Mapping[int, Points]) -> dict[int, Points]:
        """These corners of markers seen by the camera."""
        return {number: corners[list(self.part)] for number, corners in seen.items()}


class PrintedSamples(BoardSamples):
    """Printed markers, accumulated over pictures: all in the corners are needed."""

    def __init__(self) -> None:
        super().__init__(PRINTED_PLACES)

    def check(self, often: Mapping[int, object]) -> None:
        if missing := [number for number in CORNER_IDS if number not in often]:
            if self.mirrored:
                raise CalibrationError(OperatorMessage("printed_mirrored"))
            raise CalibrationError(OperatorMessage("printed_few", seen=len(CORNER_IDS) - len(missing)))


class PrintedCalibration(CameraTask):
    """One calibration of the camera on a printed floor. It ends with `ground` and `residuals`, or with `fault`."""

    fresh = True

    def __init__(self, site: CalibrationSite, number: CameraId, measures: Measurements) -> None:
        super().__init__(site, number)
        self.measures = measures
        self.ground: GroundPlane | None = None
        self.residuals: Residuals | None = None
        self._samples: PrintedSamples | None = None

    @property
    def finished(self) -> bool:
        """True when done or failed."""
        return self.residuals is not None or self.fault is not None

    def process(self, frame: CameraFrame) -> None:
        if self.finished or not self.exposure.settled or frame.captured < self._since + self.site.settle:
            return
        if self.site.clock() - self._since > TIMEOUT:
            self.give_up(OperatorMessage("slow"))
            return
        self._samples = self._samples or PrintedSamples()
        self._samples.add(frame)
        if self._samples.ready:
            try:
                self._solve(self._samples)
            except CalibrationError as error:
                self.give_up(OperatorMessage("exposure_dark") if self.exposure.dark else error.message)

    def _solve(self, samples: PrintedSamples) -> None:
        seen, measures, fitted, verified = (
            samples.corners(),
            self.measures,
            PrintedMarkers(FITTED),
            PrintedMarkers(VERIFIED),
        )
        least = len(CORNER_IDS)
        trial = solve(fitted.of(seen), fitted, samples.size, measures.width, PRINTED, least)
        residuals = verify(trial, verified.of(seen), verified)
        ground = solve(seen, PrintedMarkers(), samples.size, measures.width, PRINTED, least)
        ground = height_by_ruler(replace(ground, lid=measures.lid), measures.height)
        if residuals.accepted:
            quality = assessed(ground.weakest_edge, samples.blur(), self.exposure, samples.light())
            ground = with_verification(replace(ground, quality=quality), residuals)
        self.ground, self.residuals = ground, residuals
