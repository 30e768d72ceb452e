"""The boards page: shows calibration boards full screen, first to solve, then a held-out one to verify.

A row of boxes in the margin below the markers counts the pictures taken; it is dark on the board's light.
"""

import math

import pygame

from pigaming_app.hardware.calibration.boards import LIGHT, CalibrationBoard
from pigaming_app.hardware.calibration.printed import PrintedCalibration
from pigaming_app.hardware.calibration.procedure import Calibration
from pigaming_app.hardware.calibration.site import CalibrationSite, Measurements
from pigaming_app.hardware.vision.discovery import CameraId
from pigaming_app.hardware.vision.markers import OpenCVMissing
from pigaming_app.scenes.flow.scene import Context, Scene, StackOperation, Swap
from pigaming_app.scenes.mat.calibration.height_page import HeightPage
from pigaming_app.scenes.mat.calibration.result_page import CalibrationResult, ResultPage
from pigaming_app.scenes.pages.page import Page
from pigaming_app.ui.draw.pixels import grey_surface
from pigaming_app.ui.draw.surface_cache import cached

BOX, GAP, FOOT = 26, 8, 1062  # px: size and gap of the progress boxes, y of their row
GREY, DONE = (150, 150, 150), (20, 20, 20)


class BoardsPage(Page):
    """One run of the calibration."""

    idle = math.inf
    hints = ()

    def __init__(self, context: Context, site: CalibrationSite, number: CameraId, measures: Measurements) -> None:
        super().__init__(context)
        self.site, self.number, self.measures = site, number, measures
        self.work = self._new_work()
        self.work.begin()

    def on_enter(self) -> None:
        self.context.sounds.music(None)

    def on_leave(self) -> None:
        """Release the camera."""
        self.work.close()

    def advance(self, seconds: float) -> StackOperation:
        """Poll the camera; switch to the result when done."""
        self.site.advance(seconds)
        self.work.pump()
        if not self.work.finished:
            return None
        self.on_leave()
        work = self.work
        finding = CalibrationResult(
            self.site,
            self.number,
            self.measures,
            work.ground,
            work.residuals,
            work.fault,
            work.small,
            exposure=work.exposure,
            weak=work.weak if isinstance(work, Calibration) else None,
        )
        self.context.sounds.play("accept" if finding.good else "back")
        if finding.accurate and not self.measures.height:
            return Swap(HeightPage(self.context, finding, self._retry))
        return Swap(ResultPage(self.context, finding, self._retry))

    def draw(self, screen: pygame.Surface) -> None:
        work = self.work
        assert isinstance(work, Calibration)
        board = work.board
        if board is None:
            screen.fill((0, 0, 0))
            return
        try:
            screen.blit(picture(board), (0, 0))
        except OpenCVMissing as missing:
            work.give_up(missing.message)
            screen.fill((0, 0, 0))
            return
        self._draw_progress(screen, *work.progress)
        work.mark_shown(board)

    def _new_work(self) -> Calibration | PrintedCalibration:
        return Calibration(self.site, self.number, self.measures, self.context.canvas.projection)

    def _retry(self) -> Scene:
        """A page that repeats the calibration."""
        return BoardsPage(self.context, self.site, self.number, self.measures)

    def _draw_progress(self, screen: pygame.Surface, taken: int, whole: int) -> None:
        """One box per picture, filled when taken."""
        left = 960 - (whole * (BOX + GAP) - GAP) // 2
        for i in range(whole):
            box = pygame.Rect(left + i * (BOX + GAP), FOOT - 6, BOX, 12)
            pygame.draw.rect(screen, DONE if i < taken else GREY, box, 0 if i < taken else 2)


@cached
def picture(board: CalibrationBoard) -> pygame.Surface:
    """A board as projected. Raises OpenCVMissing."""
    surface = grey_surface(board.picture())
    assert surface.get_at((0, 0))[0] == LIGHT
    return surface
