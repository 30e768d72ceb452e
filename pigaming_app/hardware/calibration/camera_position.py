"""Camera position: its foot point on the mat and its height, needed to correct the parallax of the robots' lids.

`height_by_ruler`: the operator measures the height; the foot point follows from the perspective of the mat.
`height_by_robot`: a robot stands on four projected outlines; its parallax at each yields both.
`TwoHeights`: one marker on a robot and flat on the mat checks a height, whatever the marker's size and the mat's width.
"""

from collections import deque
from collections.abc import Sequence
from dataclasses import replace
from math import exp, log, sqrt

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane, Points, project
from pigaming_app.hardware.calibration.least_squares import least_squares
from pigaming_app.hardware.signals import DetectedMarker
from pigaming_app.hardware.vision.markers import opencv
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.storage.messages import OperatorMessage

LOWEST, HIGHEST = 500.0, 10000.0  # mm, of a camera or a projector over a mat
FOCAL = 0.3, 4.0  # limits, in picture widths: from a fish-eye to a telephoto lens
MAX_MISFIT = 20.0  # mm RMS on the mat: the projected image is not quite a rectangle
PICTURES = 6  # of a marker at rest
STEADY = 0.004  # relative spread of its size in them
LEAST, MOST = 0.006, 0.20  # relative differences of two heights
MAX_HEIGHT_ERROR = 0.15  # tolerated relative error of the measured height


Matrix = NDArray[np.float64]


def height_by_ruler(ground: GroundPlane, height: float) -> GroundPlane:
    """The ground with the camera at the measured `height` (mm above the mat) and the foot point that follows.

    Fits rotation, foot point and focal length (used here only) of a pinhole to the calibrated view of the mat. Raises
    CalibrationError.
    """
    if not LOWEST <= height <= HIGHEST:
        limits = {"low": f"{LOWEST:.0f}", "high": f"{HIGHEST:.0f}"}
        raise CalibrationError(OperatorMessage("height", height=f"{height:.0f}", **limits))
    x, y = np.meshgrid(np.linspace(0.0, WIDTH, 5), np.linspace(0.0, HEIGHT, 4))
    view = _PinholeModel(ground, np.column_stack([x.ravel(), y.ravel()]) * ground.mm, height)
    first = min((view.start(focal) for focal in np.geomspace(*FOCAL, 24)), key=view.cost)
    best = least_squares(view.misses, first).at
    if not FOCAL[0] < exp(best[5]) < FOCAL[1] or sqrt(view.cost(best) / len(view.places)) > MAX_MISFIT:
        raise CalibrationError(OperatorMessage("other_height", height=f"{height:.0f}"))
    return replace(
        ground, foot=(float(best[3] * 1000.0 / ground.mm), float(best[4] * 1000.0 / ground.mm)), height=height
    )


def height_by_robot(
    ground: GroundPlane, places: Sequence[tuple[float, float]], seen: Sequence[tuple[float, float]]
) -> GroundPlane:
    """The ground with the camera's foot and height, from a robot at `places` (arena px) observed at `seen` (camera px).

    Raises CalibrationError.
    """
    there, apparent = np.array(places, dtype=np.float64), ground.on_mat(np.array(seen, dtype=np.float64))
    if len(there) < 2 or float(there.std(axis=0).max()) < 100.0:
        raise CalibrationError(OperatorMessage("places"))
    if (found := foot_and_height(there, apparent, ground.lid)) is None:
        raise CalibrationError(OperatorMessage("beside"))
    return replace(ground, foot=found[0], height=found[1])


def foot_and_height(there: Points, cast: Points, lid: float) -> tuple[tuple[float, float], float] | None:
    """Foot C and height H (mm) of an eye or a lamp that casts points `lid` mm above `there` on the mat at `cast`.

    A point above p is cast at C + (p - C) s, s = H / (H - lid): linear in s and in (1 - s) C. None if implausible.
    """
    away = there - there.mean(axis=0)
    grown = float((away * (cast - cast.mean(axis=0))).sum() / (away * away).sum())
    if not lid / HIGHEST < grown - 1.0 < lid / (LOWEST - lid):
        return None
    foot = (cast.mean(axis=0) - grown * there.mean(axis=0)) / (1.0 - grown)
    return (float(foot[0]), float(foot[1])), lid * grown / (grown - 1.0)


class TwoHeights:
    """Collects sights of a marker near one place of the mat.

    `lid` mm above the mat it looks larger by H / (H - lid) than on it.
    """

    def __init__(self, ground: GroundPlane) -> None:
        self.ground = ground
        self._number: int | None = None
        self._recent: deque[float] = deque(maxlen=PICTURES)  # mm, on the mat
        self._low = self._high = 0.0

    def add(self, mark: DetectedMarker | None) -> None:
        """Add a sight with exact corners; None: the marker is not there."""
        if mark is None or mark.number != self._number:
            self._recent.clear()
        if mark is None:
            return
        if mark.number != self._number:
            self._number, self._low, self._high = mark.number, 0.0, 0.0
        corners = self.ground.on_mat(mark.corners)
        self._recent.append(float(np.hypot(*(corners - np.roll(corners, 1, axis=0)).T).mean()) * self.ground.mm)
        if len(self._recent) == PICTURES and np.ptp(self._recent) < STEADY * self._recent[0]:
            size = float(np.mean(self._recent))
            self._low, self._high = min(self._low or size, size), max(self._high, size)

    @property
    def seen(self) -> bool:
        """True once the marker was at rest."""
        return self._high > 0.0

    @property
    def height(self) -> float | None:
        """The camera's height above the mat, mm; None until the marker was seen at two heights."""
        larger = self._high / self._low - 1.0 if self._low else 0.0
        return self.ground.lid * (1.0 + larger) / larger if LEAST < larger < MOST else None

    @property
    def wrong(self) -> bool:
        """True if the height that was measured with a ruler is far off."""
        return self.height is not None and abs(self.ground.height / self.height - 1.0) > MAX_HEIGHT_ERROR


class _PinholeModel:
    """Reprojection errors of a pinhole `height` mm above the mat, for places (n, 2) on it in mm.

    A camera is a vector (6,): rotation vector, foot point in m, logarithm of the focal length in picture widths.
    """

    def __init__(self, ground: GroundPlane, places: Points, height: float) -> None:
        self.places, self.height = places, height
        self.matrix = _mat_to_rays(ground)
        self.rays = project(self.matrix, places)
        reach = project(self.matrix, places + np.array((1.0, 0.0))) - self.rays
        self.fine = float(np.sqrt((reach * reach).sum(axis=1)).mean())  # picture widths per mm of the mat

    def start(self, focal: float) -> Matrix:
        """The camera of this focal length closest to the homography H = K (r1 r2 t)."""
        rays = np.diag([1.0 / focal, 1.0 / focal, 1.0]) @ self.matrix
        r1, r2, t = (rays / (0.5 * (np.linalg.norm(rays[:, 0]) + np.linalg.norm(rays[:, 1])))).T
        left, _, right = np.linalg.svd(np.stack([r1, r2, np.cross(r1, r2)], axis=1))
        eye = -(left @ right).T @ t
        turn = opencv().Rodrigues(left @ right)[0].reshape(-1)
        return np.array([*turn, eye[0] / 1000.0, eye[1] / 1000.0, log(focal)])

    def misses(self, camera: Matrix) -> Matrix:
        """Reprojection errors in mm on the mat, (2 n,)."""
        away = np.column_stack([self.places - camera[3:5] * 1000.0, np.full(len(self.places), self.height)])
        seen = away @ opencv().Rodrigues(camera[:3])[0].T
        rays = exp(camera[5]) * seen[:, :2] / np.maximum(seen[:, 2:], 1.0)
        return np.asarray((rays - self.rays).reshape(-1) / self.fine)

    def cost(self, camera: Matrix) -> float:
        """Sum of the squared errors, mm^2."""
        misses = self.misses(camera)
        return float(misses @ misses)


def _mat_to_rays(ground: GroundPlane) -> Matrix:
    """Homography from mm on the mat to undistorted camera coordinates about the lens centre, in picture widths."""
    back = np.linalg.inv(np.array(ground.plane).reshape(3, 3))
    (x, y), width = ground.lens.centre, ground.lens.size[0]
    to_rays = np.array([[1.0 / width, 0.0, -x / width], [0.0, 1.0 / width, -y / width], [0.0, 0.0, 1.0]])
    matrix = to_rays @ back @ np.diag([1.0 / ground.mm, 1.0 / ground.mm, 1.0])
    ahead = matrix[2] @ (WIDTH / 2.0 * ground.mm, HEIGHT / 2.0 * ground.mm, 1.0)
    return np.asarray(matrix if ahead > 0.0 else -matrix)
