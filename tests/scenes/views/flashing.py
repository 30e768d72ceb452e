"""Counting flashes in pictures, by the definition of WCAG 2.2 (https://www.w3.org/TR/WCAG22/, general flash).

A flash is a pair of opposing changes in relative luminance of 10 % or more of the maximum, the darker one below
0.8. The picture is divided into cells; cells smaller than the area of the definition count too, so the count is strict.
"""

import numpy as np
import numpy.typing as npt
import pygame

CELL = 60  # px
CHANGE, BRIGHT = 0.1, 0.8  # of the maximum luminance
Cells = npt.NDArray[np.float64]


def luminance(picture: pygame.Surface) -> Cells:
    """The mean relative luminance of each cell, (w / CELL, h / CELL), in 0..1."""
    w, h = picture.get_width() // CELL, picture.get_height() // CELL
    small = pygame.transform.smoothscale(picture, (w * 6, h * 6))
    share = pygame.surfarray.array3d(small).astype(np.float64) / 255.0
    linear = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
    bright = linear @ np.array([0.2126, 0.7152, 0.0722])
    return np.asarray(bright.reshape(w, 6, h, 6).mean(axis=(1, 3)))


def most_flashes(cells: list[Cells], rate: float) -> int:
    """The most flashes of a cell within one second of pictures, of which there are `rate` a second."""
    changes: dict[tuple[int, int], list[int]] = {}  # pictures at which a cell's luminance turned, by 10 % or more
    extreme, rising = cells[0].copy(), np.zeros(cells[0].shape, dtype=int)
    for at, now in enumerate(cells):
        up = (now - extreme >= CHANGE) & (rising <= 0) & (extreme < BRIGHT)
        down = (extreme - now >= CHANGE) & (rising >= 0) & (now < BRIGHT)
        for x, y in zip(*np.nonzero(up | down), strict=True):
            changes.setdefault((int(x), int(y)), []).append(at)
        rising = np.where(up, 1, np.where(down, -1, rising))
        turned = up | down
        extreme = np.where(turned, now, np.where(rising >= 0, np.maximum(extreme, now), np.minimum(extreme, now)))
        still = rising == 0
        extreme = np.where(still, cells[0], extreme)
    most = 0
    for turns in changes.values():
        most = max(most, *(sum(first <= turn < first + rate for turn in turns) for first in turns))
    return most // 2
