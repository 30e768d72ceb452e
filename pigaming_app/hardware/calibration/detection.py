"""Share of the pictures in which the marker of a driving robot is found, by trial in synthetic pictures.

Each has a lid in the light of a match, smeared by the exposure and skewed by a rolling shutter, blurred, noisy and
compressed as by a USB camera. The tracker's own detector then searches it near its place. Headings, places in the grid
of pixels and errors of the tracker's prediction are drawn at random, equally often in the four quarters.
"""

from functools import lru_cache
from math import ceil, cos, hypot, pi, sin
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.signals import Image
from pigaming_app.hardware.vision.exposure import LONGEST
from pigaming_app.hardware.vision.markers import MarkerDetector, SearchWindow, dictionary, opencv

SPEED = 350.0  # mm/s, of a robot
JPEG = 80  # quality of the compression
READOUT, ROWS = 1 / 40, 1080  # s from the first to the last row of a picture; rows
MARKER_MM, LID_MM, CELLS = 50.0, 47.5, 6  # edge of a marker; radius of a lid; cells across a marker
WHITE, BLACK, MAT, NOISE = 110.0, 7.0, 102.0, 2.5  # grey levels of paper, print, mat, and standard deviation
LARGEST = 200.0  # px, edge of a marker in these pictures
CELL, FINE = 24, 2  # texels per cell of a lid as it is drawn, and per px as it is sampled
ASTRAY = 0.1  # error of the tracker's prediction in edges, standard deviation
NEAR = 0.15  # edges from the truth within which a marker counts as found
FEW, MANY = 60, 240  # pictures that settle a clear case, and any other
GRAIN = 1024  # px, width of the noise of which a picture shows a part
BLOCK = 8  # px, of the compression


class Look(NamedTuple):
    """Marker of a robot in pictures: its number, edge and blur (standard deviation) in px, exposure in s, and light
    as a share of the usual one.
    """

    number: int
    edge: float
    blur: float
    exposure: float
    light: float = 1.0


def found_share(number: int, edge: float, blur: float, exposure: float, light: float = 1.0) -> float:
    """Share of the pictures, 0..1, in which this marker of a robot at SPEED is found.

    `edge`: of the marker, px; `blur`: standard deviation, px; `exposure`: s; 0, unknown, counts as LONGEST; `light`: a
    share of the usual one. Standard error at most 0.03. Takes up to 0.3 s, once for each set of rounded arguments.
    Raises OpenCVMissing.
    """
    edge, blur = min(round(2.0 * edge) / 2.0, LARGEST), round(20.0 * blur) / 20.0
    return _tried(Look(number, edge, blur, round(exposure or LONGEST, 4), round(20.0 * light) / 20.0))


@lru_cache(maxsize=1024)
def _tried(look: Look) -> float:
    cv, random, detector = opencv(), np.random.default_rng(look.number), MarkerDetector([look.number])
    lid, found = _lid(cv, look), 0
    for count in range(1, MANY + 1):
        heading = 0.5 * pi * (count % 4 + random.random())
        size = BLOCK * (int(3.4 * look.edge) // BLOCK + 3)
        x, y = 0.5 * size + random.uniform(-0.5 * BLOCK, 0.5 * BLOCK, 2)
        image = _picture(cv, lid, look, (x, y, heading), size, random)
        aside = random.normal(0.0, ASTRAY * look.edge, 2)
        spot = SearchWindow(x + aside[0], y + aside[1], 1.2 * look.edge + 6.0, look.edge)
        mark = detector.detect_in(image, spot, look.number)
        found += mark is not None and hypot(*(mark.corners.mean(axis=0) - (x, y))) < max(2.0, NEAR * look.edge)
        if count == FEW and found in (0, FEW):
            break
    return found / count


def _picture(
    cv: Any, lid: Image, look: Look, at: tuple[float, float, float], size: int, random: np.random.Generator
) -> Image:
    """A square picture, `size` px wide, of a lid that is at `at` (px, px, rad) in the middle of the exposure."""
    middle, ahead = np.array(at[:2]), np.array((cos(at[2]), sin(at[2])))
    onto = FINE * np.array(((-ahead[1], ahead[0]), (-ahead[0], -ahead[1])))  # px to texels: right of, and behind
    later = np.zeros((2, 2))
    later[:, 1] = SPEED * look.edge / MARKER_MM * READOUT / ROWS * ahead  # px of motion until the next row
    matrix = np.column_stack([onto @ (np.eye(2) - later), 0.5 * (len(lid) - 1) - onto @ (middle - later @ middle)])
    flags = cv.INTER_LINEAR | cv.WARP_INVERSE_MAP
    light = cv.warpAffine(lid, matrix, (size, size), flags=flags, borderMode=cv.BORDER_REPLICATE)
    light = cv.GaussianBlur(light, (0, 0), max(look.blur, 0.1))
    left, top = random.integers(0, GRAIN - size, 2)
    light *= look.light
    light += _grain()[top : top + size, left : left + size]
    packed = cv.imencode(".jpg", cv.convertScaleAbs(light), [cv.IMWRITE_JPEG_QUALITY, JPEG])[1]
    return np.asarray(cv.imdecode(packed, cv.IMREAD_GRAYSCALE))


@lru_cache(maxsize=1)
def _grain() -> NDArray[np.float32]:
    """Noise of a sensor."""
    return np.random.default_rng(1).normal(0.0, NOISE, (GRAIN, GRAIN)).astype(np.float32)


def _lid(cv: Any, look: Look) -> Image:
    """A lid with its marker on the mat, FINE texels per px, its top ahead, smeared by the way of an exposure."""
    around = CELLS + 8  # cells
    page = np.full((around * CELL, around * CELL), MAT, np.float32)
    cv.circle(page, (around * CELL // 2,) * 2, round(LID_MM * CELLS * CELL / MARKER_MM), WHITE, -1)
    marker = cv.aruco.generateImageMarker(dictionary(cv), look.number, CELLS * CELL)
    begin = (around - CELLS) // 2 * CELL
    page[begin : begin + len(marker), begin : begin + len(marker)] = np.where(marker > 0, WHITE, BLACK)
    way = max(1.0, SPEED * look.exposure * CELLS * CELL / MARKER_MM)  # texels
    along = np.clip(0.5 * way + 0.5 - np.abs(np.arange(-ceil(way), ceil(way) + 1)), 0.0, 1.0) / way
    page = cv.sepFilter2D(page, -1, np.ones(1), along, borderType=cv.BORDER_REPLICATE)
    wide = round(FINE * look.edge * around / CELLS)
    return np.asarray(cv.resize(page, (wide, wide), interpolation=cv.INTER_AREA))
