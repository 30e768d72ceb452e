"""Calibration procedure: observe one board, solve, and verify on the held-out board.

`board` is the board to project; the caller confirms each projected frame by `mark_shown`, and only pictures exposed
after the projector's and camera's delay count.
"""

from dataclasses import replace
from math import inf

from pigaming_app.hardware.calibration.boards import BOARD, FRAMES, HELD_OUT, BoardSamples, CalibrationBoard
from pigaming_app.hardware.calibration.camera_position import height_by_ruler
from pigaming_app.hardware.calibration.camera_task import CameraTask
from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane
from pigaming_app.hardware.calibration.quality import assessed
from pigaming_app.hardware.calibration.site import CalibrationSite, Measurements
from pigaming_app.hardware.calibration.solver import Residuals, solve, verify, with_verification
from pigaming_app.hardware.signals import CameraFrame
from pigaming_app.hardware.vision.discovery import CameraId
from pigaming_app.storage.messages import OperatorMessage

QUEUED = 5  # outdated pictures in a driver's queue
TIMEOUT = 90.0  # s, for the whole procedure
LIT = 0.4  # s from drawing a picture to its exposure by the camera, upper bound of all delays


class Calibration(CameraTask):
    """One calibration of the camera on this display. It ends with `ground` and `residuals`, or with `fault`.

    A finished calibration may still be too inaccurate: see `residuals.accepted`.
    """

    fresh = True  # the boards are about the brightest pictures, so exposure settles on them

    def __init__(self, site: CalibrationSite, number: CameraId, measures: Measurements, display: str) -> None:
        super().__init__(site, number)
        self.measures, self.display = measures, display
        self.board: CalibrationBoard | None = BOARD  # to project; HELD_OUT to verify; None: done, or failed
        self.ground: GroundPlane | None = None
        self.residuals: Residuals | None = None
        self.seen = 0  # markers in the newest picture
        self.weak: tuple[float, float] | None = (
            None  # arena px: the place with the most blur or the least light, if poor
        )
        self._samples: BoardSamples | None = None
        self._shown = inf  # s, when the board was first projected
        self._skipped = 0  # pictures since then

    @property
    def progress(self) -> tuple[int, int]:
        """Pictures taken, and the total of both boards."""
        taken = min(self._samples.frames, FRAMES) if self._samples else 0
        return (0 if self.board is BOARD else FRAMES) + taken, 2 * FRAMES

    @property
    def finished(self) -> bool:
        """True when done or failed."""
        return self.board is None

    def mark_shown(self, board: CalibrationBoard) -> None:
        """Confirm that `board` is projected; call it with every frame."""
        if board is self.board and self._shown == inf:
            self.site.clear(True)
            self._shown = self.site.clock()

    def process(self, frame: CameraFrame) -> None:
        if self.finished:
            return
        if self.site.clock() - self._since > TIMEOUT:
            self.give_up(OperatorMessage("slow"))
            return
        if not self.exposure.settled or frame.captured < max(self._shown + LIT, self._since + self.site.settle):
            return
        self._skipped += 1
        if self._skipped <= QUEUED:
            return
        self._samples = self._samples or BoardSamples()
        self.seen = self._samples.add(frame)
        if self._samples.ready:
            try:
                self._solve(self._samples) if self.board is BOARD else self._verify(self._samples)
            except CalibrationError as error:
                self.give_up(OperatorMessage("exposure_dark") if self.exposure.dark else error.message)

    def give_up(self, fault: OperatorMessage) -> None:
        super().give_up(fault)
        self.board = None

    def _solve(self, samples: BoardSamples) -> None:
        measures = self.measures
        ground = solve(samples.corners(), BOARD, samples.size, measures.width, self.display)
        ground = replace(ground, lid=measures.lid)
        self.ground = height_by_ruler(ground, measures.height) if measures.height else ground
        self._samples, self._shown, self._skipped = None, inf, 0
        self.board = HELD_OUT

    def _verify(self, samples: BoardSamples) -> None:
        assert self.ground is not None
        self.residuals = verify(self.ground, samples.corners(), HELD_OUT)
        if self.residuals.accepted:
            field, edge = samples.light(), self.ground.weakest_edge
            quality = assessed(edge, samples.blur(), self.exposure, field)
            self.ground = with_verification(replace(self.ground, quality=quality), self.residuals)
            weak = {"finds_blurred": field.softest, "finds_dim": field.darkest}.get(quality.cause, -1)
            self.weak = self._place(weak) if weak >= 0 else None
        self.board = self._samples = None

    def _place(self, number: int) -> tuple[float, float]:
        x, y = HELD_OUT.corners[number].mean(axis=0).tolist()
        return x, y

    def end(self) -> None:
        super().end()
        self.site.clear(False)
