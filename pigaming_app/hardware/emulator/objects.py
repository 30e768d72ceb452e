"""Objects on the emulated mat as flat prints at a height above it.

A lid is a white disc with a 50 mm marker and a quiet zone of one cell. Prints hold reflectance and coverage (alpha),
slightly blurred, since one camera px covers more than a millimetre.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

TEXELS = 4  # per mm
LID_HEIGHT = 70.0  # mm
BODY_HEIGHT = 35.0
LID_RADIUS = 47.5
MARKER = 50.0  # mm, edge
SHEET = (16, 17, 43, 45)  # markers of the robots
QUIET = 50.0 / 6.0  # mm, quiet zone: one cell
WHITE, BLACK, DARK, SKIN = 0.92, 0.05, 0.10, 0.55  # reflectance
SOFT = 1.1  # mm, standard deviation of the footprint of one px, with the blur of the lens

Print = NDArray[np.uint8]  # (n, n, 2): reflectance times coverage, and coverage, in 255ths
Share = NDArray[np.float32]
Placing = tuple[float, float, float]  # mm, mm, rad


class FlatObject(NamedTuple):
    """A print at a height, with its poses during the exposure."""

    texture: Print
    height: float  # mm
    poses: tuple[Placing, ...]
    reach: float = 50.0  # mm, radius
    dark: bool = False  # so dark that the light projected onto it may be taken from the mat beside it
    slant: tuple[float, float] = (0.0, 0.0)  # mm of its motion from one row of the sensor to the next


@lru_cache(maxsize=8)
def lid(number: int) -> Print:
    """The lid of a robot: marker `number`, its top ahead."""
    light, cover = _disc(LID_RADIUS, WHITE)
    _stick(light, number)
    return _blurred(light, cover)


@lru_cache(maxsize=8)
def card(number: int) -> Print:
    """Marker `number` on a square of paper on the mat."""
    light, cover = _square(MARKER / 2 + QUIET, WHITE)
    _stick(light, number)
    return _blurred(light, cover)


@lru_cache(maxsize=1)
def body() -> Print:
    """The robot under its lid."""
    return _blurred(*_disc(LID_RADIUS, DARK))


@lru_cache(maxsize=1)
def underside() -> Print:
    """A robot upside down: wheels and a circuit board."""
    light, cover = _disc(LID_RADIUS, DARK)
    for u, v in ((-30, 0), (30, 0), (0, 25)):
        light += (0.5 - DARK) * _disc(9.0, 1.0, u, v)[1] * cover
    return _blurred(light, cover)


@lru_cache(maxsize=1)
def hand() -> Print:
    """A hand that covers a lid."""
    light, cover = _disc(40.0, SKIN)
    for u in (-27, -9, 9, 27):
        cover = np.maximum(cover, _disc(9.0, 1.0, u, -38)[1])
    return _blurred(np.where(cover > 0, SKIN, light).astype(np.float32) * cover, cover)


def _disc(radius: float, light: float, u: float = 0.0, v: float = 0.0) -> tuple[Share, Share]:
    x, y = _grid()
    cover = ((x - u) ** 2 + (y - v) ** 2 <= radius * radius).astype(np.float32)
    return cover * np.float32(light), cover


def _square(half: float, light: float) -> tuple[Share, Share]:
    x, y = _grid()
    cover = (np.maximum(abs(x), abs(y)) <= half).astype(np.float32)
    return cover * np.float32(light), cover


def _grid() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Coordinates of every texel, right of and behind the centre, mm."""
    half = 56 * TEXELS
    v, u = (np.mgrid[0 : 2 * half, 0 : 2 * half] + 0.5 - half) / TEXELS
    return u, v


def _stick(light: Share, number: int) -> None:
    """Draw a marker at the centre of a print."""
    import cv2

    size = round(MARKER * TEXELS)
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    cells = cv2.aruco.generateImageMarker(dictionary, number, 6)
    at = (len(light) - size) // 2
    marker = cv2.resize(cells, (size, size), interpolation=cv2.INTER_NEAREST)
    light[at : at + size, at : at + size] = np.where(marker > 0, WHITE, BLACK)


def _blurred(light: Share, cover: Share) -> Print:
    import cv2

    blurred = cv2.GaussianBlur(np.dstack([light, cover]), (0, 0), SOFT * TEXELS)
    return np.asarray(np.rint(255.0 * blurred), dtype=np.uint8)
