"""An arcade projected onto an emulated mat with a camera, and its operator: for calibration tests."""

from typing import Any

import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.mat.calibration.boards_page import BoardsPage
from pigaming_app.scenes.mat.calibration.setup_page import CalibrationPage
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.draw.pixels import pixels_of
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.window import Canvas
from tests.scenes.arcade import Arcade


class Operated(Arcade):
    """An arcade projected onto an emulated mat, and its operator."""

    def __init__(self, controls: Controls, site: Any) -> None:
        super().__init__(controls)
        self.context.canvas = Canvas.open(Settings(fullscreen=False), headless=True)
        self.site = site
        if isinstance(site, EmulatedCalibrationSite):
            self.context.canvas.watchers.append(lambda window: site.project(pixels_of(window)))

    def picture(self, covered: bool = False) -> None:
        """Draw and project one picture; `covered`: a person blocks the light of the right half."""
        self.frame()
        screen = self.context.canvas.screen
        self.stack.top.draw(screen)
        if covered:
            screen.fill((20, 20, 20), (700, 0, 1220, 1080))
        self.context.canvas.flip()

    def pictures(self, scene_class: type[Scene], limit: int = 400, covered: bool = False) -> Any:
        """Draw pictures until a scene of this class is on top."""
        for _ in range(limit):
            if isinstance(self.stack.top, scene_class):
                return self.stack.top
            self.picture(covered)
        raise AssertionError(f"{type(self.stack.top).__name__} is on top")

    def go(self, row: str) -> CalibrationPage:
        """Focus a row of the first page."""
        top = self.shown(CalibrationPage)
        while top.focus.name != row:
            self.press(Button.DOWN)
        return top

    def begin(self) -> None:
        self.go("begin")
        self.press(Button.FIRE)
        self.shown(BoardsPage)
