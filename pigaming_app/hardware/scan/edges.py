"""Exact edges of a thing's top: the place where the light of the top and that of its surroundings mix half and half.

Fringes are light, and light adds up: across an edge the phasors of the fringes are a sum of those of the top and those
of the mat; what is missing is shadow. The edge is where the top's share is one half, whatever the blur, and whether the
surroundings are dark or bright. Phasors are averaged along a side of the outline, which is then moved to its edge.
"""

import numpy as np

from pigaming_app.hardware.calibration.boards import ARENA_AT, CANVAS
from pigaming_app.hardware.scan.heights import Rectified, plane_displacement
from pigaming_app.hardware.scan.patterns import SETS
from pigaming_app.hardware.scan.things import Outline, ProjectorPlace
from pigaming_app.hardware.vision.markers import opencv

REACH, STEP = 7.0, 0.5  # px on both sides of a side, and between samples
ENDS = 2.5  # px at both ends of the samples that show the top or the surroundings alone
CORNER = 4.0  # px left out at the ends of a side
PARALLEL = 0.3  # sine of the angle below which neighbouring sides meet halfway and not where their lines cross
ALIKE = 0.95  # cosine of the angle between the phasors on both sides, above which no shadow is told from their mixture
CLEAR = 1.0  # grey levels between the phasors on both sides; below it a side stays where it is
FARTHEST = 9.0  # px by which a corner may move

Floats = np.ndarray[tuple[int, ...], np.dtype[np.float64]]


def refined(pictures: Rectified, projector: ProjectorPlace, outline: Outline, height: float) -> Outline:
    """The outline with every side on the edge of the top, `height` mm above the mat; (n, 2) arena px."""
    ground = pictures.ground
    foot, grown = np.array(ground.foot), ground.height / (ground.height - height)
    seen = foot + (outline - foot) * grown + ARENA_AT
    ways = np.roll(seen, -1, axis=0) - seen
    length = np.maximum(np.hypot(ways[:, 0], ways[:, 1]), 1e-6)
    out = np.column_stack([ways[:, 1], -ways[:, 0]]) / length[:, None]
    if float((out * (seen - seen.mean(axis=0))).sum()) < 0.0:
        out = -out
    left, top = np.maximum(np.floor(seen.min(axis=0)).astype(int) - 12, 0)
    right, bottom = np.minimum(np.ceil(seen.max(axis=0)).astype(int) + 13, CANVAS)
    light = _light(pictures, projector, height, (left, top, right, bottom))
    at = seen - (left, top)
    shifts = np.array([_shift(light, at[i], ways[i], length[i], out[i]) for i in range(len(seen))])
    moved = _meetings(seen, ways / length[:, None], out * shifts[:, None])
    return np.asarray(foot + (moved - ARENA_AT - foot) / grown)


def _light(
    pictures: Rectified, projector: ProjectorPlace, height: float, window: tuple[int, int, int, int]
) -> list[Floats]:
    """Fine phasors in a window (left, top, right, bottom; canvas px), relative to those of a plane at `height` mm."""
    left, top, right, bottom = window
    phasors, _ = pictures.phasors(slice(top, bottom), slice(left, right))
    shift = plane_displacement(pictures.ground, projector, height, slice(top, bottom), slice(left, right))
    result = []
    for number, displaced in zip((1, 3), shift, strict=True):
        turn = displaced * np.float32(2.0 * np.pi / SETS[number].period)
        c, s = np.cos(turn), np.sin(turn)
        real, imaginary = phasors[number]
        result += [real * c + imaginary * s, imaginary * c - real * s]
    return [np.ascontiguousarray(part, dtype=np.float32) for part in result]


def _shift(light: list[Floats], start: Floats, way: Floats, length: float, out: Floats) -> float:
    """Distance from a side to the edge beside it, px outwards."""
    trim = min(CORNER, 0.25 * length)
    along = start + way / length * np.arange(trim, length - trim + 1e-6, 1.0)[:, None]
    if not len(along):
        return 0.0
    offsets = np.arange(-REACH, REACH + 1e-6, STEP)
    places = (along[:, None] + out * offsets[:, None]).astype(np.float32)
    cv = opencv()
    profile = np.column_stack(
        [
            cv.remap(part, places[..., 0], places[..., 1], cv.INTER_LINEAR, borderMode=cv.BORDER_REPLICATE).mean(axis=0)
            for part in light
        ]
    ).astype(np.float64)
    ends = round(ENDS / STEP)
    inner, outer = profile[:ends].mean(axis=0), profile[-ends:].mean(axis=0)
    gap = inner - outer
    if gap @ gap < CLEAR * CLEAR:
        return 0.0
    share = _share(profile, inner, outer)
    below = np.nonzero(share < 0.5)[0]
    if not len(below) or below[0] == 0:
        return 0.0
    i = int(below[0])
    part = (share[i - 1] - 0.5) / max(share[i - 1] - share[i], 1e-9)
    return float(offsets[i - 1] + part * STEP)


def _share(profile: Floats, top: Floats, other: Floats) -> Floats:
    """Share of the top's light in phasors (n, 4), mixed with another light, and with shadow if both differ enough."""
    own, cross, theirs = float(top @ top), float(top @ other), float(other @ other)
    if theirs < 0.01 * own or cross < ALIKE * np.sqrt(own * theirs):
        inverse = np.linalg.inv(np.array(((own, cross), (cross, theirs + 1e-3 * own))))
        return np.asarray((inverse @ np.stack([profile @ top, profile @ other]))[0])
    gap = top - other
    return np.asarray((profile - other) @ gap / (gap @ gap))


def _meetings(corners: Outline, ways: Floats, moves: Floats) -> Outline:
    """Corners of an outline whose sides, with unit directions `ways`, were moved by `moves`."""
    begins, ends = corners + moves, np.roll(corners, -1, axis=0) + moves
    before_way, before_end, before_begin = (np.roll(line, 1, axis=0) for line in (ways, ends, begins))
    cross = before_way[:, 0] * ways[:, 1] - before_way[:, 1] * ways[:, 0]
    gap = begins - before_begin
    share = (gap[:, 0] * ways[:, 1] - gap[:, 1] * ways[:, 0]) / np.where(np.abs(cross) < 1e-9, 1e-9, cross)
    met = before_begin + before_way * share[:, None]
    middle = 0.5 * (begins + before_end)
    far = np.hypot(*(met - corners).T) > FARTHEST
    return np.asarray(np.where(((np.abs(cross) < PARALLEL) | far)[:, None], middle, met))
