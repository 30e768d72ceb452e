"""Marker detection: all sizes, projected light, blur, dim light, and both major versions of OpenCV; measured blur."""

from typing import Any

import cv2
import numpy as np
import pytest

from pigaming_app.hardware.signals import DetectedMarker
from pigaming_app.hardware.vision.markers import ROBOT_IDS, MarkerDetector, SearchWindow, detections
from pigaming_app.hardware.vision.sharpness import blur_of, overexposed
from tests.hardware.pictures import SIZE, lids, speckled, square

IDS = (0, 1, 2, 3, *ROBOT_IDS)
FINE = 8  # texels per px


def test_markers_of_others_are_not_looked_at():
    places = ((0, (200.0, 200.0, 0.4)), (18, (800.0, 200.0, 2.0)), (11, (600.0, 500.0, 4.0)))
    picture = speckled(lids([(number, square(pose, 30.0)) for number, pose in places], SIZE))
    found = MarkerDetector(IDS).detect(picture)
    assert [mark.number for mark in found] == [0]


@pytest.mark.parametrize("edge", [26.0, 30.0, 38.0, 60.0])
@pytest.mark.parametrize("way", ["detect_quickly", "detect_in", "detect"])
def test_markers_are_found_however_large(edge, way):
    corners = square((400.3, 300.8, 0.7), edge)
    picture = speckled(lids([(3, corners)], SIZE))
    markers = MarkerDetector(IDS)
    found: Any = {
        "detect_quickly": lambda: markers.detect_quickly(picture, edge, dim=False),
        "detect_in": lambda: [markers.detect_in(picture, SearchWindow(405.0, 296.0, 1.3 * edge + 8.0, edge), 3)],
        "detect": lambda: markers.detect(picture),
    }[way]()
    assert [mark.number for mark in found] == [3]
    assert np.abs(markers.refine(picture, found)[0].corners - corners).max() < 0.4


def striped(corners, bright=210):
    """A dimly lit robot with bright stripes projected across its marker."""
    picture = 20.0 + 0.25 * lids([(3, corners)], SIZE, ground=170.0)
    white = picture > 40.0
    for left in range(0, SIZE[0], 40):
        stripe = np.zeros(picture.shape, bool)
        stripe[:, left : left + 8] = True
        picture[stripe & white] = bright
    return speckled(cv2.GaussianBlur(picture, (0, 0), 0.7))


def test_what_is_projected_across_a_marker_does_not_hide_it():
    """Hard bright edges hide a marker from the plain detector (it finds 0 to 48 %); its black stays darkest."""
    markers = MarkerDetector(IDS)
    near, glanced, tries = 0, 0, 20
    for i in range(tries):
        corners = square((400.0 + 2 * i, 300.0 + i, 0.3 * i), 37.0)
        picture = striped(corners)
        mark = markers.detect_in(picture, SearchWindow(402.0 + 2 * i, 298.0 + i, 52.0, 37.0), 3)
        near += mark is not None
        glanced += len(markers.detect_quickly(picture, 37.0))
    assert near == tries
    assert glanced >= 0.8 * tries


def test_a_blurred_marker_is_found_where_it_must_be():
    """As with a defocused lens, or in a long exposure of a turning robot."""
    markers = MarkerDetector(IDS)
    for i in range(10):
        corners = square((400.0 + 2 * i, 300.0 + i, 0.3 * i), 37.0)
        picture = cv2.GaussianBlur(lids([(3, corners)], SIZE, ground=150.0), (0, 0), 2.2)
        assert markers.detect_in(speckled(picture), SearchWindow(402.0 + 2 * i, 298.0 + i, 52.0, 37.0), 3) is not None


@pytest.mark.parametrize("light", [0.2, 0.5, 1.0])
def test_markers_are_found_in_dim_light(light):
    markers = MarkerDetector(IDS)
    for i in range(5):
        corners = square((400.0 + 2 * i, 300.0 + i, 0.3 * i), 37.0)
        picture = speckled(light * lids([(3, corners)], SIZE, ground=150.0), noise=1.5)
        assert markers.detect_in(picture, SearchWindow(402.0 + 2 * i, 298.0 + i, 52.0, 37.0), 3) is not None
        assert len(markers.detect_quickly(picture, 37.0)) == 1


def test_corners_are_exact_to_a_tenth_of_a_pixel():
    markers = MarkerDetector(IDS)
    misses = []
    for i in range(12):
        corners = square((400.3 + 0.37 * i, 300.8 - 0.21 * i, 0.7 + 0.5 * i), 34.0)
        picture = speckled(lids([(3, corners)], SIZE), seed=i)
        mark = markers.detect_in(picture, SearchWindow(402.0, 298.0, 52.0, 34.0), 3)
        assert mark is not None
        misses.append(markers.refine(picture, [mark])[0].corners - corners)
    assert np.sqrt(np.square(misses).mean()) < 0.1
    assert np.abs(np.mean(misses, axis=1)).max() < 0.1  # of the middle


def test_corners_that_cannot_be_made_exact_stay_as_they_are():
    corners = square((400.0, 300.0, 0.2), 34.0)
    for picture in (np.full((720, 1280), 90, np.uint8), np.zeros((720, 1280), np.uint8)):
        assert np.array_equal(MarkerDetector(IDS).refine(picture, [DetectedMarker(0, corners)])[0].corners, corners)
    assert MarkerDetector(IDS).refine(picture, []) == []


def test_near_the_edge_of_the_picture_a_marker_is_found_if_it_is_all_there():
    corners = square((40.0, 36.0, 0.2), 34.0)
    picture = speckled(lids([(1, corners)], SIZE))
    markers = MarkerDetector(IDS)
    assert markers.detect_in(picture, SearchWindow(40.0, 36.0, 60.0, 34.0), 1) is not None
    assert markers.detect_in(picture, SearchWindow(-300.0, 36.0, 60.0, 34.0), 1) is None


@pytest.mark.parametrize(
    ("corners", "ids", "numbers"),
    [
        ([np.full((1, 4, 2), 7.0, np.float32)], np.array([[5]], np.int32), [5]),  # OpenCV 4
        (np.full((1, 4, 2), 7.0, np.float32), np.array([5], np.int32), [5]),  # OpenCV 5
        ((), None, []),
        ([], np.zeros((0, 1), np.int32), []),
    ],
)
def test_both_lines_of_opencv_are_read_alike(corners, ids, numbers):
    found, named = detections(corners, ids)
    assert found.shape == (len(numbers), 4, 2)
    assert named.tolist() == numbers


@pytest.mark.parametrize("blur", [0.6, 1.2, 2.2, 3.0])
def test_a_known_blur_is_measured_on_a_turned_and_noisy_marker(blur):
    edge, words = 90 * FINE, cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    page = np.full((2 * edge, 2 * edge), 200, np.uint8)
    marker = cv2.resize(cv2.aruco.generateImageMarker(words, 17, 6), (edge, edge), interpolation=cv2.INTER_NEAREST)
    page[edge // 2 : edge // 2 + edge, edge // 2 : edge // 2 + edge] = np.where(marker > 0, 200, 20)
    seen = cv2.warpAffine(page, cv2.getRotationMatrix2D((edge, edge), 13, 1), page.shape, borderValue=200)
    seen = cv2.resize(seen, None, fx=1 / FINE, fy=1 / FINE, interpolation=cv2.INTER_AREA)
    seen = cv2.GaussianBlur(seen, (0, 0), blur).astype(float)
    image = np.clip(seen + np.random.default_rng(1).normal(0, 2.5, seen.shape), 0, 255).astype(np.uint8)
    detector = MarkerDetector([17])
    (measured,) = blur_of(cv2, image, detector.refine(image, detector.detect(image)))
    assert measured == pytest.approx(blur, abs=0.1, rel=0.06)
    assert blur_of(cv2, np.full_like(image, 90), detector.detect(image)) == []
    bright = np.clip(image * 1.5, 0, 255).astype(np.uint8)
    assert overexposed(bright, detector.detect(image))
    assert not overexposed(image, detector.detect(image))
