"""The empty mat as it would look in the pictures of a scan: its own height and its brightness."""

import numpy as np

from pigaming_app.hardware.scan.heights import Map, Mask
from pigaming_app.hardware.vision.markers import opencv

BLOCK, STRIDE = 40, 4  # px: of the grid of medians, and between the px that are used
ENOUGH = 0.35  # share of a block that must be mat
ROUNDS = 5  # of the robust fit
OFF = 0.12  # share by which a block may differ from the fit to count as mat


def own_height(height: Map, flat: Mask) -> Map:
    """Height of the mat itself, mm: waves, and errors of the calibration. `flat`: where it is the mat or lies on it."""
    cv = opencv()
    median, share = _medians(height, flat)
    weight = (share > ENOUGH).astype(np.float32)
    total = cv.GaussianBlur(weight, (0, 0), 1.0) + np.float32(1e-3)
    smooth = cv.GaussianBlur(median * weight, (0, 0), 1.0) / total
    return np.asarray(cv.resize(smooth, height.shape[::-1], interpolation=cv.INTER_LINEAR), dtype=np.float32)


def own_brightness(contrast: Map, flat: Mask) -> Map:
    """Projected light that the empty mat returns, grey levels: a smooth surface (order 4) through most of it."""
    cv = opencv()
    median, share = _medians(contrast, flat)
    usable = (share > ENOUGH) & (median > 4.0)
    v, u = (axis.reshape(-1) for axis in np.mgrid[-1.0 : 1.0 : 1j * median.shape[0], -1.0 : 1.0 : 1j * median.shape[1]])
    terms = np.column_stack([u**i * v**j for i in range(5) for j in range(5 - i)])
    level = np.log(np.maximum(median, 1.0)).reshape(-1).astype(np.float64)
    inside = usable.reshape(-1)
    if inside.sum() < 4 * terms.shape[1]:
        return np.full_like(contrast, max(1.0, float(np.median(contrast))))
    fit = np.full(len(level), np.median(level[inside]))
    for i in range(ROUNDS):
        near = terms[inside & (np.abs(level - fit) < OFF * (ROUNDS - i))]
        known = level[inside & (np.abs(level - fit) < OFF * (ROUNDS - i))]
        fit = terms @ np.linalg.solve(near.T @ near + 1e-6 * np.eye(terms.shape[1]), near.T @ known)
    smooth = np.exp(fit).reshape(median.shape).astype(np.float32)
    return np.asarray(cv.resize(smooth, contrast.shape[::-1], interpolation=cv.INTER_LINEAR), dtype=np.float32)


def _medians(values: Map, valid: Mask) -> tuple[Map, Map]:
    """Median of the valid values in each block, and their share; (rows / BLOCK, columns / BLOCK) each."""
    rows, columns = (size // BLOCK for size in values.shape)
    side = BLOCK // STRIDE
    few = np.where(valid[::STRIDE, ::STRIDE], values[::STRIDE, ::STRIDE], np.float32(np.inf))
    few = few[: rows * side, : columns * side].reshape(rows, side, columns, side).transpose(0, 2, 1, 3)
    ordered = np.sort(few.reshape(rows, columns, side * side), axis=2)
    count = np.isfinite(ordered).sum(axis=2)
    middle = np.take_along_axis(ordered, np.maximum(count - 1, 0)[..., None] // 2, axis=2)[..., 0]
    return np.where(count > 0, middle, np.float32(0.0)), (count / (side * side)).astype(np.float32)
