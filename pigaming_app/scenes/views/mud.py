"""The mud round a track: brown contour lines like those of a map, wobbling, with clods between them."""

import random

import numpy as np
import numpy.typing as npt
import pygame

from pigaming_app.scenes.surface_cache import cached
from pigaming_app.scenes.views.roadway import MUD
from pigaming_app.sim.course import Course, Place, locate
from pigaming_app.sim.world import HEIGHT, WIDTH

GRID = 10  # px between the points at which the distance is measured
FINE = 2  # px of the arena that one of the picture is
APART = 34.0  # px from line to line
CLODS = 420
Heights = npt.NDArray[np.float32]


@cached
def mud(course: Course) -> pygame.Surface:
    """The arena of 1600 x 900, with mud wherever there is no track: to be added to what lies there."""
    away = _away(course)
    h, w = away.shape
    ys, xs = np.mgrid[0:h, 0:w].astype(np.float32) * FINE
    waves = 9 * np.sin(xs / 61 + 2 * np.sin(ys / 83)) + 9 * np.sin(ys / 47 - 1.7 * np.sin(xs / 71))
    heights = away + (waves + 5 * np.sin((xs + ys) / 23)) * np.clip(away / 40, 0, 1)
    line = np.clip(2.5 - np.abs(heights % APART - APART / 2), 0, 1)
    fade = np.clip(1.0 - away / 420, 0.5, 1) * np.clip((away - 14) / 10, 0, 1)
    bright = np.maximum(line, _clods(h, w)) * fade * 0.80 + 0.12 * np.clip((away - 12) / 16, 0, 1)
    rgb = (bright[..., None] * np.array(MUD, np.float32)).clip(0, 255).astype(np.uint8)
    small = pygame.surfarray.make_surface(rgb.swapaxes(0, 1))
    return pygame.transform.smoothscale(small, (int(WIDTH), int(HEIGHT)))


def _away(course: Course) -> Heights:
    """How far outside the track's edge every point of the picture is, px; negative on the track."""
    place, rows = Place(), []
    for y in range(0, int(HEIGHT) + 1, GRID):
        row = []
        for x in range(0, int(WIDTH) + 1, GRID):
            locate(course, float(x), float(y), place)
            row.append(abs(place.aside) - place.half)
        rows.append(row)
    coarse = np.array(rows, np.float32)
    return _finer(_finer(coarse, 0), 1)


def _finer(coarse: Heights, axis: int) -> Heights:
    """What lies between the points of a grid, along one axis."""
    at = np.arange((coarse.shape[axis] - 1) * GRID // FINE, dtype=np.float32) * FINE / GRID
    first = at.astype(int)
    shape = (-1, 1) if axis == 0 else (1, -1)
    share = (at - first).reshape(shape)
    low, high = np.take(coarse, first, axis), np.take(coarse, first + 1, axis)
    return np.asarray(low + (high - low) * share, np.float32)


def _clods(h: int, w: int) -> Heights:
    """Little dots that give the ground its grit."""
    rng, clods = random.Random(3), np.zeros((h, w), np.float32)
    ys, xs = np.mgrid[-4:5, -4:5]
    away = np.sqrt(xs * xs + ys * ys)
    for _ in range(CLODS):
        x, y, r = rng.randrange(8, w - 8), rng.randrange(8, h - 8), rng.choice((1.2, 1.6, 2.2))
        patch = clods[y - 4 : y + 5, x - 4 : x + 5]
        np.maximum(patch, np.clip(r + 0.5 - away, 0, 1), out=patch)
    return clods
