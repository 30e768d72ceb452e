"""Quality of the picture: what misses markers is refused, with its cause, and all of it is kept in the file."""

from dataclasses import replace

import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.calibration.ground_plane import CalibrationError, read, to_toml
from pigaming_app.hardware.calibration.quality import CameraQuality, assessed, used_anyway
from pigaming_app.hardware.signals import ExposureKept, ExposureState
from pigaming_app.ui.i18n import Words
from tests.hardware.grounds import nominal

GOOD = ExposureState(1 / 100, 1 / 30, 0.0, False, True)


@pytest.mark.parametrize(
    ("edge", "blur", "exposure", "cause"),
    [
        (36.0, 0.8, 1 / 60, None),  # 1080p, focused
        (28.0, 2.3, 1 / 167, "finds_blurred"),
        (13.0, 1.0, 1 / 60, "finds_small"),
        (36.0, 0.8, 1 / 30, "finds_smeared"),
        (18.0, 0.5, 1 / 60, "marker_small"),  # sufficient, but a warning
    ],
)
def test_the_wizard_accepts_a_good_picture_and_names_the_cause_of_a_weak_one(edge, blur, exposure, cause):
    quality = assessed(edge, blur, ExposureState(exposure))
    assert quality.sufficient == (cause in (None, "marker_small"))
    assert (quality.advice and quality.advice.key) == cause
    for language in ("en", "pt"):
        if quality.advice:
            assert Words(language).sentence(quality.advice)
            assert Words(language).long_sentence(quality.advice)
        assert "%" in Words(language).sentence(used_anyway(quality))


def test_the_quality_is_kept_with_the_calibration():
    quality = replace(assessed(28.0, 2.3, ExposureState(0.0166, gain=121.5)), anyway=True)
    ground = replace(nominal(), quality=quality)
    assert read(to_toml(ground)).quality == quality
    assert quality.kept == ExposureKept(0.0166, 121.5)
    assert CameraQuality().kept is None


def test_a_picture_without_figures_is_judged_as_unmeasured():
    ground = replace(nominal(), display="1: 1920 × 1080")
    text = to_toml(ground)
    assert read(text).quality == CameraQuality()
    assert CameraQuality().sufficient
    assert CameraQuality().advice is None
    with pytest.raises(CalibrationError):
        read(text.replace("anyway = false", "anyway = 1"))


def test_the_weakest_edge_is_that_of_the_lid_in_pixels():
    ground = nominal()  # 1 px a px of the arena, lids nearer to the camera
    expected = 50.0 / ground.mm * ground.height / (ground.height - ground.lid)
    assert ground.weakest_edge == pytest.approx(expected, rel=0.01)
    assert nominal((1280, 720)).weakest_edge == pytest.approx(expected / 1.5, rel=0.01)
