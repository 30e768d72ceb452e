"""Sharpness and light of a picture: blur of the outer edges of its markers, and their contrast.

An edge between black and white, averaged along its length, rises from 16 % to 84 % within two standard deviations of a
Gaussian blur.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.signals import DetectedMarker, Image

CELLS = 6  # across a marker with its black rim
REACH = 0.9  # half length of a profile, cells: the rim is one cell wide, and so is the white margin at least
PROFILES, SAMPLES = 9, 61  # per edge; samples per profile
ALONG = np.linspace(0.2, 0.8, PROFILES)
ACROSS = np.linspace(-1.0, 1.0, SAMPLES)
MIDDLE = SAMPLES // 2
ENDS = 8  # darkest and brightest samples that give black and white
LOW, HIGH = 0.1587, 0.8413  # of a Gaussian at one standard deviation to each side
INTERPOLATED = 1.0 / 6.0  # px^2, variance added by linear interpolation
FLAT = 12.0  # grey levels of contrast below which an edge is ignored
SATURATED, SATURATED_SHARE = 254, 0.02  # grey level; share of a marker's px beyond noise
SHARPEST = 0.3  # px, of a picture whose every px is black or white


class LightField(NamedTuple):
    """Light of a board: that of its darkest place, as a share of the usual one; flicker from picture to picture, as a
    share, where it is strongest. `softest`, `darkest`: markers at the places with the most blur and the least light.
    """

    light: float = 1.0
    flicker: float = 0.0
    softest: int = -1
    darkest: int = -1


def blur_of(cv: Any, image: Image, marks: Sequence[DetectedMarker]) -> list[float]:
    """Blur of each marker, standard deviation in px; markers without a clear edge are left out.

    The corners must be exact (`MarkerDetector.refine`).
    """
    blurs = []
    for mark in marks:
        edges = [
            width for i in range(4) if (width := _edge(cv, image, mark.corners[i - 1], mark.corners[i])) is not None
        ]
        if edges:
            blurs.append(float(np.sqrt(max(SHARPEST**2, float(np.median(edges)) ** 2 - INTERPOLATED))))
    return blurs


def contrasts_of(image: Image, marks: Sequence[DetectedMarker]) -> NDArray[np.float64]:
    """Light of each marker, (n,): grey levels by which the white around it is brighter than its rim, 0 or more."""
    corners = np.array([mark.corners for mark in marks]).reshape(-1, 4, 1, 2)
    middles, after = corners.mean(axis=1, keepdims=True), np.roll(corners, -1, axis=1)
    edges = corners + (after - corners) * ALONG[:, None] - middles
    white, rim = (_levels(image, middles + edges * (1.0 + side / CELLS)) for side in (1.0, -1.0))
    return np.maximum(white - rim, 0.0)


def overexposed(image: Image, marks: Sequence[DetectedMarker]) -> bool:
    """True if the white of a marker is saturated: its edges then look sharper than they are."""
    for mark in marks:
        (left, top), (right, bottom) = mark.corners.min(axis=0).astype(int), mark.corners.max(axis=0).astype(int)
        inside = image[max(0, top) : bottom + 1, max(0, left) : right + 1]
        if np.count_nonzero(inside >= SATURATED) > SATURATED_SHARE * inside.size:
            return True
    return False


def _levels(image: Image, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Mean grey level at the points (n, 4, m, 2) of each of n markers."""
    at = np.clip(np.rint(points).astype(int), 0, np.array(image.shape[::-1]) - 1)
    return np.asarray(image[at[..., 1], at[..., 0]].mean(axis=(1, 2)), np.float64)


def _edge(cv: Any, image: Image, begin: NDArray[np.float64], end: NDArray[np.float64]) -> float | None:
    """Standard deviation of one edge, px, or None if it has too little contrast."""
    way = end - begin
    length = float(np.hypot(*way))
    reach = REACH * length / CELLS
    out = np.array([way[1], -way[0]]) / length
    points = begin + way * ALONG[:, None, None] + out * (reach * ACROSS)[:, None]
    maps = points.reshape(PROFILES, SAMPLES, 2).astype(np.float32)
    values = cv.remap(image, maps[..., 0], maps[..., 1], cv.INTER_LINEAR).astype(np.float64).mean(axis=0)
    darkest, brightest = int(values[:MIDDLE].argmin()), MIDDLE + int(values[MIDDLE:].argmax())
    low, high = np.sort(values[:MIDDLE])[:ENDS].mean(), np.sort(values[MIDDLE:])[-ENDS:].mean()
    if high - low < FLAT:
        return None
    rise = slice(darkest, brightest + 1)  # beyond it, light of the neighbouring cells
    share = np.maximum.accumulate((values[rise] - low) / (high - low))
    below, above = (float(np.interp(level, share, ACROSS[rise])) for level in (LOW, HIGH))
    return 0.5 * (above - below) * reach
