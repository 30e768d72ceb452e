"""Unattended calibration of an emulated arena: the wizard's own pages, operated by a script, in simulated time.

The result is compared with ground truth, which the wizard never sees.
"""

from time import perf_counter
from typing import Any

import numpy as np

from pigaming_app.hardware.calibration.detection import found_share
from pigaming_app.hardware.calibration.ground_plane import GroundPlane
from pigaming_app.hardware.calibration.quality import CameraQuality
from pigaming_app.hardware.emulator.arena import ARENA_AT
from pigaming_app.hardware.emulator.camera import TRAITS
from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite
from pigaming_app.hardware.session import store
from pigaming_app.hardware.vision.markers import WEARERS
from pigaming_app.scenes.flow.scene import Context, Stack
from pigaming_app.scenes.mat.calibration.result_page import ResultPage
from pigaming_app.scenes.mat.calibration.setup_page import CalibrationPage
from pigaming_app.storage.scores import Scores
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.draw.pixels import pixels_of
from pigaming_app.ui.i18n import Words, english
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.sounds import Sounds
from pigaming_app.ui.window import Canvas

FRAME = 1 / 30  # s, simulated
TIMEOUT = 60.0  # s, simulated
GRID = [(x, y) for x in range(0, 1601, 200) for y in range(0, 901, 150)]  # arena px, of the comparison


class Operator:
    """Presses the buttons of the wizard.

    `robot`: the camera height is measured by a robot on projected outlines; `view`: camera of `emulator.camera.TRAITS`.
    """

    def __init__(self, seed: int, robot: bool = False, view: str = "good") -> None:
        self.site, self.robot = EmulatedCalibrationSite(seed, traits=TRAITS[view]), robot
        canvas = Canvas.open(Settings(fullscreen=False), headless=True)
        canvas.watchers.append(lambda window: self.site.project(pixels_of(window)))
        self.context = Context(Settings(), Scores(), Words("en"), Controls(), Sounds(), canvas)
        self.page = CalibrationPage(self.context, self.site)
        self.stack = Stack(self.page)

    def press(self, button: Button) -> None:
        self.stack.apply(self.stack.top.handle(InputEvent(button, Device("keys", 0))))

    def frame(self) -> None:
        """Update and draw one frame."""
        self.stack.apply(self.stack.top.update(FRAME))
        self.stack.top.draw(self.context.canvas.screen)
        self.context.canvas.flip()

    def go(self, row: str) -> None:
        """Focus a row of the first page."""
        while self.page.focus.name != row:
            self.press(Button.DOWN)

    def work(self) -> ResultPage | None:
        """Calibrate; the result, or None after TIMEOUT."""
        if self.robot:
            self.go("by")
            self.press(Button.RIGHT)
        self.go("begin")
        self.press(Button.FIRE)
        for _ in range(round(TIMEOUT / FRAME)):
            self.frame()
            if isinstance(self.stack.top, ResultPage):
                return self.stack.top
        return None

    def close(self) -> None:
        """Close all pages, the arena and the window."""
        self.stack.clear()
        self.site.close()
        self.context.canvas.close()


def calibrate(seed: int, robot: bool = False, view: str = "good", anyway: bool = False) -> dict[str, Any]:
    """Calibrate and save; the results by name. `anyway`: also if too few markers are expected to be found."""
    began, operator = perf_counter(), Operator(seed, robot, view)
    try:
        page = operator.work()
        if page is None:
            return {"saved": False, "trouble": "The calibration timed out."}
        finding, reason = page.finding, page.finding.trouble
        trouble = reason and english().long_sentence(reason)
        if finding.good or (anyway and finding.accurate):
            while page.focus.name not in ("save", "anyway"):
                operator.press(Button.RIGHT)
            operator.press(Button.FIRE)
            trouble = page.message or None
        elif finding.accurate and finding.ground and finding.ground.quality.advice:
            trouble = english().long_sentence(finding.ground.quality.advice)
        saved = operator.stack.top is operator.page
        result: dict[str, Any] = {
            "saved": saved,
            "trouble": trouble,
            "file": str(store.calibration_file(operator.site.name)),
        }
        if finding.residuals and finding.ground:
            result |= {
                "calibration_mean_mm": finding.residuals.mean_mm,
                "calibration_max_mm": finding.residuals.max_mm,
                **_compared(finding.ground, operator.site),
                "marker_mm": finding.marker_mm or None,
                **_picture(finding.ground.quality),
            }
        return {**result, "made_up_seconds": operator.site.clock(), "seconds": perf_counter() - began}
    finally:
        operator.close()


def _picture(quality: CameraQuality) -> dict[str, Any]:
    """Quality of the camera's picture; None: not measured, or no figure of the driver."""
    look = quality.marker_px, quality.blur_px, quality.exposure, quality.light
    shares = {str(number): found_share(number, *look) for number in WEARERS} if quality.measured else None
    return {
        "marker_edge_px": quality.marker_px or None,
        "blur_px": quality.blur_px or None,
        "exposure_ms": 1e3 * quality.exposure or None,
        "gain": quality.gain,
        "darkest_light": quality.light if quality.measured else None,
        "flicker": quality.flicker if quality.measured else None,
        "predicted_detection": quality.detection if quality.measured else None,
        "predicted_by_marker": shares,
        "sufficient": quality.sufficient,
    }


def _compared(ground: GroundPlane, site: EmulatedCalibrationSite) -> dict[str, float]:
    """Errors against ground truth on the mat and at the height of the lids, mm."""
    optics = site.arena.optics
    places = np.array(GRID, dtype=np.float64)
    on_mat = optics.mat(places + ARENA_AT)
    errors = {}
    for name, height in (("mat", 0.0), ("lids", ground.lid)):
        projected = ground.at_height(optics.sensor(on_mat, height), height)
        errors[name] = np.sqrt(((projected - places) ** 2).sum(axis=1)) * ground.mm
    eye = optics.lens.eye
    return {
        "true_mean_mm": float(errors["mat"].mean()),
        "true_max_mm": float(errors["mat"].max()),
        "lids_max_mm": float(errors["lids"].max()),
        "height_mm": ground.height,
        "true_height_mm": float(eye[2]),
    }
