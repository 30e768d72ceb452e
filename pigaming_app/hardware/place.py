"""Where the camera hangs: the point of the mat straight under it, and its height. The lids of the robots need it.

Two ways. With a ruler: the operator measures the height, and the point follows from how the mat looks (`hung`). Or
a robot stands on four projected outlines, and how far the camera sees it beside each says both (`stood`).
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.ground import Ground, NoGround
from pigaming_app.sim.world import HEIGHT, WIDTH

LOWEST, HIGHEST = 500.0, 10000.0  # mm, of a camera over a mat

MIDDLE = np.array((WIDTH / 2.0, HEIGHT / 2.0))  # of the arena, px

Matrix = NDArray[np.float64]


def hung(ground: Ground, height: float) -> Ground:
    """The ground with its camera `height` mm above the mat, as measured, and the foot point that follows.

    The plane of the mat and the height fix the focal length (it is not calibrated, only used here), and that the
    camera's pose: H = K (r1 r2 t). Raises NoGround.
    """
    if not LOWEST <= height <= HIGHEST:
        raise NoGround(f"A camera {height:.0f} mm above the mat: {LOWEST:.0f} to {HIGHEST:.0f} mm are possible.")
    matrix = _mat_to_rays(ground)
    low, high = 0.1, 20.0  # focal lengths in widths of the picture; the height grows with them
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _eye(matrix, middle)[2] < height else (low, middle)
    eye = _eye(matrix, low)
    if abs(eye[2] - height) > 1.0:
        raise NoGround(f"The mat does not look as from {height:.0f} mm above: measure the camera's height again.")
    return replace(ground, foot=(float(eye[0] / ground.mm), float(eye[1] / ground.mm)), height=height)


def stood(ground: Ground, places: Sequence[tuple[float, float]], seen: Sequence[tuple[float, float]]) -> Ground:
    """The ground with the camera's place by a robot that stood at `places`, arena px, seen at `seen`, camera px.

    What is `lid` mm above p is seen over C + (p - C) s, s = H / (H - lid): linear in s and in (1 - s) C. Raises
    NoGround.
    """
    there, apparent = np.array(places, dtype=np.float64), ground.on_mat(np.array(seen, dtype=np.float64))
    if len(there) < 2 or float(there.std(axis=0).max()) < 100.0:
        raise NoGround("The robot must stand in at least two places, far from each other.")
    away = there - there.mean(axis=0)
    grown = float((away * (apparent - apparent.mean(axis=0))).sum() / (away * away).sum())
    if not ground.lid / HIGHEST < grown - 1.0 < ground.lid / (LOWEST - ground.lid):
        raise NoGround("The robot was not where the outlines are: put it there as exactly as possible and try again.")
    foot = (apparent.mean(axis=0) - grown * there.mean(axis=0)) / (1.0 - grown)
    return replace(ground, foot=(float(foot[0]), float(foot[1])), height=ground.lid * grown / (grown - 1.0))


def _mat_to_rays(ground: Ground) -> Matrix:
    """The homography from mm on the mat to straightened camera px round the lens's centre, in widths."""
    back = np.linalg.inv(np.array(ground.plane).reshape(3, 3))
    (x, y), width = ground.lens.centre, ground.lens.size[0]
    to_rays = np.array([[1.0 / width, 0.0, -x / width], [0.0, 1.0 / width, -y / width], [0.0, 0.0, 1.0]])
    matrix = to_rays @ back @ np.diag([1.0 / ground.mm, 1.0 / ground.mm, 1.0])
    ahead = matrix[2, :2] @ MIDDLE * ground.mm + matrix[2, 2]
    return np.asarray(matrix if ahead > 0.0 else -matrix)


def _eye(matrix: Matrix, focal: float) -> Matrix:
    """The camera's centre over the mat in mm (z up, positive), for a focal length in widths."""
    rays = np.diag([1.0 / focal, 1.0 / focal, 1.0]) @ matrix
    scale = 0.5 * (np.linalg.norm(rays[:, 0]) + np.linalg.norm(rays[:, 1]))
    r1, r2, t = (rays / scale).T
    left, _, right = np.linalg.svd(np.stack([r1, r2, np.cross(r1, r2)], axis=1))
    eye = -(left @ right).T @ t
    return np.array([eye[0], eye[1], abs(eye[2])])
