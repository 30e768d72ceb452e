"""Optics of the emulated arena: projection from the projector onto the mat, and from there through the lens.

Lengths are mm on the mat, x right and y down from the centre of the projected image; height is up. The lens has more
distortion terms than a calibration fits, its centre is not that of the sensor, and the projected image is not quite a
rectangle, so that no calibration is exact.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Map = NDArray[np.float32]

CANVAS = (1920, 1080)  # px of the projected image
SENSOR = (1920, 1080)  # px of the camera
CORNERS = np.array([[-1274.0, -715.0], [1271.5, -719.0], [1277.0, 718.0], [-1275.0, 714.0]])  # mm, of the image
LAMP = np.array([-120.0, -500.0, 2700.0])  # mm, usual position of the projector
COARSE = 4  # px between the rays solved by iteration


@dataclass(frozen=True)
class TrueLens:
    """Camera pose, aim and lens."""

    eye: tuple[float, float, float] = (90.0, 270.0, 2480.0)  # mm, position with height
    aim: tuple[float, float] = (5.0, 26.0)  # mm, the point of the mat at the centre of the view
    roll: float = 0.021  # rad
    focal: float = 1780.0  # px
    centre: tuple[float, float] = (963.5, 537.0)  # px
    radial: tuple[float, float, float] = (-0.28, 0.09, -0.01)
    tangential: tuple[float, float] = (0.0004, -0.0003)


class Optics:
    """The maps between canvas, mat and sensor."""

    def __init__(self, lens: TrueLens | None = None, corners: Floats = CORNERS, lamp: Floats = LAMP) -> None:
        """`corners`: of the projected image, or of a printed one, mm on the mat, (4, 2); `lamp`: place of the
        projector, or of its image in a mirror, mm. Things are lit as from LAMP.
        """
        self.lens, self.lamp = lens or TrueLens(), lamp
        self.turn = _look_at(self.lens)
        rim = np.array([[0, 0], [CANVAS[0], 0], CANVAS, [0, CANVAS[1]]]) - 0.5  # integers are pixel centres
        self.to_mat = _homography(rim, corners)
        self.to_canvas: Floats = np.linalg.inv(self.to_mat).astype(np.float64)
        self.rays = _rays(self.lens, self.turn.tobytes())

    def mat(self, canvas: Floats) -> Floats:
        """Canvas px to mm on the mat, (n, 2)."""
        return _mapped(self.to_mat, canvas)

    def canvas(self, mat: Floats, height: float = 0.0) -> Floats:
        """Points (n, 2) in mm, `height` mm above the mat, to the canvas px that light them."""
        lamp = self.lamp
        return _mapped(self.to_canvas, lamp[:2] + (mat - lamp[:2]) * (lamp[2] / (lamp[2] - height)))

    def sensor(self, mat: Floats, height: float = 0.0) -> Floats:
        """Points (n, 2) in mm, `height` mm above the mat, to camera px."""
        x, y, up = self.lens.eye
        rays = np.column_stack([mat[:, 0] - x, mat[:, 1] - y, np.full(len(mat), up - height)]) @ self.turn.T
        return _distorted(self.lens, rays[:, :2] / rays[:, 2:])

    def plane(self, height: float, rows: slice, columns: slice) -> tuple[Map, Map]:
        """x and y (mm) on the plane at `height` mm for the pixels of a window of the sensor."""
        x, y, up = self.lens.eye
        rays = self.rays[rows, columns]
        return x + rays[..., 0] * np.float32(up - height), y + rays[..., 1] * np.float32(up - height)

    def lit_by(self, height: float) -> tuple[Map, Map]:
        """For every px of the sensor, the canvas px that lights its point on the plane at `height` mm: x and y."""
        return _lit_by(self.lens, self.turn.tobytes(), self.to_canvas.tobytes(), self.lamp.tobytes(), height)

    def beam(self, height: float) -> Map | None:
        """For every px of the sensor, the light of projected white on the plane at `height` mm, 1 in the middle of the
        mat; None from LAMP, which is taken for even.

        By geometry: light falls with the square of the distance, and by the cosine of its angle, which is the height
        over the distance.
        """
        if np.array_equal(self.lamp, LAMP):
            return None
        x, y = self.plane(height, slice(0, SENSOR[1]), slice(0, SENSOR[0]))
        over, down, up = (float(place) for place in self.lamp)
        near = over * over + down * down + up * up
        away = (x - np.float32(over)) ** 2 + (y - np.float32(down)) ** 2 + np.float32((up - height) ** 2)
        return np.asarray((np.float32(near) / away) ** np.float32(1.5), dtype=np.float32)


def _look_at(lens: TrueLens) -> Floats:
    """The rotation from mat (z down) to camera (x right, y down, z ahead)."""
    ahead = np.array([lens.aim[0] - lens.eye[0], lens.aim[1] - lens.eye[1], lens.eye[2]])
    ahead /= np.linalg.norm(ahead)
    right = np.cross(np.array([0.0, 1.0, 0.0]), ahead)
    right /= np.linalg.norm(right)
    down = np.cross(ahead, right)
    cosine, sine = np.cos(lens.roll), np.sin(lens.roll)
    return np.stack([cosine * right + sine * down, cosine * down - sine * right, ahead])


def _distorted(lens: TrueLens, rays: Floats) -> Floats:
    """Rays (n, 2), as x/z and y/z, to px: Brown's model (Brown 1971, in OpenCV's notation)."""
    x, y = rays[:, 0], rays[:, 1]
    (k1, k2, k3), (p1, p2) = lens.radial, lens.tangential
    r2 = x * x + y * y
    radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
    u = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)
    v = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y
    return np.column_stack([lens.centre[0] + lens.focal * u, lens.centre[1] + lens.focal * v])


@lru_cache(maxsize=4)
def _lit_by(lens: TrueLens, turn: bytes, to_canvas: bytes, place: bytes, height: float) -> tuple[Map, Map]:
    """Like `Optics.lit_by`, shared by all arenas with the same lens."""
    rays, up = _rays(lens, turn), np.float32(lens.eye[2] - height)
    x, y = lens.eye[0] + rays[..., 0] * up, lens.eye[1] + rays[..., 1] * up
    lamp = np.frombuffer(place)
    return canvas_px(np.frombuffer(to_canvas).reshape(3, 3), x, y, np.float32(lamp[2] / (lamp[2] - height)), lamp)


def canvas_px(to_canvas: Floats, x: Map, y: Map, grow: np.float32 | Map, place: Floats = LAMP) -> tuple[Map, Map]:
    """The canvas px that light these points, (x, y) of each; `grow`: by how far the rays of the lamp at this `place`
    lead on to the mat.
    """
    lamp, h = place.astype(np.float32), to_canvas.astype(np.float32)
    x, y = lamp[0] + (x - lamp[0]) * grow, lamp[1] + (y - lamp[1]) * grow
    below = h[2, 0] * x + h[2, 1] * y + h[2, 2]
    return (h[0, 0] * x + h[0, 1] * y + h[0, 2]) / below, (h[1, 0] * x + h[1, 1] * y + h[1, 2]) / below


@lru_cache(maxsize=2)
def _rays(lens: TrueLens, turn: bytes) -> Map:
    """The ray of every px of the sensor, (1080, 1920, 2): x and y on the mat per mm of descent."""
    import cv2

    wide, high = SENSOR[0] // COARSE + 1, SENSOR[1] // COARSE + 1
    rows, columns = np.mgrid[0:high, 0:wide] * COARSE
    pixels = np.column_stack([columns.ravel(), rows.ravel()]).astype(float)
    rays = (pixels - lens.centre) / lens.focal
    for _ in range(60):
        rays += (pixels - _distorted(lens, rays)) / lens.focal
    world = np.column_stack([rays, np.ones(len(rays))]) @ np.frombuffer(turn).reshape(3, 3)
    coarse = (world[:, :2] / world[:, 2:]).reshape(high, wide, 2).astype(np.float32)
    v, u = np.mgrid[0 : SENSOR[1], 0 : SENSOR[0]].astype(np.float32) / np.float32(COARSE)
    fine = cv2.remap(coarse, u, v, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(fine, dtype=np.float32)


def _homography(points: Floats, images: Floats) -> Floats:
    """The homography (3, 3) from four points to four others."""
    rows = []
    for (x, y), (u, v) in zip(points, images, strict=True):
        rows.append([x, y, 1, 0, 0, 0, -u * x, -u * y])
        rows.append([0, 0, 0, x, y, 1, -v * x, -v * y])
    return np.append(np.linalg.solve(np.array(rows), images.ravel()), 1.0).reshape(3, 3)


def _mapped(homography: Floats, points: Floats) -> Floats:
    image = np.column_stack([points, np.ones(len(points))]) @ homography.T
    return np.asarray(image[:, :2] / image[:, 2:], dtype=np.float64)
