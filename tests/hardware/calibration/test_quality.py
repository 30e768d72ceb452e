"""Quality of the picture: what misses markers is refused, with its cause, and all of it is kept in the file."""

from collections import Counter
from dataclasses import replace

import pytest

from pigaming_app.hardware.calibration.boards import BOARD_IDS
from pigaming_app.hardware.calibration.detection import found_share
from pigaming_app.hardware.calibration.ground_plane import CalibrationError, read, to_toml
from pigaming_app.hardware.calibration.quality import CameraQuality, assessed, used_anyway
from pigaming_app.hardware.scan.blocks import BLOCK_SIZES
from pigaming_app.hardware.signals import ExposureKept, ExposureState
from pigaming_app.hardware.vision.markers import CORNER_IDS, ROBOT_IDS, WEARERS
from pigaming_app.ui.i18n import Words
from tests.bench.detection import prediction, samples
from tests.bench.detection import share as emulated_share
from tests.bench.marker_ids import View, share
from tests.cases import repeated
from tests.hardware.mat import nominal

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
    quality = replace(assessed(28.0, 2.3, ExposureState(1 / 167, gain=121.5)), anyway=True)
    ground = replace(nominal(), quality=quality)
    assert read(to_toml(ground)).quality == quality
    assert quality.kept == ExposureKept(1 / 167, 121.5)
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


HARD = View(23.0, 1.5, 350.0, 1 / 60)


def test_robots_wear_markers_that_are_seldom_missed_where_marker_0_often_is():
    assert min(share(number, HARD, 16) for number in ROBOT_IDS) > 0.9
    assert share(0, HARD, 32) < 0.85


def test_a_number_has_one_meaning():
    meanings = Counter([*ROBOT_IDS, *CORNER_IDS, *BLOCK_SIZES])
    assert max(meanings.values()) == 1
    assert not {*WEARERS, *CORNER_IDS} & {*BOARD_IDS}, "a robot that was left on the mat spoils no board"


@pytest.mark.long
@pytest.mark.parametrize("number", [0, *repeated(ROBOT_IDS)])
def test_the_prediction_is_within_5_points_of_an_independent_camera(number):
    seen, told = share(number, HARD, 240), found_share(number, HARD.edge, HARD.blur, HARD.exposure)
    chance = 0.0 if number else 0.05  # both shares are samples, of a half rather than of nearly all
    assert seen == pytest.approx(told, abs=0.05 + chance)


@pytest.mark.long
@pytest.mark.parametrize("light", repeated([0.2, 0.3]))
def test_the_prediction_in_little_light_is_within_5_points_too(light):
    seen = share(16, HARD._replace(light=light), 240)
    assert found_share(16, HARD.edge, HARD.blur, HARD.exposure, light) == pytest.approx(seen, abs=0.05 + 0.05)
    assert seen < found_share(16, HARD.edge, HARD.blur, HARD.exposure)


@pytest.mark.long
@pytest.mark.parametrize(
    ("width", "defocus", "exposure", "numbers"),
    repeated([(1280, 1.5, 1 / 60, ROBOT_IDS), (1280, 1.1, 1 / 60, (0, 1, 2, 3))]),
)
def test_the_prediction_is_within_5_points_of_the_emulated_camera(width, defocus, exposure, numbers):
    found = list(samples(width, defocus, exposure, 40, seed=7, numbers=numbers))
    assert emulated_share(found) == pytest.approx(prediction(found), abs=0.05)


def test_a_worse_picture_promises_less():
    good = found_share(16, 23.0, 1.2, 1 / 60)
    assert good > 0.97
    for worse in ((14.0, 1.2, 1 / 60), (23.0, 2.0, 1 / 60), (23.0, 1.2, 1 / 24)):
        assert found_share(16, *worse) < 0.8
    assert found_share(16, 23.0, 1.2, 0.0) == good, "no figure: judged by edge and blur"
