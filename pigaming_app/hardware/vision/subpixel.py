"""Subpixel refinement of marker corners: a line is fitted to each edge, and adjacent lines are intersected.

Intensity profiles cross each edge from the black rim of the marker to the white around it. The black share of a profile
locates the edge independently of blur. Values brighter than the marker's own white are clipped, so projected light has
little influence. All markers of an image are refined together, four times faster than one by one.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.signals import Image

CELLS = 6  # cells across a marker with its black rim; the white margin is one cell more on each side
PROFILES, SAMPLES = 8, 11  # profiles per edge, and samples per profile
REACH, FARTHEST = 0.7, 5.0  # half length of a profile, cells, and its limit, px: samples must be about 1 px apart
ASIDE = 0.35  # share of the reach by which an outlier's edge is off the median
FLAT = 0.3  # share of the marker's contrast below which a profile is ignored
BRIGHT = 1.25  # clipping level, medians of the marker's white: above is projected light, below uneven lighting
ROUNDS = 2  # iterations; the second has the edges in the middle of its profiles

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
NEXT, LAST = [1, 2, 3, 0], [3, 0, 1, 2]  # corners, clockwise
ALONG = np.linspace(0.14, 0.86, PROFILES)
ACROSS = np.linspace(-1.0, 1.0, SAMPLES)


def refined(cv: Any, image: Image, corners: Floats) -> tuple[Floats, Bools]:
    """Refined corners (n, 4, 2), and True where the refinement succeeded (n,); the others are returned unchanged.

    The input must be in ArUco's order and accurate to a third of a cell.
    """
    valid = np.zeros(len(corners), np.bool_)
    for _ in range(ROUNDS if len(corners) else 0):
        way = corners[:, NEXT] - corners  # of each edge, clockwise
        length = np.sqrt((way * way).sum(axis=2, keepdims=True))
        out = np.stack([way[..., 1], -way[..., 0]], axis=2) / length
        step = out * np.minimum(length.mean(axis=1, keepdims=True) * (REACH / CELLS), FARTHEST)  # outwards
        feet = corners[:, :, None] + way[:, :, None] * ALONG[:, None]
        points = feet[:, :, :, None] + step[:, :, None, None] * ACROSS[:, None]
        maps = points.reshape(-1, SAMPLES, 2).astype(np.float32)
        values = cv.remap(image, maps[..., 0], maps[..., 1], cv.INTER_LINEAR, borderMode=cv.BORDER_REPLICATE)
        offsets, clear = _crossings(values.reshape(len(corners), 4 * PROFILES, SAMPLES).astype(np.float64))
        begin, slope, sure = _lines(offsets, clear)
        exact = _meetings(corners + step * begin[..., None], way + step * slope[..., None])
        valid = np.asarray(sure.all(axis=1))
        corners = np.where(valid[:, None, None], exact, corners)
    return corners, valid


def _crossings(values: Floats) -> tuple[Floats, Bools]:
    """Edge position on each profile, from -1 inside to 1 outside, and True where its contrast suffices.

    `values`: (n, 4 * PROFILES, SAMPLES); results: (n, 4, PROFILES) each.
    """
    white, black = _middle(values[..., -2:]), _middle(values[..., :2])
    values = np.minimum(values, BRIGHT * white[..., None])
    low, high = 0.5 * (values[..., 0] + values[..., 1]), 0.5 * (values[..., -2] + values[..., -1])
    clear = high - low > FLAT * np.maximum(white - black, 1.0)
    share = ((values - low[..., None]) / np.where(clear, high - low, 1.0)[..., None]).clip(0.0, 1.0)
    area = share.sum(axis=2) - 0.5 * (share[..., 0] + share[..., -1])
    offsets: Floats = np.where(clear, 1.0 - area * (2.0 / (SAMPLES - 1)), 0.0)
    shape = (len(values), 4, PROFILES)
    return offsets.reshape(shape), np.asarray(clear).reshape(shape)


def _middle(values: Floats) -> Floats:
    """Median of each marker's values, (n, 1)."""
    flat = values.reshape(len(values), -1)
    return np.asarray(np.partition(flat, flat.shape[1] // 2, axis=1)[:, flat.shape[1] // 2, None])


def _lines(offsets: Floats, clear: Bools) -> tuple[Floats, Floats, Bools]:
    """Line along each edge: offset at its start, increase to its end, True if it is reliable; (n, 4) each."""
    aside = np.abs(offsets - np.sort(offsets, axis=2)[..., PROFILES // 2, None])
    near = (clear & (aside < ASIDE)).astype(np.float64)
    total = near.sum(axis=2)
    many = np.maximum(total, 1.0)
    t, o = near @ ALONG / many, (near * offsets).sum(axis=2) / many
    away = ALONG - t[..., None]
    slope = (near * away * (offsets - o[..., None])).sum(axis=2) / np.maximum((near * away * away).sum(axis=2), 1e-6)
    return o - slope * t, slope, np.asarray(total >= PROFILES / 2)


def _meetings(begins: Floats, ways: Floats) -> Floats:
    """Intersections of each edge with the one before it: the corners, (n, 4, 2)."""
    before, way_before = begins[:, LAST], ways[:, LAST]
    gap = begins - before
    cross = way_before[..., 0] * ways[..., 1] - way_before[..., 1] * ways[..., 0]
    share = (gap[..., 0] * ways[..., 1] - gap[..., 1] * ways[..., 0]) / np.where(np.abs(cross) < 1e-9, 1e-9, cross)
    return np.asarray(before + way_before * share[..., None])
