"""The camera picture to be expected of a scanned mat, for any projected picture.

A px of the camera sees room light, plus projected light from the canvas px that lights its point: both are known from
the scan, as is the response of projector and camera to grey levels. Everything is on a coarse grid of the canvas.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.boards import CANVAS, LIGHT
from pigaming_app.hardware.scan.convex import Pixels
from pigaming_app.hardware.scan.heights import Map, Mask, Rectified, Surface, plane_displacement
from pigaming_app.hardware.scan.patterns import PATTERNS, flat_phase
from pigaming_app.hardware.scan.things import ProjectorPlace
from pigaming_app.hardware.signals import Image
from pigaming_app.hardware.vision.markers import opencv

CELL = 6  # canvas px
SHRUNK = 4  # canvas px per px of the pictures kept of the canvas
FAINT = 2.0  # grey levels of the fringes, below which a cell shows shadow or something black
ROUGH = 12.0  # mm by which the heights of neighbouring cells may differ
LEVELS = 16  # of the response curve


class Light(NamedTuple):
    """Expected grey levels of each cell: room light, and the least and the greatest projected light."""

    room: Map
    least: Map
    most: Map


class ExpectedLight:
    """The scanned mat as the camera sees it. `usable`: cells whose light is known.

    `covered`: mask, on the canvas grid, of what robots hid during the scan.
    """

    def __init__(self, pictures: Rectified, surface: Surface, projector: ProjectorPlace, covered: Pixels) -> None:
        self.ground, self.projector = pictures.ground, projector
        self._maps = pictures.camera_maps(CELL)
        white, black, *fringes = pictures.samples(CELL)
        self.room, self.contrast = black, np.maximum(white - black, 0.0)
        pick = slice(CELL // 2, None, CELL)
        lit = (surface.strength[pick, pick] > FAINT) & (surface.misfit[pick, pick] < 3.0)
        height = np.where(lit, surface.height[pick, pick], np.float32(0.0))
        self._light = _light_px(pictures, projector, height)
        near, cv = np.ones((3, 3), np.uint8), opencv()
        even = cv.dilate(height, near) - cv.erode(height, near) < ROUGH
        self.usable: Mask = np.asarray(even & (white > 1.0) & (covered[pick, pick] == 0))
        self._response = _response(white, black, fringes, lit & (np.abs(height) < 6.0))

    def seen(self, image: Image) -> Map:
        """A camera picture on the grid of cells, grey levels."""
        cv = opencv()
        soft = cv.blur(image, (5, 5))
        return np.asarray(cv.remap(soft, *self._maps, cv.INTER_LINEAR), dtype=np.float32)

    def light(self, shown: list[Image]) -> Light:
        """Light to be expected while these pictures were projected, as kept by `shrunk`."""
        cv, near = opencv(), np.ones((3, 3), np.uint8)
        shares = [self._response[picture] for picture in shown]
        low, high = shares[0], shares[0]
        for share in shares[1:]:
            low, high = np.minimum(low, share), np.maximum(high, share)
        low, high = cv.erode(low, near), cv.dilate(high, near)
        least, most = (cv.remap(share, *self._light, cv.INTER_LINEAR) for share in (low, high))
        return Light(self.room, self.contrast * least, self.contrast * most)


def shrunk(pixels: Image) -> Image:
    """A picture of the canvas to keep: pixels (height, width), grey, or (height, width, 4) BGRA; (270, 480) grey."""
    cv = opencv()
    size = CANVAS[0] // SHRUNK, CANVAS[1] // SHRUNK
    grey = pixels if pixels.ndim == 2 else cv.cvtColor(pixels, cv.COLOR_BGRA2GRAY)
    return np.asarray(cv.resize(grey, size, interpolation=cv.INTER_AREA), dtype=np.uint8)


def _light_px(pictures: Rectified, projector: ProjectorPlace, height: Map) -> tuple[Map, Map]:
    """The px of a shrunk canvas picture that lights each cell."""
    one = plane_displacement(pictures.ground, projector, 1.0, slice(0, CANVAS[1]), slice(0, CANVAS[0]))
    pick = slice(CELL // 2, None, CELL)
    grown = height * np.float32(projector.height - 1.0) / (np.float32(projector.height) - height)
    at = np.meshgrid(*(np.arange(CELL // 2, size, CELL, dtype=np.float32) for size in CANVAS))
    x, y = (
        (line + way[pick, pick] * grown + np.float32(0.5)) / SHRUNK - np.float32(0.5)
        for line, way in zip(at, one, strict=True)
    )
    return np.ascontiguousarray(x, dtype=np.float32), np.ascontiguousarray(y, dtype=np.float32)


def _response(white: Map, black: Map, fringes: list[Map], flat: Mask) -> NDArray[np.float32]:
    """Share of the light of LIGHT that each grey level causes in the camera, (256,), measured on the flat mat."""
    flat = flat & (white - black > 0.5 * np.median(white - black))
    levels, shares = [], []
    for pattern, picture in zip(PATTERNS[2:], fringes, strict=True):
        assert pattern.fringes is not None
        axis = pattern.fringes.axis
        count = picture.shape[1 - axis]
        phase = flat_phase(pattern.fringes, CELL // 2, CELL * count)[::CELL] - 2.0 * np.pi * pattern.step / 3.0
        wave = 0.5 + 0.5 * np.cos(phase)
        levels.append(np.broadcast_to(wave if axis == 0 else wave[:, None], picture.shape)[flat])
        shares.append(((picture - black) / np.maximum(white - black, 1.0))[flat])
    if not levels or not levels[0].size:
        return np.asarray(np.arange(256) / LIGHT, dtype=np.float32)
    level, share = np.concatenate(levels), np.concatenate(shares)
    bins = np.minimum((level * LEVELS).astype(int), LEVELS - 1)
    curve = [float(np.median(share[bins == i])) if (bins == i).any() else (i + 0.5) / LEVELS for i in range(LEVELS)]
    x = np.concatenate([[0.0], (np.arange(LEVELS) + 0.5) / LEVELS, [1.0]])
    y = np.maximum.accumulate(np.concatenate([[0.0], curve, [1.0]]))
    return np.interp(np.arange(256) / LIGHT, x, y).astype(np.float32)
