"""The corners of markers to a few hundredths of a pixel: a line along each of their edges, and where the lines meet.

Profiles across an edge go from the black rim of a marker to the white round it. How much of a profile is black says
where the edge is, whatever the blur; what is brighter than the marker's own white is cut off, so that what is projected
across it counts for little. All markers of a picture are refined at once: each by itself would cost four times as much.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.signals import Image

CELLS = 6  # of a marker with its black rim, across; one more is white all round
PROFILES, SAMPLES = 8, 11  # along an edge, and across it
REACH, FARTHEST = 0.7, 5.0  # cells that a profile goes to either side, and px: its samples must be about 1 px apart
ASIDE = 0.35  # of the reach off the others: a profile that something crosses
FLAT = 0.3  # of a marker's contrast, below which a profile says nothing
BRIGHT = 1.25  # medians of a marker's white: above, something is projected there; below, light just is uneven
ROUNDS = 2  # the second begins where the first ended, and so has the edges in the middle of its profiles

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
NEXT, LAST = [1, 2, 3, 0], [3, 0, 1, 2]  # corners, clockwise
ALONG = np.linspace(0.14, 0.86, PROFILES)
ACROSS = np.linspace(-1.0, 1.0, SAMPLES)


def refined(cv: Any, image: Image, corners: Floats) -> tuple[Floats, Bools]:
    """Corners (n, 4, 2), in ArUco's order and right to a third of a cell, made exact; and which could be, (n,).

    The others are left as they were.
    """
    well = np.zeros(len(corners), np.bool_)
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
        well = np.asarray(sure.all(axis=1))
        corners = np.where(well[:, None, None], exact, corners)
    return corners, well


def _crossings(values: Floats) -> tuple[Floats, Bools]:
    """Where each profile turns white, from -1 inside to 1 outside, and whether it is clear: (n, 4, PROFILES) each."""
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
    """The median of each marker's values, (n, 1)."""
    flat = values.reshape(len(values), -1)
    return np.asarray(np.partition(flat, flat.shape[1] // 2, axis=1)[:, flat.shape[1] // 2, None])


def _lines(offsets: Floats, clear: Bools) -> tuple[Floats, Floats, Bools]:
    """The line along each edge: offset at its begin, how much more at its end, whether it is sure; (n, 4) each."""
    aside = np.abs(offsets - np.sort(offsets, axis=2)[..., PROFILES // 2, None])
    near = (clear & (aside < ASIDE)).astype(np.float64)
    total = near.sum(axis=2)
    many = np.maximum(total, 1.0)
    t, o = near @ ALONG / many, (near * offsets).sum(axis=2) / many
    away = ALONG - t[..., None]
    slope = (near * away * (offsets - o[..., None])).sum(axis=2) / np.maximum((near * away * away).sum(axis=2), 1e-6)
    return o - slope * t, slope, np.asarray(total >= PROFILES / 2)


def _meetings(begins: Floats, ways: Floats) -> Floats:
    """Where each edge meets the one before it: the corners."""
    before, way_before = begins[:, LAST], ways[:, LAST]
    gap = begins - before
    cross = way_before[..., 0] * ways[..., 1] - way_before[..., 1] * ways[..., 0]
    share = (gap[..., 0] * ways[..., 1] - gap[..., 1] * ways[..., 0]) / np.where(np.abs(cross) < 1e-9, 1e-9, cross)
    return np.asarray(before + way_before * share[..., None])
