"""Share of the pictures in which each marker of DICT_4X4_50 is found on a driving robot: the search for the best ids.

A small camera of its own: every subpixel of every row looks at the lid at each moment of that row's exposure (rolling
shutter), then come blur, noise and JPEG. It shares no code with the wizard's prediction. In about 10 minutes,

    python -X pigaming -m tests.bench.marker_ids

prints the table of docs/hardware.md.
"""

from math import cos, hypot, pi, sin
from typing import NamedTuple

import cv2
import numpy as np

from pigaming_app.hardware.vision.markers import CORNER_IDS, ROBOT_IDS, MarkerDetector, SearchWindow

CELL = 50.0 / 6.0  # mm
LINE = 1 / 30 / 1080  # s from one row to the next
SUB, MOMENTS = 3, 8  # subpixels each way; moments of an exposure
PAPER, PRINT, MAT = 110.0, 7.0, 102.0  # grey levels
JITTER = 0.25 * pi  # rad, of the headings about the four directions
BLOCKS = range(20, 40)


class View(NamedTuple):
    """A marker in a picture: edge, px; blur, px; speed, mm/s; exposure, s; light, as a share of the usual one."""

    edge: float
    blur: float
    speed: float
    exposure: float
    light: float = 1.0


VIEWS = (
    View(23.0, 1.5, 350.0, 1 / 60),
    View(23.0, 1.8, 350.0, 1 / 60),
    View(18.0, 1.2, 350.0, 1 / 60),
    View(30.0, 1.2, 520.0, 1 / 60),
    View(30.0, 0.8, 350.0, 1 / 30),
)


def share(number: int, view: View, pictures: int = 100, seed: int = 1) -> float:
    """Share of the pictures in which the detector finds this marker near its place."""
    random, detector, found = np.random.default_rng((seed, number)), MarkerDetector([number]), 0
    size = 8 * round((3.0 * view.edge + 12.0) / 8)
    for i in range(pictures):
        x, y = size / 2 + random.uniform(-4.0, 4.0, 2)
        picture = photo(number, view, (x, y, i % 4 * pi / 2 + random.uniform(-JITTER, JITTER)), size, random)
        aside = random.normal(0.0, 0.11 * view.edge, 2)
        spot = SearchWindow(x + aside[0], y + aside[1], 1.1 * view.edge + 6.0 + 0.1 * view.edge, view.edge)
        mark = detector.detect_in(picture, spot, number)
        found += mark is not None and hypot(*(mark.corners.mean(axis=0) - (x, y))) < 0.15 * view.edge
    return found / pictures


def photo(number, view, at, size, random):
    """A picture of a lid at `at` (px, px, rad) in the middle of the exposure of its row."""
    x, y, heading = at
    fine = (np.arange(size * SUB) + 0.5) / SUB - 0.5
    over, down = np.meshgrid((fine - x) * 50.0 / view.edge, (fine - y) * 50.0 / view.edge)  # mm
    ahead, right = over * cos(heading) + down * sin(heading), down * cos(heading) - over * sin(heading)
    later = (np.round(fine) - y)[:, None] * LINE * view.speed  # mm driven when a row is exposed
    marker = cv2.aruco.generateImageMarker(cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50), number, 6) > 0
    light = np.zeros(over.shape, np.float32)
    for moment in range(MOMENTS):
        forward = ahead - later - view.speed * view.exposure * ((moment + 0.5) / MOMENTS - 0.5)
        row, column = np.floor(3.0 - forward / CELL).astype(int), np.floor(3.0 + right / CELL).astype(int)
        inside = (row >= 0) & (row < 6) & (column >= 0) & (column < 6)
        paper = np.where(forward**2 + right**2 < 47.5**2, PAPER, MAT)
        light += np.where(inside & ~marker[row.clip(0, 5), column.clip(0, 5)], PRINT, paper)
    light = light.reshape(size, SUB, size, SUB).mean(axis=(1, 3)) / MOMENTS
    light = view.light * cv2.GaussianBlur(light, (0, 0), view.blur) + random.normal(0.0, 2.5, light.shape)
    grey = np.clip(np.rint(light), 0, 255).astype(np.uint8)
    return cv2.imdecode(cv2.imencode(".jpg", grey, [cv2.IMWRITE_JPEG_QUALITY, 80])[1], cv2.IMREAD_GRAYSCALE)


def main() -> None:
    """Print the shares of all ids in all views, %, best first."""
    shares = {number: [share(number, view) for view in VIEWS] for number in range(50)}
    for number in sorted(shares, key=lambda number: -sum(shares[number])):
        worn = {**dict.fromkeys(BLOCKS, "block"), **dict.fromkeys(CORNER_IDS, "corner")}
        worn |= {id_: f"robot {i + 1}" for i, id_ in enumerate(ROBOT_IDS)}
        cells = [f"{100 * found:.0f}" for found in shares[number]]
        print(f"| {number} | {' | '.join(cells)} | {worn.get(number, '')} |", flush=True)


if __name__ == "__main__":
    main()
