"""What lies and drives on the emulated mat, as the camera sees it: flat prints at a height over the mat.

A lid is a white disc with a marker of 50 mm and one white cell around it. Prints hold how much light they throw back
and how much of what lies below they hide, a little softened, since one px of the camera sees more than a millimetre.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

TEXELS = 4  # a mm
LID_HEIGHT = 70.0  # mm
BODY_HEIGHT = 35.0
LID_RADIUS = 47.5
MARKER = 50.0  # mm along an edge
QUIET = 50.0 / 6.0  # mm of white around it: one cell
WHITE, BLACK, DARK, SKIN = 0.92, 0.05, 0.10, 0.55  # share of light thrown back
SOFT = 1.1  # mm, standard deviation of what one px gathers, through the blur of the lens

Print = NDArray[np.uint8]  # (n, n, 2): light thrown back times cover, and cover, in 255ths
Share = NDArray[np.float32]
Placing = tuple[float, float, float]  # mm, mm, rad


class FlatObject(NamedTuple):
    """A print at a height, with the poses that it had while the shutter was open."""

    look: Print
    height: float  # mm
    poses: tuple[Placing, ...]
    reach: float = 50.0  # mm from its middle beyond which there is nothing of it
    dull: bool = False  # so dark that what is projected on it cannot be told from what is projected beside it


@lru_cache(maxsize=8)
def lid(number: int) -> Print:
    """The lid of a robot: marker `number` with its top ahead."""
    light, cover = _disc(LID_RADIUS, WHITE)
    _stick(light, number)
    return _softened(light, cover)


@lru_cache(maxsize=8)
def card(number: int) -> Print:
    """Marker `number` on a square of paper, as somebody may lay it on the mat."""
    light, cover = _square(MARKER / 2 + QUIET, WHITE)
    _stick(light, number)
    return _softened(light, cover)


@lru_cache(maxsize=1)
def body() -> Print:
    """The robot under its lid."""
    return _softened(*_disc(LID_RADIUS, DARK))


@lru_cache(maxsize=1)
def underside() -> Print:
    """A robot turned over: wheels and a circuit board."""
    light, cover = _disc(LID_RADIUS, DARK)
    for u, v in ((-30, 0), (30, 0), (0, 25)):
        light += (0.5 - DARK) * _disc(9.0, 1.0, u, v)[1] * cover
    return _softened(light, cover)


@lru_cache(maxsize=1)
def hand() -> Print:
    """A hand that covers a lid."""
    light, cover = _disc(40.0, SKIN)
    for u in (-27, -9, 9, 27):
        cover = np.maximum(cover, _disc(9.0, 1.0, u, -38)[1])
    return _softened(np.where(cover > 0, SKIN, light).astype(np.float32) * cover, cover)


def _disc(radius: float, light: float, u: float = 0.0, v: float = 0.0) -> tuple[Share, Share]:
    x, y = _grid()
    cover = ((x - u) ** 2 + (y - v) ** 2 <= radius * radius).astype(np.float32)
    return cover * np.float32(light), cover


def _square(half: float, light: float) -> tuple[Share, Share]:
    x, y = _grid()
    cover = (np.maximum(abs(x), abs(y)) <= half).astype(np.float32)
    return cover * np.float32(light), cover


def _grid() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """How far right of and behind the middle every texel is, in mm."""
    half = 56 * TEXELS
    v, u = (np.mgrid[0 : 2 * half, 0 : 2 * half] + 0.5 - half) / TEXELS
    return u, v


def _stick(light: Share, number: int) -> None:
    """Lay a marker on the middle of a print."""
    import cv2

    size = round(MARKER * TEXELS)
    words = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    cells = cv2.aruco.generateImageMarker(words, number, 6)
    at = (len(light) - size) // 2
    marker = cv2.resize(cells, (size, size), interpolation=cv2.INTER_NEAREST)
    light[at : at + size, at : at + size] = np.where(marker > 0, WHITE, BLACK)


def _softened(light: Share, cover: Share) -> Print:
    import cv2

    soft = cv2.GaussianBlur(np.dstack([light, cover]), (0, 0), SOFT * TEXELS)
    return np.asarray(np.rint(255.0 * soft), dtype=np.uint8)
