"""Ground plane: camera px to arena px, by lens, homography of the mat, and parallax of the robots' lids.

Calibrations are solved by `solver` and serialized as TOML with a checksum (the caller owns the file). One of another
display, camera or version, or one edited by hand, is refused with a message for the operator.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import atan2, hypot
from typing import Annotated
from zlib import crc32

import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.quality import CameraQuality
from pigaming_app.hardware.signals import DetectedMarker, Fix
from pigaming_app.hardware.vision.markers import WEARERS
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.storage import schema
from pigaming_app.storage.messages import OperatorError, OperatorMessage
from pigaming_app.storage.parsing import ParseError, parse_toml, quote
from pigaming_app.storage.schema import between, to_plain, typed

VERSION = 1
PRINTED = "printed"  # the display of a calibration by printed markers, which holds with every screen
LID = 70.0  # mm from the mat to the marker on a robot
MARKER = 50.0  # mm, the edge of a robot's marker
MAX_SIZE_ERROR = 0.04  # relative deviation of the markers' size beyond which the arena's width is in doubt
MAX_KEYSTONE = 0.05  # relative difference of their sizes across the arena beyond which the image is no rectangle
SIZE_TOLERANCE = 0.12  # relative deviation beyond which a marker is not on a lid
SKEW_TOLERANCE = 1.18  # longest edge by shortest, beyond which a marker is tilted

ROUNDS = 6  # of Newton's method: to 1e-6 of the width for every lens that maps each point once

Points = NDArray[np.float64]  # (n, 2)


Side = Annotated[int, between(16, 16_384)]  # px
Centre = Annotated[float, between(0.0, 16_384.0)]  # px
Coefficient = Annotated[float, between(-1e6, 1e6)]
Plane = Annotated[tuple[Coefficient, ...], Meta(min_length=9, max_length=9)]
Place = Annotated[float, between(-1e5, 1e5)]  # arena px
Error = Annotated[float, between(0.0, 1e6)]


class CalibrationError(OperatorError):
    """A calibration that is missing or unusable."""


@dataclass(frozen=True)
class Lens:
    """Distortion of pictures of `size` px: two radial coefficients about `centre`, px, by default their middle.

    An undistorted point u (from the centre, in units of the picture's width) appears at u (1 + k1 r^2 + k2 r^4),
    r = |u|: the radial part of Brown's model (D. C. Brown, 1966). Combined with a homography the unit of length is
    free, so the focal length is not needed.
    """

    size: tuple[Side, Side]
    k1: Coefficient = 0.0
    k2: Coefficient = 0.0
    centre: tuple[Centre, Centre] = (-1.0, -1.0)

    def __post_init__(self) -> None:
        if self.centre[0] < 0.0:
            object.__setattr__(self, "centre", ((self.size[0] - 1) / 2.0, (self.size[1] - 1) / 2.0))

    def distort(self, straight: Points) -> Points:
        """Distort points, (n, 2) px."""
        away = (straight - self.centre) / self.size[0]
        r2 = (away * away).sum(axis=1)
        grown = 1.0 + r2 * (self.k1 + r2 * self.k2)
        return np.asarray(self.centre + away * (grown * self.size[0])[:, None])

    def undistort(self, seen: Points) -> Points:
        """Undistort points, (n, 2) px: the inverse of `bend`, by Newton's method."""
        away = (seen - self.centre) / self.size[0]
        bent = np.sqrt((away * away).sum(axis=1))
        r = bent.copy()
        for _ in range(ROUNDS if self.k1 or self.k2 else 0):
            r2 = r * r
            slope = 1.0 + r2 * (3.0 * self.k1 + r2 * 5.0 * self.k2)
            r -= (r * (1.0 + r2 * (self.k1 + r2 * self.k2)) - bent) / np.maximum(slope, 0.05)
        share = np.divide(r, bent, out=np.ones_like(r), where=bent > 1e-9)
        return np.asarray(self.centre + away * (share * self.size[0])[:, None])


@dataclass(frozen=True)
class GroundPlane:
    """A calibration. The camera is `height` mm above the mat, over the point `foot` (arena px)."""

    display: str  # the display it was made on, as in `Canvas.displays`, or PRINTED
    lens: Lens  # with the size of the pictures
    plane: Plane  # homography, row by row: undistorted camera px -> arena px on the mat
    width_mm: Annotated[float, between(100.0, 20_000.0)]  # of the arena on the mat, measured with a ruler
    foot: tuple[Place, Place]
    height: Annotated[float, between(200.0, 20_000.0)]  # mm
    lid: Annotated[float, between(0.0, 500.0)] = LID
    marker: Annotated[float, between(5.0, 500.0)] = MARKER
    mean_mm: Error = 0.0  # errors on the held-out board
    max_mm: Error = 0.0
    quality: CameraQuality = field(default_factory=CameraQuality)  # of the picture

    def __post_init__(self) -> None:
        matrix = np.array(self.plane, dtype=np.float64).reshape(3, 3)
        object.__setattr__(self, "_onto", matrix)
        object.__setattr__(self, "_back", np.linalg.inv(matrix))

    @property
    def printed(self) -> bool:
        """True if the floor is printed: nothing is projected on it."""
        return self.display == PRINTED

    @property
    def mm(self) -> float:
        """Millimetres of the mat per arena px."""
        return self.width_mm / WIDTH

    def on_mat(self, seen: Points) -> Points:
        """Camera px to arena px for points on the mat, (n, 2) -> (n, 2)."""
        return project(self._onto, self.lens.undistort(seen))  # type: ignore[attr-defined]

    def at_height(self, seen: Points, height: float) -> Points:
        """Camera px to arena px for points `height` mm above the mat, (n, 2) -> (n, 2)."""
        apparent = self.on_mat(seen)
        foot = np.array(self.foot)
        return np.asarray(foot + (apparent - foot) * ((self.height - height) / self.height))

    def to_camera(self, places: Points, height: float = 0.0) -> Points:
        """Arena px to camera px for points `height` mm above the mat, (n, 2) -> (n, 2)."""
        foot = np.array(self.foot)
        apparent = foot + (places - foot) * (self.height / (self.height - height))
        return self.lens.distort(project(self._back, apparent))  # type: ignore[attr-defined]

    def fixes(self, marks: Sequence[DetectedMarker], captured: float) -> list[Fix | str]:
        """A fix for each marker of a robot, or the reason why it cannot be on a robot: `size` or `tilted`."""
        if not marks:
            return []
        seen = np.concatenate([mark.corners for mark in marks])
        corners = self.at_height(seen, self.lid).reshape(-1, 4, 2)
        robots = [WEARERS[mark.number] for mark in marks]
        return [self._fix(robot, corner, captured) for robot, corner in zip(robots, corners.tolist(), strict=True)]

    def edge_mm(self, mark: DetectedMarker) -> float:
        """The apparent edge of a marker on a lid, mm; wrong if the mat was measured wrongly."""
        corners = self.at_height(mark.corners, self.lid).tolist()
        return sum(_edges(corners)) / 4.0 * self.mm

    @property
    def weakest_edge(self) -> float:
        """The edge of a robot's marker at the place of the arena where it appears smallest, camera px.

        Seen at an angle, that of its shorter side.
        """
        x, y = np.meshgrid(np.linspace(0.0, WIDTH, 9), np.linspace(0.0, HEIGHT, 6))
        places, step = np.column_stack([x.ravel(), y.ravel()]), 1.0 / self.mm
        here, right, down = (
            self.to_camera(places + np.array(aside), self.lid) for aside in ((0.0, 0.0), (step, 0.0), (0.0, step))
        )
        scales = np.linalg.svd(np.stack([right - here, down - here], axis=2), compute_uv=False)
        return self.marker * float(scales.min())

    def _fix(self, robot: int, corners: list[list[float]], captured: float) -> Fix | str:
        edges = _edges(corners)
        if not max(edges) <= SKEW_TOLERANCE * min(edges):
            return "tilted"
        if abs(sum(edges) / 4.0 * self.mm / self.marker - 1.0) > SIZE_TOLERANCE:
            return "size"
        (ax, ay), (bx, by), (cx, cy), (dx, dy) = corners
        heading = atan2(ay + by - cy - dy, ax + bx - cx - dx)
        return Fix(robot, (ax + bx + cx + dx) / 4.0, (ay + by + cy + dy) / 4.0, heading, captured)


def keystone(places: Points, sizes: Sequence[float]) -> float:
    """By how much markers look larger at one side of the arena than at the other, a share; `places`: (n, 2), arena px.

    Robots' markers are alike, so sizes that change with the place show that the projected image is no rectangle.
    """
    rows = np.column_stack([np.ones(len(places)), places - places.mean(axis=0)])
    mean, across, down = np.linalg.lstsq(rows, np.array(sizes), rcond=None)[0].tolist()
    return float((abs(across) * WIDTH + abs(down) * HEIGHT) / max(mean, 1e-6))


def _edges(corners: list[list[float]]) -> list[float]:
    return [hypot(corners[i][0] - corners[i - 1][0], corners[i][1] - corners[i - 1][1]) for i in range(4)]


def project(matrix: NDArray[np.float64], points: Points) -> Points:
    """Apply a homography (3, 3) to points (n, 2)."""
    flat = points @ matrix[:, :2].T + matrix[:, 2]
    return np.asarray(flat[:, :2] / flat[:, 2:])


def to_toml(ground: GroundPlane) -> str:
    """Serialize a calibration as TOML with a checksum."""
    entries = {"version": VERSION, **to_plain(ground)}
    return schema.to_toml({**entries, "check": _check(entries)})


def read(text: str, display: str | None = None, camera: tuple[int, int] | None = None) -> GroundPlane:
    """Parse a calibration. Raises CalibrationError, also for another display or camera size than given."""
    try:
        entries = parse_toml(text)
        if entries.get("version") != VERSION:
            raise CalibrationError(OperatorMessage("version", theirs=quote(entries.get("version")), ours=VERSION))
        if entries.pop("check", None) != _check(entries):
            raise CalibrationError(OperatorMessage("changed"))
        ground = typed(entries, GroundPlane)
        if not np.isfinite(np.linalg.inv(np.array(ground.plane).reshape(3, 3))).all():
            raise ParseError("plane: not a plane that can be seen")
        if ground.lid >= ground.height:
            raise ParseError("lid: as high as the camera")
    except ParseError as error:
        raise CalibrationError(OperatorMessage("damaged", detail=error)) from error
    if display is not None and ground.display not in (display, PRINTED):
        raise CalibrationError(OperatorMessage("other_display", theirs=ground.display, ours=display))
    if camera is not None and ground.lens.size != camera:
        raise CalibrationError(size_mismatch(ground, camera))
    return ground


def size_mismatch(ground: GroundPlane, camera: tuple[int, int]) -> OperatorMessage:
    """The message for pictures of another size than the calibration's."""
    theirs, ours = ("{} x {}".format(*size) for size in (ground.lens.size, camera))
    return OperatorMessage("other_camera", theirs=theirs, ours=ours)


def _check(entries: dict[str, object]) -> int:
    return crc32(repr(sorted((key, _plain(value)) for key, value in entries.items())).encode())


def _plain(value: object) -> object:
    """Canonical form: lists for tuples, which TOML lacks, and sorted items for dictionaries."""
    if isinstance(value, dict):
        return sorted((key, _plain(inner)) for key, inner in value.items())
    return [_plain(inner) for inner in value] if isinstance(value, list | tuple) else value
