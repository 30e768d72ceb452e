"""The wizard on an emulated arena without anybody: its own pages, pressed by a script, in made-up time.

What it finds is compared with what is true there, which the wizard never hears of.
"""

from time import perf_counter
from typing import Any

import numpy as np
import pygame

from pigaming_app.hardware.calibration.ground_plane import Ground
from pigaming_app.hardware.emulator.arena import ARENA_AT
from pigaming_app.hardware.emulator.site import EmulatedSite
from pigaming_app.hardware.session import store as kept
from pigaming_app.scenes.calibration.result_page import ResultPage
from pigaming_app.scenes.calibration.setup_page import CalibrationPage
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Stack
from pigaming_app.storage.scores import Scores
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.draw.pixels import pixels_of
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.sounds import Sounds
from pigaming_app.ui.window import Canvas

FRAME = 1 / 30  # s of made-up time
PATIENCE = 60.0  # s of made-up time in which it must be done
GRID = [(x, y) for x in range(0, 1601, 200) for y in range(0, 901, 150)]  # arena px, where it is compared


class Operator:
    """Somebody who presses the right buttons; `robot`: a robot on outlines tells the camera's height."""

    def __init__(self, seed: int, robot: bool = False) -> None:
        self.site, self.robot = EmulatedSite(seed), robot
        pygame.font.init()
        canvas = Canvas.open(Settings(fullscreen=False), headless=True)
        canvas.watchers.append(lambda window: self.site.see(pixels_of(window)))
        self.context = Context(Settings(), Scores(), Words("en"), Controls(), Sounds(), canvas)
        self.page = CalibrationPage(self.context, self.site)
        self.stack = Stack(self.page)

    def press(self, button: Button) -> None:
        """Press a button."""
        self.stack.turn(self.stack.top.on(InputEvent(button, Device("keys", 0))))

    def frame(self) -> None:
        """One picture."""
        pygame.event.pump()
        self.stack.turn(self.stack.top.update(FRAME))
        self.stack.top.draw(self.context.canvas.screen)
        self.context.canvas.flip()

    def go(self, row: str) -> None:
        """Put the focus on a row of the first page."""
        while self.page.focus.name != row:
            self.press(Button.DOWN)

    def work(self) -> ResultPage | None:
        """Calibrate; the result, or None where nothing came of it in time."""
        if self.robot:
            self.go("by")
            self.press(Button.RIGHT)
        self.go("begin")
        self.press(Button.FIRE)
        for _ in range(round(PATIENCE / FRAME)):
            self.frame()
            if isinstance(self.stack.top, ResultPage):
                return self.stack.top
        return None

    def close(self) -> None:
        """Go home."""
        self.stack.clear()
        self.site.close()
        self.context.canvas.close()


def calibrate(seed: int, robot: bool = False) -> dict[str, Any]:
    """Calibrate and save; what came of it, by name."""
    began, operator = perf_counter(), Operator(seed, robot)
    try:
        page = operator.work()
        if page is None:
            return {"saved": False, "trouble": "It was not done in time."}
        finding, trouble = page.finding, page.finding.trouble
        if finding.good:
            operator.press(Button.FIRE)
            trouble = page.navigation.sentence or None
        saved = finding.good and operator.stack.top is operator.page
        told: dict[str, Any] = {"saved": saved, "trouble": trouble, "file": str(kept.path(operator.site))}
        if finding.residuals and finding.ground:
            told |= {
                "calibration_mean_mm": finding.residuals.mean_mm,
                "calibration_max_mm": finding.residuals.max_mm,
                **_compared(finding.ground, operator.site),
                "marker_mm": finding.marker_mm or None,
            }
        return {**told, "made_up_seconds": operator.site.clock(), "seconds": perf_counter() - began}
    finally:
        operator.close()


def _compared(ground: Ground, site: EmulatedSite) -> dict[str, float]:
    """Errors against what is true, on the mat and at the height of the lids, where robots are, in mm."""
    optics = site.arena.optics
    places = np.array(GRID, dtype=np.float64)
    on_mat = optics.mat(places + ARENA_AT)
    misses = {}
    for name, height in (("mat", 0.0), ("lids", ground.lid)):
        there = ground.at_height(optics.sensor(on_mat, height), height)
        misses[name] = np.sqrt(((there - places) ** 2).sum(axis=1)) * ground.mm
    eye = optics.lens.eye
    return {
        "true_mean_mm": float(misses["mat"].mean()),
        "true_max_mm": float(misses["mat"].max()),
        "lids_max_mm": float(misses["lids"].max()),
        "height_mm": ground.height,
        "true_height_mm": float(eye[2]),
    }
