"""Projectors that hang askew or shine by a mirror, uneven light, and flicker.

Projector, camera and their geometry are this file's and `pictures`'; nothing of the emulator is used.
"""

from math import cos, radians, sin
from types import SimpleNamespace
from typing import Any

import cv2
import numpy as np
import pytest

from pigaming_app.hardware.calibration import height_procedure
from pigaming_app.hardware.calibration.boards import ARENA_AT, BOARD, CANVAS, HELD_OUT, BoardSamples
from pigaming_app.hardware.calibration.camera_position import height_by_ruler
from pigaming_app.hardware.calibration.corner_pin import STRAIGHT, PerspectiveWarp, is_turned_over, pin_of, turned_over
from pigaming_app.hardware.calibration.ground_plane import MAX_KEYSTONE, CalibrationError
from pigaming_app.hardware.calibration.height_procedure import PLACES, STILL, HeightProcedure
from pigaming_app.hardware.calibration.printed import PRINTED_PLACES, PrintedSamples
from pigaming_app.hardware.calibration.quality import assessed
from pigaming_app.hardware.calibration.site import CalibrationSite
from pigaming_app.hardware.calibration.solver import solve, verify
from pigaming_app.hardware.session.robot_session import camera_warning
from pigaming_app.hardware.signals import CameraFrame, DetectedMarker, ExposureState
from pigaming_app.hardware.tracking.tracker import Tracker
from pigaming_app.hardware.vision.markers import ROBOT_IDS
from tests.hardware.pictures import MM, SIZE, Pinhole, speckled, square
from tests.hardware.sentences import refused

CAMERA = Pinhole()
EDGE = 50.0 / MM  # nominal arena px, of a robot's marker
WIDTH, HEIGHT = CANVAS
RIM = np.array(STRAIGHT).reshape(4, 2)
SMALLER = 0.8  # of a pinned picture, which leaves room for the keystone
SHARP = ExposureState(1 / 100)


def throw(degrees, mirrored=False, ratio=1.5):
    """The homography (3, 3) from px of a projector to the mat, in px of a canvas that would fall on it straight.

    The projector is a pinhole with this throw ratio, tilted about its horizontal axis; a mirror exchanges the sides.
    """
    a = radians(degrees)
    rays = np.column_stack([(RIM - (960.0, 540.0)) / WIDTH / ratio, np.ones(4)])
    rays = rays @ np.array([[1.0, 0.0, 0.0], [0.0, cos(a), sin(a)], [0.0, -sin(a), cos(a)]])
    spots = rays[:, :2] / rays[:, 2:]
    spots = (spots - spots.mean(axis=0)) * WIDTH / np.ptp(spots[:, 0]) + (960.0, 540.0)
    if mirrored:
        spots[:, 0] = WIDTH - spots[:, 0]
    return cv2.getPerspectiveTransform(RIM.astype(np.float32), spots.astype(np.float32))


def on_the_mat(matrix, points):
    image = np.column_stack([points, np.ones(len(points))]) @ matrix.T
    return image[:, :2] / image[:, 2:]


def photo(board, matrix, corners=()):
    """A picture of a board, pinned to corners, by this projector."""
    window = board.picture()
    if len(corners):
        window = PerspectiveWarp(corners).apply(np.repeat(window[..., None], 4, axis=2))[..., 0]
    shift = np.array([[1.0, 0.0, -0.5], [0.0, 1.0, -0.5], [0.0, 0.0, 1.0]])  # the matrix counts from edges of px
    return CAMERA.photo(cv2.warpPerspective(window, shift @ matrix @ np.linalg.inv(shift), CANVAS))


def looked_at(picture, samples=None):
    samples = samples or BoardSamples()
    for number in range(10):
        samples.add(CameraFrame(speckled(picture, 2.0, number), number / 30.0, number))
    return samples


def pinned(matrix, mirrored):
    """Corners with which this projector shows an upright rectangle, smaller by SMALLER, as by hand; that rectangle."""
    box = (RIM - (960.0, 540.0)) * SMALLER + (960.0, 540.0)
    corners = on_the_mat(np.linalg.inv(matrix), box).ravel().tolist()
    assert is_turned_over(corners) == mirrored
    return corners, box


@pytest.mark.parametrize(("degrees", "mirrored"), [(30.0, True), (25.0, False)])
def test_a_projector_at_an_angle_or_by_a_mirror_calibrates_once_it_is_pinned(degrees, mirrored):
    matrix = throw(degrees, mirrored)
    corners, box = pinned(matrix, mirrored)
    samples, other = (looked_at(photo(board, matrix, corners)) for board in (BOARD, HELD_OUT))
    ground = solve(samples.corners(), BOARD, samples.size, 1600.0 * MM * SMALLER, "1")
    assert verify(ground, other.corners(), HELD_OUT).accepted
    x, y = np.meshgrid(np.linspace(0, 1600, 9), np.linspace(0, 900, 7))
    places = np.column_stack([x.ravel(), y.ravel()])
    there = box[0] + (places + ARENA_AT) * SMALLER - ARENA_AT  # where the picture is on the mat
    errors = np.hypot(*(ground.on_mat(CAMERA.sees(there)) - places).T) * MM * SMALLER
    assert errors.max() < 1.5


def test_a_mirror_is_named_and_the_picture_turned_over_calibrates():
    matrix = throw(0.0, mirrored=True)
    with refused(CalibrationError, "mirrored"):
        looked_at(photo(BOARD, matrix)).corners()
    corners = turned_over(())
    assert is_turned_over(corners)
    assert looked_at(photo(BOARD, matrix, corners)).corners()
    pin = pin_of(corners)
    assert pin is not None
    assert tuple(turned_over(pin.corners)) == STRAIGHT
    assert pin_of(turned_over(pin.corners)) is None
    with refused(CalibrationError, "mirrored"):  # and too much of it is as bad as nothing
        looked_at(photo(BOARD, throw(0.0), corners)).corners()


def test_a_camera_that_mirrors_a_printed_floor_is_named():
    page = np.full((HEIGHT, WIDTH), 235, np.uint8)
    words = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    for number, (x, y) in PRINTED_PLACES.items():
        page[y - 42 : y + 42, x - 42 : x + 42] = np.minimum(cv2.aruco.generateImageMarker(words, number, 84), 235)
    picture = CAMERA.photo(page)
    assert looked_at(picture, PrintedSamples()).corners()
    with refused(CalibrationError, "camera mirrors"):
        looked_at(picture[:, ::-1].copy(), PrintedSamples()).corners()


def ground_of(matrix):
    """The calibration of a projector without a pin: the board's corners, as the camera sees them, without noise."""
    seen = {
        number: CAMERA.sees(on_the_mat(matrix, corners + ARENA_AT) - ARENA_AT)
        for number, corners in BOARD.corners.items()
    }
    rim = on_the_mat(matrix, np.array([(160.0, 590.0), (1760.0, 590.0)]))
    width = float(np.hypot(*(rim[1] - rim[0]))) * MM
    return height_by_ruler(solve(seen, BOARD, SIZE, width, "1"), 2400.0)


def mark_at(matrix, place, number, heading=0.4):
    """A robot's marker on its lid at a place of the arena, arena px, as the camera sees it."""
    there = on_the_mat(matrix, np.array([place]) + ARENA_AT)[0] - ARENA_AT
    return DetectedMarker(number, CAMERA.sees(square((*there, heading), EDGE), 70.0))


@pytest.mark.parametrize(("degrees", "named"), [(0.0, False), (3.0, False), (13.0, True)])
def test_an_image_that_is_no_rectangle_is_named_by_robots_that_drive(degrees, named):
    """The board cannot show it: whatever the camera sees is taken for the mat."""
    matrix = throw(degrees)
    ground = ground_of(matrix)
    tracker = Tracker(ground, lambda: 0.0)
    random = np.random.default_rng(3)
    for number in range(60):
        places = [(x + 500 * random.random(), y + 300 * random.random()) for x in (100, 1000) for y in (50, 550)]
        marks = [mark_at(matrix, *at) for at in zip(places, ROBOT_IDS, strict=True)]
        tracker.correct(
            [DetectedMarker(mark.number, mark.corners + random.normal(0.0, 0.1, (4, 2))) for mark in marks],
            0.11 * (number + 1),
        )
    assert (tracker.keystone > MAX_KEYSTONE) == named

    rig: Any = SimpleNamespace(tracker=tracker, camera=SimpleNamespace(exposure=SHARP))
    session: Any = SimpleNamespace(quality=None)
    warning = camera_warning(session, rig)
    assert (warning.key if warning else "") == ("keystone" if named else "")


@pytest.mark.parametrize(("degrees", "named"), [(0.0, False), (13.0, True)])
def test_an_image_that_is_no_rectangle_is_refused_by_a_robot_on_the_outlines(degrees, named, monkeypatch):
    matrix = throw(degrees)
    work = HeightProcedure(CalibrationSite(), 0, ground_of(matrix))
    site = type("Site", (CalibrationSite,), {"settle": 0.0, "clock": staticmethod(lambda: 0.0)})()
    work.site, work._since = site, 0.0
    now = 0.0
    while work.place is not None:
        work.mark_shown(work.place)
        mark = mark_at(matrix, PLACES[work.place], ROBOT_IDS[0])
        monkeypatch.setattr(
            height_procedure,
            "MarkerDetector",
            lambda ids, mark=mark: type("Detector", (), {"detect": lambda self, image: [mark]})(),
        )
        work._markers = None
        for _ in range(STILL + 1):
            now += 0.5
            work.process(CameraFrame(np.zeros((2, 2), np.uint8), now, 0))
    assert (work.fault.key if work.fault else "") == ("keystone" if named else "")


def test_light_is_measured_over_the_field_and_a_dark_corner_is_named_with_its_place():
    plain = photo(BOARD, throw(0.0)).astype(float)
    even = looked_at(np.clip(plain, 0, 255).astype(np.uint8)).light()
    assert even.light == pytest.approx(1.0, abs=0.06)
    assert even.flicker < 0.05
    across, down = np.meshgrid(np.linspace(0.0, 1.0, SIZE[0]), np.linspace(0.0, 1.0, SIZE[1]))
    fall = 1.05 - 0.6 * np.hypot(across, down)  # darkest at the lower right
    dim = looked_at((plain * fall).astype(np.uint8)).light()
    spots = {number: CAMERA.sees(corners).mean(axis=0).astype(int) for number, corners in BOARD.corners.items()}
    truth = [fall[y, x] for x, y in spots.values()]
    assert dim.light == pytest.approx(np.percentile(truth, 10.0) / np.median(truth), abs=0.05)
    x, y = BOARD.corners[dim.darkest].mean(axis=0)
    assert x > 800
    assert y > 450
    quality = assessed(24.0, 1.0, SHARP, dim._replace(light=0.12))
    assert quality.cause == "finds_dim"
    assert not quality.sufficient
    assert assessed(24.0, 1.0, SHARP, even).sufficient


def test_the_measured_light_is_that_of_the_darkest_tenth():
    """Four of the markers, more than a tenth, get a quarter of the light."""
    plain = photo(BOARD, throw(0.0))
    dark = plain.copy()
    spots = [CAMERA.sees(BOARD.corners[number]) for number in list(BOARD.corners)[:5]]
    for spot in spots:
        (left, top), (right, bottom) = spot.min(axis=0).astype(int) - 12, spot.max(axis=0).astype(int) + 12
        dark[max(top, 0) : bottom, max(left, 0) : right] //= 4
    assert looked_at(dark).light().light == pytest.approx(0.25, abs=0.03)


def test_flicker_is_measured_and_warned_about():
    plain, samples = photo(BOARD, throw(0.0)), BoardSamples()
    for number in range(10):
        share = 1.0 if number % 2 else 0.5
        samples.add(CameraFrame(speckled(plain * share, 2.0, number), number / 30.0, number))
    field = samples.light()
    assert field.flicker == pytest.approx(0.5 / 0.75, abs=0.04)
    advice = assessed(36.0, 0.8, SHARP, field).advice
    assert advice is not None
    assert advice.key == "flickers"
