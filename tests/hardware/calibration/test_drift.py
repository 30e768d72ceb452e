"""The drift monitor detects a moved camera by the four markers in the margins."""

import cv2
import numpy as np
import pytest

from pigaming_app.hardware.calibration.drift import PAUSE, WARN, DriftMonitor, corner_markers
from pigaming_app.hardware.signals import CameraFrame
from pigaming_app.hardware.vision.markers import CORNER_IDS
from tests.hardware.mat import nominal
from tests.hardware.pictures import SIZE, speckled

GROUND = nominal(SIZE)


def projected(shift=(0.0, 0.0), without=()):
    """A picture of the corner markers by a camera that moved by some px."""
    canvas = np.zeros((1080, 1920), np.uint8)
    for number, (left, top, tile) in zip(CORNER_IDS, corner_markers(), strict=True):
        if number not in without:
            canvas[top : top + tile.shape[0], left : left + tile.shape[1]] = tile
    scale = SIZE[0] / 1920.0
    onto = np.array([[scale, 0.0, shift[0]], [0.0, scale, shift[1]]])
    return speckled(cv2.warpAffine(canvas, onto, SIZE, flags=cv2.INTER_AREA) * 0.8 + 20.0)


def watched(pictures, every=0.1):
    drift = DriftMonitor(GROUND)
    for number, picture in enumerate(pictures):
        drift.process(CameraFrame(picture, number * every, number))
    return drift


def test_the_corner_markers_lie_in_the_margins():
    for left, top, tile in corner_markers():
        assert top >= 0
        assert top + tile.shape[0] <= 1080
        assert left + tile.shape[1] <= 160 or left >= 1760


def test_a_camera_that_was_nudged_is_noticed_after_ten_pictures():
    """4 camera px are 6 arena px, 7.9 mm: worth a warning; 9 px are 17.8 mm: unplayable."""
    assert watched([projected((4.0, 0.0))] * 9).mm == 0.0
    nudged = watched([projected((4.0, 0.0))] * 10)
    assert nudged.mm == pytest.approx(4.0 * 1.5 * GROUND.mm, abs=0.8)
    assert nudged.mm > WARN
    assert nudged.mm <= PAUSE
    assert watched([projected((0.0, 9.0))] * 10).mm > PAUSE


def test_a_camera_that_was_knocked_far_is_noticed_too():
    assert watched([projected((90.0, 40.0))] * 110).mm > PAUSE


def test_a_hand_over_three_corners_is_no_drift():
    assert watched([projected(without=CORNER_IDS[1:])] * 12).mm < 1.0
    assert watched([projected(without=CORNER_IDS)] * 12).mm == 0.0


def test_pictures_come_more_often_than_they_are_needed():
    assert watched([projected((9.0, 0.0))] * 20, every=0.003).mm == 0.0


def test_a_knock_is_noticed_within_half_a_second():
    """The median of ten turns with the sixth."""
    assert watched([projected()] * 30 + [projected((3.0, 8.0))] * 15, every=1 / 30).mm > PAUSE


def test_a_camera_that_is_put_back_has_no_drift():
    drift = watched([projected()] * 10 + [projected((20.0, 8.0))] * 20 + [projected()] * 20)
    assert drift.mm < 1.0
