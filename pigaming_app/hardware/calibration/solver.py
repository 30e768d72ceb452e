"""From what a camera sees of a board to a `GroundPlane`: homography and lens together, by Levenberg-Marquardt.

The residual is where a corner is seen less where the model says that it is seen, in camera px; robust against a few
wrong markers by leaving out those that fit far worse than the rest. HARDWARE.md has why k1 and k2 belong to it.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.boards import ENOUGH, CalibrationBoard
from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane, Points, project
from pigaming_app.hardware.calibration.least_squares import least_squares
from pigaming_app.hardware.calibration.lens import Lens
from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.vision.markers import opencv

MEAN_MM, MAX_MM = 1.5, 3.0  # the largest errors on the held-out board with which a calibration is accepted
OFF_CENTRE = 0.02  # of the width: how far a lens may well be off the picture's middle (prior)
CERTAIN = 0.1  # px, about the noise of an averaged corner, against which that prior is weighed
FAR = 5.0  # times the median error (and 0.5 px): a marker that is left out
TYPICAL_HEIGHT = 2500.0  # mm, until the operator has measured the camera's

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class Residuals:
    """What a calibration gets wrong on a board: at these arena px, by these arena px (both (n, 2)), in mm."""

    places: Points
    misses: Points
    mean_mm: float
    max_mm: float

    @property
    def accepted(self) -> bool:
        """Whether that is good enough to play."""
        return self.mean_mm <= MEAN_MM and self.max_mm <= MAX_MM

    @property
    def verdict(self) -> OperatorMessage:
        """The errors for the operator, and whether they are small enough."""
        errors = {"mean": f"{self.mean_mm:.1f}", "most": f"{self.max_mm:.1f}"}
        if self.accepted:
            return OperatorMessage("accurate", **errors)
        return OperatorMessage("inaccurate", **errors, need_mean=MEAN_MM, need_most=f"{MAX_MM:.0f}")


def solve(
    seen: Mapping[int, Points], board: CalibrationBoard, size: tuple[int, int], width_mm: float, display: str
) -> GroundPlane:
    """The plane on which the board's corners appear as in `BoardSamples.corners`. The camera's place is a guess.

    `size`: of the camera's pictures, px; `width_mm`: of the arena on the mat. Raises CalibrationError.
    """
    truth = board.corners
    numbers = [number for number in seen if number in truth]
    for _ in range(3):
        if len(numbers) < ENOUGH:
            raise CalibrationError(OperatorMessage("wrong_board"))
        places, points = _stacked(truth, numbers), _stacked(seen, numbers)
        found = _fit(places, points, size)
        errors = np.abs(_model(found, places, size) - points).reshape(len(numbers), -1).max(axis=1)
        kept = [number for number, error in zip(numbers, errors, strict=True) if error <= _limit(errors)]
        if len(kept) == len(numbers):
            break
        numbers = kept
    return _as_ground(found, size, width_mm, display)


def verify(ground: GroundPlane, seen: Mapping[int, Points], board: CalibrationBoard) -> Residuals:
    """How well the ground explains a board, which should be another than the one it was solved from."""
    truth = board.corners
    numbers = [number for number in seen if number in truth]
    places = _stacked(truth, numbers)
    misses = ground.on_mat(_stacked(seen, numbers)) - places
    errors = np.sqrt((misses * misses).sum(axis=1)) * ground.mm
    return Residuals(places, misses, float(errors.mean()), float(errors.max()))


def verified(ground: GroundPlane, residuals: Residuals) -> GroundPlane:
    """The ground with the errors of its verification noted. Raises CalibrationError where they are too large."""
    if not residuals.accepted:
        raise CalibrationError(residuals.verdict)
    return replace(ground, mean_mm=residuals.mean_mm, max_mm=residuals.max_mm)


def homography(places: Points, points: Points) -> Vector:
    """The 3 x 3 homography from places to points, both (n, 2), n >= 4. Raises CalibrationError where there is none."""
    matrix, _ = opencv().findHomography(places, points)
    if matrix is None:
        raise CalibrationError(OperatorMessage("wrong_board"))
    return np.asarray(matrix, np.float64)


def _fit(places: Points, points: Points, size: tuple[int, int]) -> Vector:
    """Eight of a homography from arena to camera, in units of the width; k1, k2; the lens's centre off the middle."""
    middle = np.array(Lens(size).centre)
    start = np.concatenate([homography(places / 1000.0, (points - middle) / size[0]).reshape(-1)[:8], np.zeros(4)])
    weak = CERTAIN / size[0] / OFF_CENTRE

    def residual(found: Vector) -> Vector:
        errors = (_model(found, places, size) - points).reshape(-1) / size[0]
        return np.concatenate([errors, weak * found[10:]])

    return least_squares(residual, start).at


def _model(found: Vector, places: Points, size: tuple[int, int]) -> Points:
    """Camera px at which places, arena px, are seen."""
    matrix = np.append(found[:8], 1.0).reshape(3, 3)
    lens = _lens(found, size)
    return lens.bend(np.array(lens.centre) + size[0] * project(matrix, places / 1000.0))


def _lens(found: Vector, size: tuple[int, int]) -> Lens:
    x, y = Lens(size).centre
    centre = (x + float(found[10]) * size[0], y + float(found[11]) * size[0])
    return Lens(size, float(found[8]), float(found[9]), centre)


def _as_ground(found: Vector, size: tuple[int, int], width_mm: float, display: str) -> GroundPlane:
    lens = _lens(found, size)
    (x, y), width = lens.centre, size[0]
    to_units = np.array([[1.0 / width, 0.0, -x / width], [0.0, 1.0 / width, -y / width], [0.0, 0.0, 1.0]])
    plane = np.diag([1000.0, 1000.0, 1.0]) @ np.linalg.inv(np.append(found[:8], 1.0).reshape(3, 3)) @ to_units
    plane /= plane[2, 2]
    middle = project(plane, np.array([lens.centre]))[0]
    return GroundPlane(
        display,
        lens,
        tuple(float(value) for value in plane.reshape(-1)),
        width_mm,
        (float(middle[0]), float(middle[1])),
        TYPICAL_HEIGHT,
    )


def _stacked(corners: Mapping[int, Points], numbers: list[int]) -> Points:
    return np.concatenate([corners[number] for number in numbers])


def _limit(errors: Vector) -> float:
    return max(0.5, FAR * float(np.median(errors)))
