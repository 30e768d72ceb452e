"""The page of a calibration by printed markers. It shows no picture of the camera: if that sees the screen, it would
find the markers there again.
"""

import pygame

from pigaming_app.hardware.calibration.printed import PrintedCalibration
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.mat.calibration.boards_page import BoardsPage
from pigaming_app.ui.draw import ICE, SUB
from pigaming_app.ui.draw.layers import text


class PrintedPage(BoardsPage):
    """One run of the calibration; nothing is projected."""

    def draw(self, screen: pygame.Surface) -> None:
        screen.fill((0, 0, 0))
        text(self.context.words("calibrate.looking_for"), SUB, ICE, "head", "c", 1600).draw(screen, 960, 540)

    def _new_work(self) -> PrintedCalibration:
        return PrintedCalibration(self.site, self.number, self.measures)

    def _retry(self) -> Scene:
        return PrintedPage(self.context, self.site, self.number, self.measures)
