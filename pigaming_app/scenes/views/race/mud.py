"""Mud around a track: wavy brown contour lines with clods between them."""

import random

import numpy as np
import numpy.typing as npt
import pygame

from pigaming_app.games.race.course import Course
from pigaming_app.scenes.views.things.styles import MUD
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.surface_cache import cached

GRID = 10  # px, spacing of the distance samples
FINE = 2  # arena px per picture px
APART = 34.0  # px between contour lines
CLODS = 420
ROWS = 50  # picture rows per step
Heights = npt.NDArray[np.float32]
Numbers = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]


@cached
@resumable
def mud(course: Course) -> Steps[pygame.Surface]:
    """The 1600 x 900 arena with mud outside the track, as additive light."""
    coarse = yield from _distances(course)
    distance = _upsampled(_upsampled(coarse, 0), 1)
    h, w = distance.shape
    yield
    clods = _clods(h, w)
    yield
    rgb = np.empty((w, h, 3), np.uint8)
    for top in range(0, h, ROWS):
        rows = slice(top, top + ROWS)
        rgb[:, rows] = _rows(distance[rows], clods[rows], top).swapaxes(0, 1)
        yield
    small = pygame.surfarray.make_surface(rgb)
    yield
    return pygame.transform.smoothscale(small, (int(WIDTH), int(HEIGHT)))


def _rows(distance: Heights, clods: Heights, top: int) -> npt.NDArray[np.uint8]:
    """Pixels of a block of picture rows starting at `top`."""
    h, w = distance.shape
    ys, xs = np.mgrid[top : top + h, 0:w].astype(np.float32) * FINE
    waves = 9 * np.sin(xs / 61 + 2 * np.sin(ys / 83)) + 9 * np.sin(ys / 47 - 1.7 * np.sin(xs / 71))
    heights = distance + (waves + 5 * np.sin((xs + ys) / 23)) * np.clip(distance / 40, 0, 1)
    line = np.clip(2.5 - np.abs(heights % APART - APART / 2), 0, 1)
    fade = np.clip(1.0 - distance / 420, 0.5, 1) * np.clip((distance - 14) / 10, 0, 1)
    bright = np.maximum(line, clods) * fade * 0.80 + 0.12 * np.clip((distance - 12) / 16, 0, 1)
    return np.asarray((bright[..., None] * np.array(MUD, np.float32)).clip(0, 255), np.uint8)


def _distances(course: Course) -> Steps[Heights]:
    """Distance outside the track's edge on a coarse grid, px; negative on the track."""
    centre = np.array([course.xs[: course.count], course.ys[: course.count]]).T
    half = np.array(course.half[: course.count])
    rows = []
    for y in range(0, int(HEIGHT) + 1, GRID):
        xs = np.arange(0.0, WIDTH + 1.0, GRID)
        points = np.stack([xs, np.full_like(xs, y)], 1)
        nearest = ((centre**2).sum(1) - 2 * points @ centre.T).argmin(1)
        after, before = (nearest + 1) % course.count, (nearest - 1) % course.count
        gap, half_width = _on_leg(points, centre, half, nearest, after)
        gap_before, wide_before = _on_leg(points, centre, half, before, nearest)
        rows.append(np.where(gap_before < gap, gap_before - wide_before, gap - half_width))
        yield
    return np.array(rows, np.float32)


def _on_leg(points: Numbers, centre: Numbers, half: Numbers, a: Indices, b: Indices) -> tuple[Numbers, Numbers]:
    """Distance of each point to its leg, from course point a to b, and half the track width there; px."""
    leg, distance = centre[b] - centre[a], points - centre[a]
    share = np.clip((leg * distance).sum(1) / (leg**2).sum(1), 0.0, 1.0)
    gap = np.linalg.norm(distance - share[:, None] * leg, axis=1)
    return gap, half[a] + share * (half[b] - half[a])


def _upsampled(coarse: Heights, axis: int) -> Heights:
    """Interpolate a grid along one axis."""
    at = np.arange((coarse.shape[axis] - 1) * GRID // FINE, dtype=np.float32) * FINE / GRID
    first = at.astype(int)
    shape = (-1, 1) if axis == 0 else (1, -1)
    share = (at - first).reshape(shape)
    low, high = np.take(coarse, first, axis), np.take(coarse, first + 1, axis)
    return np.asarray(low + (high - low) * share, np.float32)


def _clods(h: int, w: int) -> Heights:
    """Random dots that give the ground a texture."""
    rng, clods = random.Random(3), np.zeros((h, w), np.float32)
    ys, xs = np.mgrid[-4:5, -4:5]
    distance = np.sqrt(xs * xs + ys * ys)
    for _ in range(CLODS):
        x, y, r = rng.randrange(8, w - 8), rng.randrange(8, h - 8), rng.choice((1.2, 1.6, 2.2))
        patch = clods[y - 4 : y + 5, x - 4 : x + 5]
        np.maximum(patch, np.clip(r + 0.5 - distance, 0, 1), out=patch)
    return clods
