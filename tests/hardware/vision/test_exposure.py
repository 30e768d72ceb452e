"""Exposure control at the driver of the emulated camera: asked for, read back, kept, and made up for by gain."""

from dataclasses import replace
from math import inf, nan

import cv2
import numpy as np
import pytest

from pigaming_app.hardware.calibration.ground_plane import read, to_toml
from pigaming_app.hardware.calibration.quality import assessed
from pigaming_app.hardware.emulator.camera import (
    TRAITS,
    CameraDriver,
    CameraTraits,
    EmulatedCamera,
    FrameTiming,
)
from pigaming_app.hardware.signals import ExposureKept
from pigaming_app.hardware.vision.exposure import LONGEST, ExposureControl, warning_of
from tests.hardware.mat import nominal
from tests.hardware.sentences import sentence

SETTLE = 0.5  # s
WHITE = 157.0  # grey level of a board in normal light


def controlled(traits, fresh=True, kept=None, seconds=6.0, fps=30.0, driver=CameraDriver):
    """A control after these seconds of pictures, and the camera it controls."""
    camera = EmulatedCamera(None, FrameTiming(fps), lambda: 0.0, 1, traits)  # type: ignore[arg-type]  # it paints nothing
    control = ExposureControl(cv2, driver(camera), 0.0, SETTLE, fresh, kept)
    watch(control, camera, 0.0, seconds, fps)
    return control, camera


def watch(control, camera, begin, seconds, fps=30.0):
    """Pictures of these seconds."""
    for i in range(round(seconds * fps)):
        grey = min(255.0, WHITE * camera.brightness)
        control.observe(np.full((96, 128), grey, np.uint8), begin + i / fps)


class Nonsense(CameraDriver):
    """A driver whose exposure or gain is not a figure of this world."""

    exposure = gain = None

    def get(self, name):
        given = {cv2.CAP_PROP_EXPOSURE: self.exposure, cv2.CAP_PROP_GAIN: self.gain}.get(name)
        return super().get(name) if given is None else given


@pytest.mark.parametrize(("units", "expected"), [("V4L2", 0.0166), ("DSHOW", 1 / 64), ("MSMF", 1 / 64)])
def test_a_long_exposure_is_cut_to_a_sixtieth_in_the_units_of_the_driver(units, expected):
    control, camera = controlled(CameraTraits(units, metered=1 / 30))
    assert camera.shutter == pytest.approx(expected)
    assert camera.shutter <= LONGEST
    assert control.state.seconds == pytest.approx(expected)
    assert control.state.settled
    assert warning_of(control.state) is None


def test_an_exposure_that_is_short_enough_stays():
    control, camera = controlled(TRAITS["good"])
    assert camera.shutter == pytest.approx(0.006)
    assert not camera.automatic
    assert (control.state.settled, control.state.gain, control.state.dark) == (True, 0.0, False)


def test_a_driver_that_sets_no_shorter_one_is_read_back_and_named():
    control, _ = controlled(TRAITS["stubborn"])
    assert control.state.seconds == pytest.approx(1 / 30, rel=0.01)
    assert "1/30\u00a0s" in sentence(warning_of(control.state))


@pytest.mark.parametrize(("fps", "warned"), [(30.0, True), (60.0, False)])
def test_without_a_figure_the_interval_of_the_pictures_is_the_bound(fps, warned):
    control, _ = controlled(TRAITS["silent"], fps=fps)
    assert control.state.seconds is None
    assert control.state.bound == pytest.approx(1 / fps)
    warning = warning_of(control.state)
    assert (warning is not None) == warned
    assert not warned or "may be 1/30\u00a0s" in sentence(warning)


def test_a_picture_that_gets_too_dark_gets_gain():
    control, camera = controlled(TRAITS["dim"])
    assert camera.shutter <= LONGEST
    assert WHITE * camera.brightness > 65.0
    assert control.state.settled
    assert not control.state.dark


def test_where_the_gain_does_not_suffice_the_operator_adds_light():
    for gains in (0.0, 20.0):
        control, camera = controlled(CameraTraits(metered=1 / 8, gains=gains))
        assert control.state.settled
        assert sentence(warning_of(control.state)) == "Too dark for a short exposure: add even light."
        assert camera.gain == gains


@pytest.mark.parametrize("seconds", [0.1, 3.0])
def test_exposure_and_gain_of_a_calibration_are_set_at_once_and_stay(seconds):
    control, camera = controlled(TRAITS["dim"], fresh=False, kept=ExposureKept(0.0166, 120.0), seconds=seconds)
    assert (camera.shutter, camera.gain, camera.automatic) == (pytest.approx(0.0166), 120.0, False)
    assert control.state.seconds == pytest.approx(0.0166)


def test_a_match_leaves_an_exposure_that_no_calibration_chose():
    _, camera = controlled(TRAITS["long"], fresh=False)
    assert camera.shutter == pytest.approx(1 / 30, rel=0.01)


@pytest.mark.parametrize("kept", [ExposureKept(0.0166, 120.0), None])
def test_an_exposure_that_another_program_lengthens_is_set_again(kept):
    control, camera = controlled(TRAITS["long"], fresh=kept is None, kept=kept)
    assert camera.shutter == pytest.approx(0.0166)
    camera.automatic = True
    watch(control, camera, 66.0, 1.5)
    assert (camera.shutter, camera.automatic) == (pytest.approx(0.0166), False)
    assert warning_of(control.state) is None


def test_a_driver_that_returns_to_a_long_exposure_after_a_minute_is_warned_about():
    control, camera = controlled(TRAITS["long"])
    watch(control, camera, 6.0, 54.0)
    assert warning_of(control.state) is None
    camera.traits, camera.manual = TRAITS["stubborn"], 1 / 30
    watch(control, camera, 60.0, 1.5)
    assert control.state.seconds == pytest.approx(1 / 30, rel=0.01)
    assert "1/30\u00a0s" in sentence(warning_of(control.state))


def test_automatics_that_end_late_do_not_lengthen_a_kept_exposure():
    """Some drivers set the exposure anew when they lock the rest."""
    control, camera = controlled(TRAITS["long"], fresh=False, kept=ExposureKept(0.0166, 0.0), seconds=0.1)
    camera.automatic = True
    watch(control, camera, SETTLE, 0.1)
    assert camera.shutter == pytest.approx(0.0166)


@pytest.mark.parametrize("units", ["V4L2", "DSHOW", "MSMF", ""])
@pytest.mark.parametrize("figure", [nan, inf, -inf, 0.0, 1e300, -1e300, 1e7])
def test_a_figure_that_is_no_exposure_or_gain_counts_as_none(units, figure):
    nonsense = type("Nonsense", (Nonsense,), {"exposure": figure, "gain": figure})
    control, _ = controlled(CameraTraits(units, metered=1 / 30), driver=nonsense)
    state = control.state
    assert (state.settled, state.seconds, state.gain) == (True, None, 0.0)
    assert "may be 1/30\u00a0s" in sentence(warning_of(state))
    ground = replace(nominal(), quality=assessed(30.0, 0.8, state))
    assert read(to_toml(ground)) == ground, "the calibration can be read again"
