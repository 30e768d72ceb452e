"""Heights above the mat from the pictures of a scan.

All pictures are rectified to the canvas grid, where a point of the flat mat lies at the canvas px that lights it. A
point z mm above the mat appears at a, displaced away from the camera's foot, and is lit by px q, displaced away from
the projector's foot: a - q = z d, d = (a - C) / H - (q - L) / G with camera and projector at heights H, G over C, L.
The fringes yield q. The flat mat is its own reference: no pictures of an empty mat are needed.
"""

from collections.abc import Sequence
from math import pi, sqrt
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.boards import ARENA_AT, CANVAS
from pigaming_app.hardware.calibration.ground_plane import GroundPlane
from pigaming_app.hardware.scan.patterns import PATTERNS, SETS, STEPS, flat_phase
from pigaming_app.hardware.scan.things import ProjectorPlace
from pigaming_app.hardware.vision.markers import opencv

COARSE = 8  # px between the points of the grid whose camera px are calculated; those in between are interpolated
SMOOTH = 1.0  # px, standard deviation of the blur of the fringes' phasors
MARGIN = 4  # px, of that blur
TYPICAL = 170.0  # mm, the height about which displacements are unwrapped
UNWRAP = 0.35  # of the coarse period, by which the expected displacement may differ from that of the flat mat
SPARSE = 8  # px between the samples of statistics

Map = NDArray[np.float32]
Mask = NDArray[np.bool_]


class Surface(NamedTuple):
    """Rectified measurements, each (rows, columns)."""

    height: Map  # mm; meaningless where the fringes are faint
    strength: Map  # grey levels, amplitude of the fringes
    contrast: Map  # grey levels, white minus black
    misfit: Map  # canvas px by which camera ray and projector ray miss each other


class Rectified:
    """The averaged camera pictures of PATTERNS, to be looked up on the canvas grid."""

    def __init__(self, ground: GroundPlane, pictures: Sequence[Map]) -> None:
        self.ground = ground
        self._cv = opencv()
        self._maps = _camera_maps(ground)
        self._pictures = pictures
        self._scales = [1.0] * len(pictures)
        self._scales = _evening(self.samples(SPARSE))
        samples = self.samples(SPARSE)
        self._harmonics = [self._harmonic(samples, number) for number in range(len(SETS))]

    def phasors(self, rows: slice, columns: slice) -> tuple[list[tuple[Map, Map]], Map]:
        """For each of SETS the fringes relative to those of the flat mat, real and imaginary part; and white - black.

        Amplitudes are grey levels; the angle is the displacement of the light in turns of the period.
        """
        cv = self._cv
        part = self._rectify(rows, columns)
        result = []
        for number, fringes in enumerate(SETS):
            real, imaginary = _demodulated(part, number)
            real, imaginary = _without_harmonic(real, imaginary, self._harmonics[number])
            start, count = (columns.start, real.shape[1]) if fringes.axis == 0 else (rows.start, real.shape[0])
            phase = flat_phase(fringes, start, count)
            c, s = np.cos(phase), np.sin(phase)
            if fringes.axis == 1:
                c, s = c[:, None], s[:, None]
            turned = real * c + imaginary * s, imaginary * c - real * s
            result.append(tuple(cv.GaussianBlur(one, (7, 7), SMOOTH) for one in turned))
        return result, part[0] - part[1]

    def camera_maps(self, step: int) -> tuple[Map, Map]:
        """The camera px of every `step`th px of the canvas grid, from the middle of the first step on: x and y."""
        x, y = (np.ascontiguousarray(axis[step // 2 :: step, step // 2 :: step]) for axis in self._maps)
        return x, y

    def samples(self, step: int) -> list[Map]:
        """All pictures at every `step`th px of the canvas grid."""
        part = slice(step // 2, None, step)
        return self._rectify(part, part)

    def _rectify(self, rows: slice, columns: slice) -> list[Map]:
        cv = self._cv
        maps = [np.ascontiguousarray(axis[rows, columns]) for axis in self._maps]
        return [
            np.float32(scale) * cv.remap(picture, *maps, cv.INTER_LINEAR, borderValue=0)
            for picture, scale in zip(self._pictures, self._scales, strict=True)
        ]

    def _harmonic(self, samples: Sequence[Map], number: int) -> float:
        """Share of the second harmonic in a set of fringes, as a projector or camera with a bent response adds it."""
        real, imaginary = _demodulated(samples, number)
        fringes = SETS[number]
        phase = 2.0 * pi / fringes.period * (SPARSE // 2 + SPARSE * np.arange(real.shape[1 - fringes.axis]))
        turn = np.exp(1j * (phase if fringes.axis == 0 else phase[:, None]))
        phasor = real + 1j * imaginary
        flat = float((phasor / turn).real.mean())
        return float((phasor * turn * turn).real.mean()) / flat if flat > 1.0 else 0.0


def displacements(phasors: Sequence[tuple[Map, Map]], expected: Sequence[Map | float]) -> tuple[Map, Map]:
    """Displacement of the light along x and y, canvas px, unwrapped about the `expected` one."""
    cv, result = opencv(), []
    for axis in (0, 1):
        at = expected[axis]
        for number in (2 * axis, 2 * axis + 1):
            period = np.float32(SETS[number].period)
            angle = cv.phase(*phasors[number]) * (period / np.float32(2.0 * pi))
            at = at + _wrapped(angle - at, period)
        result.append(np.asarray(at, dtype=np.float32))
    return result[0], result[1]


def surface(pictures: Rectified, projector: ProjectorPlace, rows: slice, columns: slice) -> Surface:
    """Heights in a window of the canvas grid. A window of 60 rows takes some 20 ms."""
    top, bottom = max(0, rows.start - MARGIN), min(CANVAS[1], rows.stop + MARGIN)
    left, right = max(0, columns.start - MARGIN), min(CANVAS[0], columns.stop + MARGIN)
    phasors, contrast = pictures.phasors(slice(top, bottom), slice(left, right))
    typical = plane_displacement(pictures.ground, projector, TYPICAL, slice(top, bottom), slice(left, right))
    most = [np.float32(UNWRAP * SETS[2 * axis].period) for axis in (0, 1)]
    dx, dy = displacements(phasors, [line.clip(-high, high) for line, high in zip(typical, most, strict=True)])
    way_x, way_y = _ways(pictures.ground, projector, (left, top), dx, dy)
    square = way_x * way_x + way_y * way_y
    height = -(dx * way_x + dy * way_y) / square
    misfit = np.abs(dx * way_y - dy * way_x) / np.sqrt(square)
    strength = np.minimum(*(opencv().magnitude(*phasors[number]) for number in (1, 3)))
    inner = slice(rows.start - top, rows.stop - top), slice(columns.start - left, columns.stop - left)
    return Surface(_single(height[inner]), strength[inner], contrast[inner], _single(misfit[inner]))


def plane_displacement(
    ground: GroundPlane, projector: ProjectorPlace, height: float, rows: slice, columns: slice
) -> tuple[Map, Map]:
    """Displacement of the light, canvas px, that a plane `height` mm above the mat causes in a window."""
    zero = np.zeros((rows.stop - rows.start, columns.stop - columns.start), np.float32)
    way_x, way_y = _ways(ground, projector, (columns.start, rows.start), zero, zero)
    share = np.float32(-height * projector.height / (projector.height - height))
    return _single(share * way_x), _single(share * way_y)


def _ways(ground: GroundPlane, projector: ProjectorPlace, at: tuple[int, int], dx: Map, dy: Map) -> tuple[Map, Map]:
    """The vector d, px per mm, of each px of a window from canvas px `at` on, whose light is displaced by (dx, dy)."""
    result = []
    for axis, moved in enumerate((dx, dy)):
        line = np.arange(at[axis], at[axis] + moved.shape[1 - axis], dtype=np.float32) - np.float32(ARENA_AT[axis])
        seen = (line - np.float32(ground.foot[axis])) / np.float32(ground.height)
        lit = (line - np.float32(projector.foot[axis])) / np.float32(projector.height)
        way = seen - lit
        result.append((way if axis == 0 else way[:, None]) - moved * np.float32(1.0 / projector.height))
    return _single(result[0]), _single(result[1])


def _single(values: NDArray[Any]) -> Map:
    return np.asarray(values, dtype=np.float32)


def _demodulated(pictures: Sequence[Map], number: int) -> tuple[Map, Map]:
    """The phasor of a set of fringes, real and imaginary part."""
    one, two, three = pictures[2 + STEPS * number : 2 + STEPS * (number + 1)]
    side = two + three
    return _single((2.0 * one - side) / np.float32(3.0)), (two - three) * np.float32(1.0 / sqrt(3.0))


def _without_harmonic(real: Map, imaginary: Map, share: float) -> tuple[Map, Map]:
    """Remove a second harmonic, which adds `share` times the conjugate's square to a phasor of length 1."""
    if abs(share) < 1e-3:
        return real, imaginary
    scale = np.float32(share) / np.maximum(np.sqrt(real * real + imaginary * imaginary), np.float32(1e-3))
    square, product = real * real - imaginary * imaginary, 2.0 * real * imaginary
    return _single(real - scale * square), _single(imaginary + scale * product)


def _evening(samples: Sequence[Map]) -> list[float]:
    """Factors for equal brightness within each set of fringes: an exposure step must not look like a phase."""
    means = [float(sample.mean()) for sample in samples]
    result = [1.0, 1.0]
    for first in range(2, len(PATTERNS), STEPS):
        level = sum(means[first : first + STEPS]) / STEPS
        result += [level / max(means[i], 1.0) for i in range(first, first + STEPS)]
    return result


def _wrapped(values: Map, period: np.float32) -> Map:
    return np.asarray(values - period * np.rint(values / period))


def _camera_maps(ground: GroundPlane) -> tuple[Map, Map]:
    """The camera px at which each canvas px of the flat mat is seen: x and y, (1080, 1920)."""
    cv = opencv()
    wide, high = CANVAS[0] // COARSE + 2, CANVAS[1] // COARSE + 2
    rows, columns = np.mgrid[0:high, 0:wide] * float(COARSE)
    places = np.column_stack([columns.ravel() - ARENA_AT[0], rows.ravel() - ARENA_AT[1]])
    seen = ground.to_camera(places).astype(np.float32).reshape(high, wide, 2)
    u, v = (np.arange(size, dtype=np.float32) / np.float32(COARSE) for size in CANVAS)
    dense = cv.remap(seen, *np.meshgrid(u, v), cv.INTER_LINEAR)
    return np.ascontiguousarray(dense[..., 0]), np.ascontiguousarray(dense[..., 1])
