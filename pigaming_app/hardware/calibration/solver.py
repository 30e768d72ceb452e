"""Calibration solver: fits homography and lens of a `GroundPlane` jointly to a board, by Levenberg-Marquardt.

The residual is the reprojection error of a corner in camera px; a few wrong markers are rejected as outliers. Without
k1 and k2 a homography alone leaves errors of centimetres.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.boards import MIN_MARKERS
from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane, Lens, Points, project
from pigaming_app.hardware.calibration.least_squares import least_squares
from pigaming_app.hardware.vision.markers import opencv
from pigaming_app.storage.messages import OperatorMessage

MEAN_MM, MAX_MM = 1.5, 3.0  # upper limits of the errors on the held-out board
OFF_CENTRE = 0.02  # of the width, standard deviation of the prior of the lens centre
CORNER_NOISE = 0.1  # px, standard deviation of an averaged corner, as the weight of the data against that prior
OUTLIER = 5.0  # times the median error (and above 0.5 px): markers beyond it are rejected
TYPICAL_HEIGHT = 2500.0  # mm, of the camera until it is measured

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class Residuals:
    """Errors of a calibration on a board: places and errors in arena px, both (n, 2); mean and maximum in mm."""

    places: Points
    misses: Points
    mean_mm: float
    max_mm: float

    @property
    def accepted(self) -> bool:
        """True if the errors are small enough to play."""
        return self.mean_mm <= MEAN_MM and self.max_mm <= MAX_MM

    @property
    def verdict(self) -> OperatorMessage:
        """The message for the operator, with the errors in mm."""
        errors = {"mean": f"{self.mean_mm:.1f}", "most": f"{self.max_mm:.1f}"}
        if self.accepted:
            return OperatorMessage("accurate", **errors)
        return OperatorMessage("inaccurate", **errors, need_mean=MEAN_MM, need_most=f"{MAX_MM:.0f}")


class KnownMarkers(Protocol):
    """Markers at known places."""

    @property
    def corners(self) -> Mapping[int, Points]:
        """Corners of each, arena px, (n, 2)."""


def solve(
    seen: Mapping[int, Points],
    board: KnownMarkers,
    size: tuple[int, int],
    width_mm: float,
    display: str,
    least: int = MIN_MARKERS,
) -> GroundPlane:
    """Fit a ground plane to the corners of a board (`BoardSamples.corners`). The camera's position stays a guess.

    `size`: of the camera's pictures, px; `width_mm`: of the arena on the mat; `least`: markers needed. Raises
    CalibrationError.
    """
    truth = board.corners
    numbers = [number for number in seen if number in truth]
    for _ in range(3):
        if len(numbers) < least:
            raise CalibrationError(OperatorMessage("wrong_board"))
        places, points = _stacked(truth, numbers), _stacked(seen, numbers)
        parameters = _fit(places, points, size)
        errors = np.abs(_model(parameters, places, size) - points).reshape(len(numbers), -1).max(axis=1)
        inliers = [number for number, error in zip(numbers, errors, strict=True) if error <= _limit(errors)]
        if len(inliers) == len(numbers):
            break
        numbers = inliers
    return _as_ground(parameters, size, width_mm, display)


def verify(ground: GroundPlane, seen: Mapping[int, Points], board: KnownMarkers) -> Residuals:
    """Errors of the ground on a board other than the one that was solved."""
    truth = board.corners
    numbers = [number for number in seen if number in truth]
    places = _stacked(truth, numbers)
    misses = ground.on_mat(_stacked(seen, numbers)) - places
    errors = np.sqrt((misses * misses).sum(axis=1)) * ground.mm
    return Residuals(places, misses, float(errors.mean()), float(errors.max()))


def with_verification(ground: GroundPlane, residuals: Residuals) -> GroundPlane:
    """The ground with its verification errors. Raises CalibrationError if they are too large."""
    if not residuals.accepted:
        raise CalibrationError(residuals.verdict)
    return replace(ground, mean_mm=residuals.mean_mm, max_mm=residuals.max_mm)


def homography(places: Points, points: Points) -> Vector:
    """The homography (3, 3) from places to points, both (n, 2), n >= 4. Raises CalibrationError if none exists."""
    matrix, _ = opencv().findHomography(places, points)
    if matrix is None:
        raise CalibrationError(OperatorMessage("wrong_board"))
    return np.asarray(matrix, np.float64)


def _fit(places: Points, points: Points, size: tuple[int, int]) -> Vector:
    """Parameters (12,): 8 of the homography from arena to camera in picture widths; k1, k2; offset of the centre."""
    middle = np.array(Lens(size).centre)
    start = np.concatenate([homography(places / 1000.0, (points - middle) / size[0]).reshape(-1)[:8], np.zeros(4)])
    weak = CORNER_NOISE / size[0] / OFF_CENTRE

    def residual(parameters: Vector) -> Vector:
        errors = (_model(parameters, places, size) - points).reshape(-1) / size[0]
        return np.concatenate([errors, weak * parameters[10:]])

    return least_squares(residual, start).at


def _model(parameters: Vector, places: Points, size: tuple[int, int]) -> Points:
    """Project places (arena px) to camera px."""
    matrix = np.append(parameters[:8], 1.0).reshape(3, 3)
    lens = _lens(parameters, size)
    return lens.distort(np.array(lens.centre) + size[0] * project(matrix, places / 1000.0))


def _lens(parameters: Vector, size: tuple[int, int]) -> Lens:
    x, y = Lens(size).centre
    centre = (x + float(parameters[10]) * size[0], y + float(parameters[11]) * size[0])
    return Lens(size, float(parameters[8]), float(parameters[9]), centre)


def _as_ground(parameters: Vector, size: tuple[int, int], width_mm: float, display: str) -> GroundPlane:
    lens = _lens(parameters, size)
    (x, y), width = lens.centre, size[0]
    to_units = np.array([[1.0 / width, 0.0, -x / width], [0.0, 1.0 / width, -y / width], [0.0, 0.0, 1.0]])
    plane = np.diag([1000.0, 1000.0, 1.0]) @ np.linalg.inv(np.append(parameters[:8], 1.0).reshape(3, 3)) @ to_units
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
    return max(0.5, OUTLIER * float(np.median(errors)))
