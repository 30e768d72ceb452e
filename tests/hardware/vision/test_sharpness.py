"""Blur of a marker's edges: a known one is measured."""

import numpy as np
import pytest

cv2 = pytest.importorskip("cv2")

from pigaming_app.hardware.vision.markers import MarkerDetector  # noqa: E402
from pigaming_app.hardware.vision.sharpness import blur_of, overexposed  # noqa: E402

FINE = 8  # texels per px


@pytest.mark.parametrize("blur", [0.6, 1.2, 2.2, 3.0])
def test_a_known_blur_is_measured_on_a_turned_and_noisy_marker(blur):
    edge, words = 90 * FINE, cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    page = np.full((2 * edge, 2 * edge), 200, np.uint8)
    marker = cv2.resize(cv2.aruco.generateImageMarker(words, 17, 6), (edge, edge), interpolation=cv2.INTER_NEAREST)
    page[edge // 2 : edge // 2 + edge, edge // 2 : edge // 2 + edge] = np.where(marker > 0, 200, 20)
    page = cv2.warpAffine(page, cv2.getRotationMatrix2D((edge, edge), 13, 1), page.shape, borderValue=200)
    page = cv2.resize(page, None, fx=1 / FINE, fy=1 / FINE, interpolation=cv2.INTER_AREA)
    page = cv2.GaussianBlur(page, (0, 0), blur).astype(float)
    image = np.clip(page + np.random.default_rng(1).normal(0, 2.5, page.shape), 0, 255).astype(np.uint8)
    detector = MarkerDetector([17])
    (measured,) = blur_of(cv2, image, detector.refine(image, detector.detect(image)))
    assert measured == pytest.approx(blur, abs=0.1, rel=0.06)
    assert blur_of(cv2, np.full_like(image, 90), detector.detect(image)) == []
    bright = np.clip(image * 1.5, 0, 255).astype(np.uint8)
    assert overexposed(bright, detector.detect(image))
    assert not overexposed(image, detector.detect(image))
