"""What the calibration wizard does with a camera: it looks at one board, solves, and verifies by another.

What must be projected meanwhile stands in `board`; whoever projects it says so (`shown`), and only pictures taken well
after that count.
"""

from dataclasses import replace
from enum import Enum, auto
from math import inf

from pigaming_app.hardware.calibration import camera_task as looking
from pigaming_app.hardware.calibration.boards import BOARD, FRAMES, HELD_OUT, BoardSamples, CalibrationBoard
from pigaming_app.hardware.calibration.camera_position import height_by_ruler
from pigaming_app.hardware.calibration.camera_task import NO_PICTURE, CameraTask
from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane
from pigaming_app.hardware.calibration.site import CalibrationSite, Measurements
from pigaming_app.hardware.calibration.solver import Residuals, solve, verified, verify
from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.signals import CameraFrame

QUEUED = 5  # pictures of the time before that a driver may still hand out
LONGEST = 90.0  # s that all may take
LIT = 0.4  # s from a picture being drawn until it is surely seen by the camera, all delays included


class CalibrationStage(Enum):
    """How far a calibration is."""

    OPENING = auto()
    LOOKING = auto()
    VERIFYING = auto()
    DONE = auto()
    FAILED = auto()


class Calibration(CameraTask):
    """One calibration of the camera on this display. At the end there are `ground` and `residuals`, or `trouble`.

    A calibration that is done may still be too bad to be accepted: `residuals` says so.
    """

    fresh = True  # in the light of the boards, which is about the brightest that there will be

    def __init__(self, site: CalibrationSite, number: int, measures: Measurements, display: str) -> None:
        super().__init__(site, number)
        self.measures, self.display = measures, display
        self.stage = CalibrationStage.OPENING
        self.board: CalibrationBoard | None = BOARD  # what must be projected
        self.ground: GroundPlane | None = None
        self.residuals: Residuals | None = None
        self.seen = 0  # markers in the newest picture
        self._look: BoardSamples | None = None
        self._shown = inf  # s, since when the board is projected
        self._skipped = 0  # pictures since then

    @property
    def progress(self) -> tuple[int, int]:
        """Pictures taken, and how many of both boards there will be."""
        taken = min(self._look.frames, FRAMES) if self._look else 0
        return {CalibrationStage.VERIFYING: FRAMES, CalibrationStage.DONE: 2 * FRAMES}.get(
            self.stage, 0
        ) + taken, 2 * FRAMES

    @property
    def over(self) -> bool:
        """Whether nothing more will happen."""
        return self.stage in (CalibrationStage.DONE, CalibrationStage.FAILED)

    def shown(self, board: CalibrationBoard) -> None:
        """This board is projected from now on; to be said with every picture."""
        if board is self.board and self._shown == inf:
            self.site.clear(True)
            self._shown = self.site.clock()

    def look(self, frame: CameraFrame) -> None:
        if self.over or frame.captured < max(self._shown + LIT, self._since + self.site.settle):
            return
        if self.site.clock() - self._since > LONGEST:
            self.give_up(OperatorMessage("slow"))
            return
        self._skipped += 1
        if self._skipped <= QUEUED:
            return
        if self._look is None:
            self._look = BoardSamples()
            self.stage = CalibrationStage.LOOKING if self.stage is CalibrationStage.OPENING else self.stage
        self.seen = self._look.add(frame)
        if self._look.ready:
            try:
                self._solve(self._look) if self.stage is CalibrationStage.LOOKING else self._verify(self._look)
            except CalibrationError as trouble:
                self.give_up(trouble.message)

    def idle(self, seconds: float, trouble: OperatorMessage | None) -> None:
        if seconds > looking.BLIND and not self.over:
            self.give_up(trouble or NO_PICTURE)

    def give_up(self, trouble: OperatorMessage) -> None:
        super().give_up(trouble)
        self.stage, self.board = CalibrationStage.FAILED, None

    def _solve(self, look: BoardSamples) -> None:
        measures = self.measures
        ground = solve(look.corners(), BOARD, look.size, measures.width, self.display)
        ground = replace(ground, lid=measures.lid)
        self.ground = height_by_ruler(ground, measures.height) if measures.height else ground
        self._look, self._shown, self._skipped = None, inf, 0
        self.stage, self.board = CalibrationStage.VERIFYING, HELD_OUT

    def _verify(self, look: BoardSamples) -> None:
        assert self.ground is not None
        self.residuals = verify(self.ground, look.corners(), HELD_OUT)
        if self.residuals.accepted:
            self.ground = verified(self.ground, self.residuals)
        self.stage, self.board, self._look = CalibrationStage.DONE, None, None

    def end(self) -> None:
        super().end()
        self.site.clear(False)
