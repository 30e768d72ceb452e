"""The boards on the mat, and nothing else: a calibration looks at one, solves, and looks at another to verify.

In the margin below the markers a row of boxes shows how many pictures were taken; it is dark on the board's light.
"""

import pygame

from pigaming_app.hardware.calibration.boards import LIGHT, Board
from pigaming_app.hardware.calibration.procedure import Calibration
from pigaming_app.hardware.calibration.site import Measures, Site
from pigaming_app.hardware.messages import said
from pigaming_app.hardware.vision.markers import NoVision
from pigaming_app.scenes.calibration.height_page import HeightPage
from pigaming_app.scenes.calibration.result_page import CalibrationResult, ResultPage
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Pop, Scene, Swap, Turn
from pigaming_app.ui.draw.pixels import grey_surface
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent

BOX, GAP, FOOT = 26, 8, 1062  # px: of a box of the progress, between two, the line on which they are
GREY, DONE = (150, 150, 150), (20, 20, 20)


class BoardsPage:
    """One calibration."""

    def __init__(self, context: Context, site: Site, number: int, measures: Measures) -> None:
        self.context, self.site, self.number, self.measures = context, site, number, measures
        self.work = Calibration(site, number, measures, context.canvas.projection)
        self.work.begin()

    def entered(self) -> None:
        """Quiet: nothing may move."""
        self.context.sounds.music(False)

    def left(self) -> None:
        """Let go of the camera."""
        self.work.close()

    def on(self, event: InputEvent) -> Turn:
        """Only the way back."""
        if event.button is Button.BACK:
            self.context.sounds.play("back")
            self.left()
            return Pop()
        return None

    def update(self, seconds: float) -> Turn:
        """Wait for the camera; then show what came out."""
        self.site.advance(seconds)
        self.work.pump()
        if not self.work.over:
            return None
        self.left()
        work = self.work
        finding = CalibrationResult(
            self.site, self.number, self.measures, work.ground, work.residuals, work.trouble, work.small
        )
        self.context.sounds.play("accept" if finding.good else "back")
        if finding.good and not self.measures.height:
            return Swap(HeightPage(self.context, finding, self._again))
        return Swap(ResultPage(self.context, finding, self._again))

    def draw(self, screen: pygame.Surface) -> None:
        """Paint the board, pure light, and how far it is."""
        board = self.work.board
        if board is None:
            screen.fill((0, 0, 0))
            return
        try:
            screen.blit(picture(board), (0, 0))
        except NoVision as missing:
            self.work.give_up(said(missing))
            screen.fill((0, 0, 0))
            return
        self._draw_progress(screen)
        self.work.shown(board)

    def _again(self) -> Scene:
        """The same calibration once more."""
        return BoardsPage(self.context, self.site, self.number, self.measures)

    def _draw_progress(self, screen: pygame.Surface) -> None:
        """A box for every picture; what has been taken is filled."""
        taken, whole = self.work.progress
        left = 960 - (whole * (BOX + GAP) - GAP) // 2
        for i in range(whole):
            box = pygame.Rect(left + i * (BOX + GAP), FOOT - 6, BOX, 12)
            pygame.draw.rect(screen, DONE if i < taken else GREY, box, 0 if i < taken else 2)


@cached
def picture(board: Board) -> pygame.Surface:
    """A board as it is projected. Raises NoVision."""
    surface = grey_surface(board.picture())
    assert surface.get_at((0, 0))[0] == LIGHT
    return surface
