"""Results of a calibration with any picture, without a camera, for tests of their texts."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np

from pigaming_app.hardware.calibration.quality import CameraQuality
from pigaming_app.hardware.calibration.site import Measurements
from pigaming_app.hardware.calibration.solver import Residuals
from pigaming_app.hardware.signals import ExposureState
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.mat.calibration.result_page import CalibrationResult, ResultPage
from pigaming_app.storage.messages import OperatorMessage
from tests.hardware.mat import nominal
from tests.scenes.arcade import Arcade

KNOWN = ExposureState(1 / 60, 1 / 30, 120.0, False, True)
SHARP = CameraQuality(1 / 60, 120.0, 28.0, 0.8, 1.0)
PICTURES: dict[str, tuple[CameraQuality, ExposureState]] = {
    "sharp": (SHARP, KNOWN),
    "blurred": (replace(SHARP, blur_px=12.4, detection=0.0, cause="finds_blurred"), KNOWN),
    "smeared": (
        replace(SHARP, exposure=1 / 30, detection=0.4, cause="finds_smeared"),
        KNOWN._replace(seconds=1 / 30),
    ),
    "tiny": (replace(SHARP, marker_px=12.0, detection=0.5, cause="finds_small"), KNOWN),
    "small": (replace(SHARP, marker_px=18.0, blur_px=0.5), KNOWN),
    "dark": (SHARP, KNOWN._replace(dark=True)),
    "unknown": (replace(SHARP, exposure=0.0), KNOWN._replace(seconds=None)),
}


def result_page(arcade: Arcade, picture: str, mm: float = 0.4, marker: float = 0.0) -> ResultPage:
    """The result with one of PICTURES, this maximum error and the size of a robot's marker, mm."""
    quality, exposure = PICTURES[picture]
    places = np.array([(100.0, 100.0), (1500.0, 800.0)])
    residuals = Residuals(places, np.ones((2, 2)), 0.5 * mm, mm)
    site: Any = SimpleNamespace(name="emulated", advance=lambda seconds: None)
    ground = replace(nominal(), quality=quality)
    found = CalibrationResult(site, 0, Measurements(), ground, residuals, marker_mm=marker, exposure=exposure)
    return ResultPage(arcade.context, found, _nowhere)


def failed_page(arcade: Arcade) -> ResultPage:
    """A calibration that failed, with the longest reason."""
    site: Any = SimpleNamespace(name="emulated", advance=lambda seconds: None)
    reason = OperatorMessage("few", seen=25, all=35, needed=26)
    picture = np.zeros((292, 520), np.uint8)
    return ResultPage(arcade.context, CalibrationResult(site, 0, Measurements(), None, None, reason, picture), _nowhere)


def _nowhere() -> Scene:
    raise AssertionError
