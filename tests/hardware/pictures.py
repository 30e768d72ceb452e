"""Small test pictures of boards and robots on a mat, by a pinhole camera independent of the package."""

from math import cos, sin

import cv2
import numpy as np

MM = 1.32  # of an arena px
SIZE = (1280, 720)


class Pinhole:
    """A camera `height` mm above the point `foot` (arena px), tilted (rad) about x and y, with lens distortion."""

    def __init__(self, foot=(760.0, 430.0), height=2400.0, tilt=(0.05, -0.04), focal=950.0, k1=-0.25, k2=0.07):
        self.eye = np.array([*foot, -height / MM])
        self.turn = cv2.Rodrigues(np.array([*tilt, 0.02]))[0]
        self.focal, self.k1, self.k2 = focal, k1, k2
        self.centre = np.array([644.0, 355.0])

    def sees(self, places, height=0.0):
        """Arena px at a height (mm) above the mat to camera px."""
        points = np.column_stack([places, np.full(len(places), -height / MM)])
        rays = (points - self.eye) @ self.turn.T
        flat = rays[:, :2] / rays[:, 2:]
        r2 = (flat**2).sum(axis=1)[:, None]
        return self.centre + self.focal * flat * (1 + self.k1 * r2 + self.k2 * r2 * r2)

    def photo(self, canvas, noise=2.0, seed=1):
        """The picture of a canvas (1080, 1920) projected on the mat."""
        x, y = np.meshgrid(np.arange(0.0, SIZE[0] + 8, 8), np.arange(0.0, SIZE[1] + 8, 8))  # the rest is interpolated
        bent = (np.stack([x, y], axis=-1).reshape(-1, 2) - self.centre) / self.focal
        flat = bent.copy()
        for _ in range(25):
            r2 = (flat**2).sum(axis=1)[:, None]
            flat = bent / (1 + self.k1 * r2 + self.k2 * r2 * r2)
        rays = np.column_stack([flat, np.ones(len(flat))]) @ self.turn
        mat = self.eye[:2] + rays[:, :2] * (-self.eye[2] / rays[:, 2:])
        coarse = (mat + np.array([160.0, 140.0])).astype(np.float32).reshape(*x.shape, 2)
        v, u = np.mgrid[0 : SIZE[1], 0 : SIZE[0]].astype(np.float32) / 8.0
        maps = cv2.remap(coarse, u, v, cv2.INTER_LINEAR)
        seen = cv2.remap(canvas, maps[..., 0], maps[..., 1], cv2.INTER_LINEAR)
        return speckled(cv2.GaussianBlur(seen, (0, 0), 0.7) * 0.75 + 25.0, noise, seed)


def speckled(picture, noise=2.0, seed=1):
    """Add sensor noise to a picture."""
    return np.clip(picture + np.random.default_rng(seed).normal(0.0, noise, picture.shape), 0, 255).astype(np.uint8)


def square(pose, edge):
    """The corners of a marker in ArUco's order, its top ahead of the robot, (4, 2)."""
    x, y, heading = pose
    ahead, right = np.array([cos(heading), sin(heading)]), np.array([-sin(heading), cos(heading)])
    middle, half = np.array([x, y]), edge / 2.0
    return np.array([middle + half * (ahead * up + right * side) for up, side in ((1, -1), (1, 1), (-1, 1), (-1, -1))])


def lids(corners_of, size=SIZE, ground=40.0):
    """A picture of lids with markers, given as pairs (number, corners in camera px)."""
    picture = np.full((size[1], size[0]), ground, np.float32)
    for number, corners in corners_of:
        left, top = np.floor(corners.min(axis=0)).astype(int) - 40
        wide, high = np.ceil(corners.max(axis=0)).astype(int) + 40 - (left, top)
        patch = lid(number, corners - (left, top), (wide, high), ground)
        x, y = max(0, left), max(0, top)
        room = picture[y : top + high, x : left + wide]
        room[:] = patch[y - top : y - top + room.shape[0], x - left : x - left + room.shape[1]]
    return picture


def lid(number, corners, size, ground):
    """One marker on its lid, rendered at twice the size, scaled down and slightly blurred."""
    words = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    tile = np.full((160, 160), 225, np.uint8)
    tile[20:140, 20:140] = np.clip(cv2.aruco.generateImageMarker(words, number, 120), 25, 225)
    inner = np.array([(19.5, 19.5), (139.5, 19.5), (139.5, 139.5), (19.5, 139.5)], np.float32)
    onto = cv2.getPerspectiveTransform(inner, (corners * 2.0 + 0.5).astype(np.float32))
    large = np.full((int(size[1]) * 2, int(size[0]) * 2), ground, np.float32)
    shape = large.shape[::-1]
    there = cv2.warpPerspective(np.ones_like(tile), onto, shape) > 0
    large[there] = cv2.warpPerspective(tile, onto, shape)[there]
    shrunk = cv2.resize(large, (int(size[0]), int(size[1])), interpolation=cv2.INTER_AREA)
    return cv2.GaussianBlur(shrunk, (0, 0), 0.7)
