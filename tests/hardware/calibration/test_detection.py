"""Predicted share of found markers: as in pictures of cameras that share no code with it; robots' ids."""

from collections import Counter

import pytest

cv2 = pytest.importorskip("cv2")

from pigaming_app.hardware.calibration.boards import BOARD_IDS  # noqa: E402
from pigaming_app.hardware.calibration.detection import found_share  # noqa: E402
from pigaming_app.hardware.calibration.marker_sheet import BLOCK_SIZES  # noqa: E402
from pigaming_app.hardware.vision.markers import CORNER_IDS, ROBOT_IDS, WEARERS  # noqa: E402
from tests.bench.detection import prediction, samples  # noqa: E402
from tests.bench.detection import share as emulated_share  # noqa: E402
from tests.bench.marker_ids import View, share  # noqa: E402

HARD = View(23.0, 1.5, 350.0, 1 / 60)


def test_robots_wear_markers_that_are_seldom_missed_where_marker_0_often_is():
    assert min(share(number, HARD, 32) for number in ROBOT_IDS) > 0.9
    assert share(0, HARD, 32) < 0.85


def test_a_number_has_one_meaning():
    meanings = Counter([*ROBOT_IDS, *CORNER_IDS, *BLOCK_SIZES])
    assert max(meanings.values()) == 1
    assert not {*WEARERS, *CORNER_IDS} & {*BOARD_IDS}, "a robot that was left on the mat spoils no board"


@pytest.mark.long
@pytest.mark.parametrize("number", [0, *ROBOT_IDS])
def test_the_prediction_is_within_5_points_of_an_independent_camera(number):
    seen, told = share(number, HARD, 240), found_share(number, HARD.edge, HARD.blur, HARD.exposure)
    chance = 0.0 if number else 0.05  # both shares are samples, of a half rather than of nearly all
    assert seen == pytest.approx(told, abs=0.05 + chance)


@pytest.mark.long
@pytest.mark.parametrize(
    ("width", "defocus", "exposure", "numbers"),
    [
        (1280, 1.5, 1 / 60, ROBOT_IDS),
        (1280, 1.1, 1 / 60, (0, 1, 2, 3)),
    ],
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
