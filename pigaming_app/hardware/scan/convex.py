"""Convex outlines of a mask: its hull, or those of its parts if the hull would cover much that is free."""

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.boards import ARENA_AT
from pigaming_app.hardware.scan.things import Outline
from pigaming_app.hardware.vision.markers import opencv

HOLLOW, DEEP = 0.05, 7.0  # share of a hull that is free, and depth of a dent (px), above which a part is cut in two
CUTS = 12  # directions to try, besides those of the sides that meet in the dent
PIECE = 0.03  # share of a mask by which one piece more must shrink the hulls
SIDE = 4, 28  # px of a contour from a dent, between which a side's direction is measured
DEPTH = 3  # cuts in a row: up to 8 parts
SIMPLE = 2.0  # px by which an outline may be simplified
SMALLEST = 60.0  # px^2
BEVEL, LONG = 10.0, 22.0  # px: a side as short as that between two as long as that is a lost corner
CUT_OFF = 7.0  # px by which a corner may be restored

Pixels = NDArray[np.uint8]  # (rows, columns), 0 or 1
Point = tuple[int, int]  # px


def convex_parts(mask: Pixels, at: tuple[int, int], depth: int = DEPTH) -> list[Outline]:
    """Convex outlines that cover a mask, arena px. `at`: canvas px of the mask's top left px."""
    cv = opencv()
    contours, _ = cv.findContours(mask, cv.RETR_EXTERNAL, cv.CHAIN_APPROX_NONE)
    outlines = []
    for contour in contours:
        hull = cv.convexHull(contour)
        if cv.contourArea(hull) < SMALLEST:
            continue
        free = 1.0 - cv.contourArea(contour) / cv.contourArea(hull)
        dent = _deepest_dent(contour) if depth and free > HOLLOW else None
        if dent is None:
            simple = _sharpened(cv.approxPolyDP(hull, SIMPLE, True).reshape(-1, 2).astype(float))
            outlines.append(simple + np.array(at) - np.array(ARENA_AT))
        else:
            alone = np.zeros_like(mask)
            cv.drawContours(alone, [contour], -1, 1, -1)
            for part in _cut(alone & mask, *dent):
                outlines += convex_parts(part, at, depth - 1)
    return [outline for outline in outlines if len(outline) >= 3]


def _sharpened(corners: Outline) -> Outline:
    """An outline with the corners restored that blur and erosion have cut off."""
    while len(corners) > 4:
        before, after = np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0)
        beyond = np.roll(corners, -2, axis=0)
        way, back = corners - before, after - beyond
        cross = way[:, 0] * back[:, 1] - way[:, 1] * back[:, 0]
        gap = after - corners
        share = (gap[:, 0] * back[:, 1] - gap[:, 1] * back[:, 0]) / np.where(np.abs(cross) < 1e-9, 1e-9, cross)
        met = corners + way * share[:, None]
        length = np.hypot(gap[:, 0], gap[:, 1])
        long = (np.hypot(*way.T) > LONG) & (np.hypot(*back.T) > LONG)
        lost = (length < BEVEL) & long & (share > 0.0) & (np.hypot(*(met - 0.5 * (corners + after)).T) < CUT_OFF)
        if not lost.any():
            break
        i = int(np.where(lost, length, np.inf).argmin())
        corners[i] = met[i]
        corners = np.delete(corners, (i + 1) % len(corners), axis=0)
    return corners


def _deepest_dent(contour: NDArray[np.int32]) -> tuple[Point, list[float]] | None:
    """The px of a contour farthest inside its hull, if that is deep, and the directions of the sides there, rad."""
    cv = opencv()
    corners = np.sort(cv.convexHull(contour, returnPoints=False).reshape(-1))[::-1]
    defects = cv.convexityDefects(contour, corners)
    if defects is None:
        return None
    _, _, point, far = max(defects.reshape(-1, 4).tolist(), key=lambda defect: defect[3])
    if far / 256.0 <= DEEP:
        return None
    line = contour.reshape(-1, 2)
    near, away = ([line[(point + way * px) % len(line)] for way in (-1, 1)] for px in SIDE)
    sides = [float(np.arctan2(*(end - begin)[::-1])) for begin, end in zip(near, away, strict=True)]
    x, y = line[point].tolist()
    return (x, y), sides


def _cut(mask: Pixels, dent: Point, sides: list[float]) -> tuple[Pixels, Pixels]:
    """A mask cut in two along a line through a dent, so that hulls are small and pieces few. `sides`: rad, to try."""
    cv = opencv()
    rows, columns = np.mgrid[0 : mask.shape[0], 0 : mask.shape[1]]
    best, parts, fee = np.inf, (mask, np.zeros_like(mask)), PIECE * float(mask.sum())
    for turn in [*sides, *(np.pi / CUTS * np.arange(CUTS)).tolist()]:
        side = (columns - dent[0]) * np.sin(turn) < (rows - dent[1]) * np.cos(turn)
        halves = mask * side.astype(np.uint8), mask * (~side).astype(np.uint8)
        size = 0.0
        for half in halves:
            contours, _ = cv.findContours(half, cv.RETR_EXTERNAL, cv.CHAIN_APPROX_NONE)
            size += sum(cv.contourArea(cv.convexHull(contour)) + fee for contour in contours)
        if size < best:
            best, parts = size, halves
    return parts
