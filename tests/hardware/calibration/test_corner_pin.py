"""The corner pin maps the picture's corners to their targets, and refuses corners that no picture fits."""

import numpy as np
import pytest

from pigaming_app.hardware.calibration.corner_pin import (
    STRAIGHT,
    CornerPin,
    PerspectiveWarp,
    is_degenerate,
)
from pigaming_app.storage.messages import OperatorError
from tests.hardware.sentences import refused

ASKEW = (40.0, 20.0, 1880.0, 60.0, 1900.0, 1060.0, 10.0, 1000.0)


def picture() -> "np.ndarray[tuple[int, ...], np.dtype[np.uint8]]":
    page = np.zeros((1080, 1920, 4), np.uint8)
    page[...] = 200
    return page


def test_straight_corners_change_nothing() -> None:
    before = np.random.default_rng(1).integers(0, 255, (1080, 1920, 4), dtype=np.uint8)
    assert np.array_equal(PerspectiveWarp(STRAIGHT).apply(before), before)


def test_the_picture_fills_its_quadrangle_and_nothing_else() -> None:
    shown = PerspectiveWarp(ASKEW).apply(picture())
    for x, y in np.array(ASKEW).reshape(4, 2):
        inwards = np.sign((960 - x, 540 - y)).astype(int) * 4
        assert shown[int(y) + inwards[1], int(x) + inwards[0], 0] == 200
        assert shown[max(0, int(y) - inwards[1]), max(0, int(x) - inwards[0]), 0] == 0


def test_a_window_of_another_size_shows_the_same_larger() -> None:
    shown = PerspectiveWarp(ASKEW, (3840, 2160)).apply(picture())
    assert shown.shape == (2160, 3840, 4)
    assert shown[48, 88, 0] == 200
    assert shown[32, 72, 0] == 0


def test_the_mouse_points_at_what_is_seen_under_it() -> None:
    warp = PerspectiveWarp(ASKEW, (960, 540))
    assert warp.to_canvas((20.0, 10.0)) == pytest.approx((0.0, 0.0), abs=1e-6)
    assert warp.to_canvas((950.0, 530.0)) == pytest.approx((1920.0, 1080.0), abs=1e-6)


@pytest.mark.parametrize(
    "corners",
    [
        (0, 0, 1920, 0, 0, 1080, 1920, 1080),  # crossed
        (1920, 0, 0, 0, 1920, 1080, 0, 1080),  # crossed, in a mirror
        (0, 0, 960, 540, 1920, 1080, 0, 1080),  # collinear
        (0, 0, 100, 0, 100, 50, 0, 50),  # tiny
        (0, 0, float("nan"), 0, 1920, 1080, 0, 1080),
        (0, 0, 1920, 0),
    ],
)
def test_corners_into_which_nothing_fits_are_refused(corners: tuple[float, ...]) -> None:
    assert is_degenerate(corners)
    with refused(OperatorError, "fits"):
        CornerPin(corners)
