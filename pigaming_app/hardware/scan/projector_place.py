"""The projector's place over the mat, from robots: lids are at a known height, and fringes show what lights them."""

from collections.abc import Sequence
from math import hypot

import numpy as np

from pigaming_app.hardware.calibration.boards import ARENA_AT, CANVAS
from pigaming_app.hardware.calibration.camera_position import foot_and_height
from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane
from pigaming_app.hardware.scan.heights import Rectified, displacements
from pigaming_app.hardware.scan.things import ProjectorPlace
from pigaming_app.hardware.vision.markers import opencv
from pigaming_app.storage.messages import OperatorMessage

LID_RADIUS = 40.0  # mm, the part of a lid that is surely lid
FEWEST, APART = 2, 400.0  # robots, and the distance of two of them, px
FAINT = 4.0  # grey levels, amplitude of the fringes below which a px is ignored

Place = tuple[float, float]  # arena px


def projector_place(pictures: Rectified, robots: Sequence[Place]) -> ProjectorPlace:
    """The projector's place from robots at these places, arena px. Raises CalibrationError."""
    if len(robots) < FEWEST or max(hypot(x - u, y - v) for x, y in robots for u, v in robots) < APART:
        raise CalibrationError(OperatorMessage("projector_robots"))
    ground = pictures.ground
    pairs = [pair for robot in robots if (pair := _light(pictures, ground, robot)) is not None]
    if len(pairs) < FEWEST:
        raise CalibrationError(OperatorMessage("projector_robots"))
    there, light = (np.array(column) for column in zip(*pairs, strict=True))
    if (found := foot_and_height(there, light, ground.lid)) is None:
        raise CalibrationError(OperatorMessage("projector_robots"))
    return ProjectorPlace(*found)


def _light(pictures: Rectified, ground: GroundPlane, robot: Place) -> tuple[Place, Place] | None:
    """Mean point of a lid, and mean px that lights it, arena px; None if it is not lit."""
    foot, shrink = np.array(ground.foot), (ground.height - ground.lid) / ground.height
    seen = foot + (np.array(robot) - foot) / shrink
    reach = LID_RADIUS / ground.mm
    left, top = np.maximum(np.floor(seen - reach + ARENA_AT).astype(int), 0)
    right, bottom = np.minimum(np.ceil(seen + reach + ARENA_AT).astype(int) + 1, CANVAS)
    if right - left < reach or bottom - top < reach:
        return None
    phasors, _ = pictures.phasors(slice(top, bottom), slice(left, right))
    dx, dy = displacements(phasors, (0.0, 0.0))
    x = np.arange(left, right)[None, :] - ARENA_AT[0] + 0.0 * dy
    y = np.arange(top, bottom)[:, None] - ARENA_AT[1] + 0.0 * dx
    weight = np.minimum(*(opencv().magnitude(*phasors[number]) for number in (1, 3)))
    lid = (np.hypot(x - seen[0], y - seen[1]) < reach) & (weight > FAINT)
    if lid.sum() < 0.3 * reach * reach:
        return None
    near = lid & (np.abs(dx - np.median(dx[lid])) < 3.0) & (np.abs(dy - np.median(dy[lid])) < 3.0)
    at_x, at_y = float(x[near].mean()), float(y[near].mean())
    light = at_x + float(dx[near].mean()), at_y + float(dy[near].mean())
    there = foot + (np.array((at_x, at_y)) - foot) * shrink
    return (float(there[0]), float(there[1])), light
