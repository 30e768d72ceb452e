"""The solver calibrates from photos of a board, and refuses unusable ones."""

import numpy as np
import pytest

from pigaming_app.hardware.calibration.boards import ARENA_AT, BOARD, BOARD_IDS, CANVAS, HELD_OUT, BoardSamples
from pigaming_app.hardware.calibration.camera_position import height_by_robot, height_by_ruler
from pigaming_app.hardware.calibration.ground_plane import CalibrationError
from pigaming_app.hardware.calibration.least_squares import least_squares
from pigaming_app.hardware.calibration.solver import homography, solve, verify, with_verification
from pigaming_app.hardware.signals import CameraFrame
from tests.hardware.pictures import MM, SIZE, Pinhole, speckled
from tests.hardware.sentences import refused

CAMERA = Pinhole()
WIDTH_MM = 1600.0 * MM


def perfect(board, camera=CAMERA):
    """Corners of a board without noise, camera px."""
    return {number: camera.sees(corners) for number, corners in board.corners.items()}


def true_error_mm(ground, height=0.0):
    """The largest error of a calibration over the arena against ground truth, mm."""
    x, y = np.meshgrid(np.linspace(0, 1600, 9), np.linspace(0, 900, 7))
    places = np.column_stack([x.ravel(), y.ravel()])
    return np.sqrt(((ground.at_height(CAMERA.sees(places, height), height) - places) ** 2).sum(axis=1)).max() * MM


@pytest.fixture(scope="module")
def photos():
    return {board: CAMERA.photo(board.picture()) for board in (BOARD, HELD_OUT)}


def looked_at(photo, frames=10):
    look = BoardSamples()
    for number in range(frames):
        look.add(CameraFrame(speckled(photo, 2.0, number), number / 30.0, number))
    return look


def test_boards_lie_on_the_canvas_and_not_on_each_other():
    for board in (BOARD, HELD_OUT):
        corners = np.concatenate(list(board.corners.values())) + ARENA_AT
        assert corners.min() > 10
        assert corners[:, 0].max() < CANVAS[0] - 10
        assert corners[:, 1].max() < CANVAS[1] - 10
        assert tuple(board.corners) == BOARD_IDS
    assert all(np.abs(BOARD.corners[n] - HELD_OUT.corners[n]).max() > 15 for n in BOARD_IDS)


def test_the_picture_has_its_markers_where_it_says():
    look = BoardSamples()
    assert look.add(CameraFrame(BOARD.picture(), 0.0, 0)) == 35
    corners = look.corners()
    assert max(np.abs(corners[n] - ARENA_AT - BOARD.corners[n]).max() for n in BOARD_IDS) < 0.6


def test_a_calibration_from_photos_is_true_to_a_millimetre_on_the_other_board(photos):
    look, other = looked_at(photos[BOARD]), looked_at(photos[HELD_OUT])
    assert look.ready
    ground = solve(look.corners(), BOARD, look.size, WIDTH_MM, "1")
    residuals = verify(ground, other.corners(), HELD_OUT)
    assert residuals.accepted
    assert residuals.mean_mm < 1.0
    assert true_error_mm(ground) < 1.5
    assert with_verification(ground, residuals).mean_mm == residuals.mean_mm
    assert residuals.places.shape == residuals.misses.shape


def test_lens_and_plane_are_recovered_exactly_where_there_is_no_noise():
    ground = solve(perfect(BOARD), BOARD, SIZE, WIDTH_MM, "1")
    assert true_error_mm(ground) < 0.01
    assert ground.lens.centre == pytest.approx(tuple(CAMERA.centre), abs=0.2)
    # the package normalizes by the picture's width, the ground truth by the focal length
    assert ground.lens.k1 == pytest.approx(CAMERA.k1 * (SIZE[0] / CAMERA.focal) ** 2, rel=0.01)


def test_without_the_lens_a_calibration_would_be_refused():
    """The best homography alone leaves errors of centimetres."""
    seen = perfect(BOARD)
    places, points = np.concatenate(list(BOARD.corners.values())), np.concatenate(list(seen.values()))
    flat = np.column_stack([points, np.ones(len(points))]) @ homography(points, places).T
    assert np.abs(flat[:, :2] / flat[:, 2:] - places).max() * MM > 3.0


def test_a_few_wrong_markers_do_no_harm():
    seen = perfect(BOARD)
    for number in (18, 30, 41):
        seen[number] = seen[number] + (25.0, -14.0)
    assert true_error_mm(solve(seen, BOARD, SIZE, WIDTH_MM, "1")) < 0.01


def test_a_board_in_the_wrong_place_is_found_out():
    """The first board projected in place of the second must fail the verification."""
    ground = solve(perfect(BOARD), BOARD, SIZE, WIDTH_MM, "1")
    residuals = verify(ground, perfect(BOARD), HELD_OUT)
    assert not residuals.accepted
    with refused(CalibrationError, r"limits are 1\.5 and 3"):
        with_verification(ground, residuals)


def test_markers_in_a_heap_are_no_board():
    seen = {number: CAMERA.sees(np.random.default_rng(number).uniform(0, 900, (4, 2))) for number in BOARD_IDS}
    with refused(CalibrationError, r"^[^\n]*$"):
        with_verification(
            ground := solve(seen, BOARD, SIZE, WIDTH_MM, "1"),
            verify(ground, perfect(HELD_OUT), HELD_OUT),
        )


def test_a_dark_picture_is_no_board():
    look = BoardSamples()
    look.add(CameraFrame(np.full((720, 1280), 8, np.uint8), 0.0, 0))
    with refused(CalibrationError, "sees 0 of 35"):
        look.corners()


def test_a_board_of_which_a_corner_is_missing_says_which(photos):
    photo = photos[BOARD].copy()
    corner = CAMERA.sees(np.array([[-160.0, -140.0], [480.0, 300.0]]))
    photo[: int(corner[1, 1]), : int(corner[1, 0])] = 20
    with refused(CalibrationError, "top left corner"):
        looked_at(photo).corners()


def test_a_camera_that_is_moved_meanwhile_is_noticed(photos):
    look = BoardSamples()
    for number in range(10):
        look.add(CameraFrame(np.roll(photos[BOARD], 3 * number, axis=1), 0.0, number))
    with refused(CalibrationError, "shakes by"):
        look.corners()


def test_the_place_of_the_camera_follows_from_its_height():
    ground = height_by_ruler(solve(perfect(BOARD), BOARD, SIZE, WIDTH_MM, "1"), 2400.0)
    assert ground.foot == pytest.approx((760.0, 430.0), abs=1.0)
    assert true_error_mm(ground, 70.0) < 0.1


@pytest.mark.parametrize("tilt", [(0.0, 0.0), (0.3, -0.3), (-0.35, 0.1)])
def test_the_place_of_the_camera_is_found_however_it_looks_down(tilt):
    camera = Pinhole(tilt=tilt, height=3000.0)
    ground = height_by_ruler(solve(perfect(BOARD, camera), BOARD, SIZE, WIDTH_MM, "1"), 3000.0)
    assert ground.foot == pytest.approx((760.0, 430.0), abs=2.0)


def test_a_height_that_does_not_fit_how_the_mat_looks_is_refused():
    """From straight above, a wrong height is equivalent to another focal length; from the side it is not."""
    camera = Pinhole(tilt=(0.3, -0.3), height=3000.0)
    with refused(CalibrationError, "does not match a camera height of 900 mm"):
        height_by_ruler(solve(perfect(BOARD, camera), BOARD, SIZE, WIDTH_MM, "1"), 900.0)


def test_a_ruler_that_is_wrong_by_a_hand_costs_a_millimetre_or_two():
    ground = height_by_ruler(solve(perfect(BOARD), BOARD, SIZE, WIDTH_MM, "1"), 2320.0)
    assert true_error_mm(ground, 70.0) < 2.0


@pytest.mark.parametrize("height", [0.0, 100.0, float("nan"), 1e6])
def test_no_camera_hangs_there(height):
    with pytest.raises(CalibrationError):
        height_by_ruler(solve(perfect(BOARD), BOARD, SIZE, WIDTH_MM, "1"), height)


def test_the_place_of_the_camera_follows_from_a_robot_on_four_outlines():
    ground = solve(perfect(BOARD), BOARD, SIZE, WIDTH_MM, "1")
    places = [(200.0, 200.0), (1400.0, 200.0), (1400.0, 700.0), (200.0, 700.0)]
    found = height_by_robot(ground, places, CAMERA.sees(np.array(places), 70.0))
    assert found.foot == pytest.approx((760.0, 430.0), abs=2.0)
    assert found.height == pytest.approx(2400.0, abs=10.0)
    assert true_error_mm(found, 70.0) < 0.1


def test_a_robot_beside_the_outlines_is_refused():
    ground = solve(perfect(BOARD), BOARD, SIZE, WIDTH_MM, "1")
    places = [(200.0, 200.0), (1400.0, 200.0)]
    with refused(CalibrationError, "outlines"):
        height_by_robot(ground, places, CAMERA.sees(np.array([(400.0, 200.0), (1200.0, 200.0)])))
    with refused(CalibrationError, "too close together"):
        height_by_robot(ground, places[:1], CAMERA.sees(np.array(places[:1])))


def test_least_squares_finds_a_valley_that_is_bent():
    """Rosenbrock's function (H. H. Rosenbrock, 1960) has its minimum at (1, 1)."""
    found = least_squares(lambda p: np.array([10.0 * (p[1] - p[0] ** 2), 1.0 - p[0]]), np.array([-1.2, 1.0]), 200).at
    assert found == pytest.approx([1.0, 1.0], abs=1e-6)
