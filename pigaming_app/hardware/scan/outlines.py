"""Outlines of things: tall ones where points stand above the mat, flat ones where its brightness changes.

Every px of a tall thing is moved to the place of the mat below it, so outlines have no parallax. Px across an edge mix
two heights and are left out; the outline is then moved outwards by their width. All masks lie on the canvas grid.
"""

from collections.abc import Iterator, Sequence
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.boards import ARENA_AT, CANVAS
from pigaming_app.hardware.calibration.ground_plane import GroundPlane
from pigaming_app.hardware.scan.background import own_brightness, own_height
from pigaming_app.hardware.scan.convex import convex_parts
from pigaming_app.hardware.scan.edges import refined
from pigaming_app.hardware.scan.heights import Map, Mask, Rectified, Surface
from pigaming_app.hardware.scan.things import Outline, ProjectorPlace, Thing, ThingKind, moved_outwards
from pigaming_app.hardware.vision.markers import opencv
from pigaming_app.sim.things.convex import signed_area
from pigaming_app.sim.world import HEIGHT, WIDTH

LOWEST, HIGHEST = 9.0, 420.0  # mm, of tall things
FAINT = 1.2  # grey levels, amplitude of the fringes below which a px counts as dark
MISFIT = 3.0  # px between camera ray and projector ray; beyond it a px mixes two surfaces
STEEP = 4.0, 0.05  # mm, and share of the height, by which neighbours of a px may differ
EDGE = 2.3  # px that tall things lose at each edge
CONTRAST = 0.24  # share by which something flat differs from the mat's brightness; 28 % with noise and blotches
SHADOW, DARK, BLACK = 0.022, 0.5, 0.2  # of the mat's brightness: shadow, the middle of a dark edge, something black
MEASURED = 0.75  # share of the px of something black whose heights suffice
LEVEL = 20.0  # mm, spread of half of the heights; beyond it is the side of something tall
SOLID = 0.85  # share of its hull that something black fills in spite of reflections
NARROW_TALL, NARROW_FLAT = 18.0, 11.0  # mm, least width
SMALL = 900.0  # mm^2, least area
ROBOT = 47.5, 75.0  # mm, radius and height of a robot
AROUND = 12.0  # mm left out around robots, and around everything that tall things hide or shade
UNSURE = 2.0, 2.5  # mm, and camera px: by how far a thing may extend beyond its outline

Pixels = NDArray[np.uint8]
Place = tuple[float, float]  # arena px


def find_things(
    surface: Surface, pictures: Rectified, projector: ProjectorPlace, robots: Sequence[Place]
) -> Iterator[list[Thing]]:
    """Yields the things found so far after each slice of the work, of about 30 ms; the last list is complete."""
    things: list[Thing] = []
    cv, ground = opencv(), pictures.ground
    height, lit = surface.height, (surface.strength > FAINT) & (surface.misfit < MISFIT)
    flat = lit & (np.abs(height) < LOWEST)  # the mat itself, or something flat
    yield things
    height = height - own_height(height, flat)
    yield things
    brightness = surface.contrast / own_brightness(surface.contrast, flat)
    margin = (UNSURE[0] + UNSURE[1] * _camera_mm(ground)) / ground.mm
    yield things
    black = np.zeros(CANVAS[::-1], np.uint8)
    clear = np.where(lit, height, np.float32(np.nan))
    for at, part in _components(_dark(brightness, robot_shadows(robots, ground, projector)), 3.0, ground):
        inside = _within(at, part)
        if part.any() and float(np.median(brightness[inside])) < BLACK:
            hull = _convex(at, part)
            if (thing := _black_thing(hull, clear[inside], ground, margin)) is not None:
                things.append(thing)
                cv.fillConvexPoly(black, _on_canvas(hull), 1)
    yield things
    footprint, heights = _footprints(_tall(height, lit) & (_grown(black, ground) == 0), height, ground)
    yield things
    for robot in robots:
        opencv().fillConvexPoly(footprint, _on_canvas(_disc(robot, ROBOT[0] + AROUND, ground)), 0)
    for at, mask in _components(footprint, 2.0, ground):
        for corners in convex_parts(mask, at):
            top = _top(heights, corners)
            outline = refined(pictures, projector, moved_outwards(corners, EDGE), top)
            if _counts(outline, NARROW_TALL, ground):
                things.append(_thing(ThingKind.TALL, outline, top, margin))
        yield things
    hidden = robot_shadows(robots, ground, projector)
    hidden |= _hidden([(thing.points, thing.height_mm) for thing in things], ground, projector)
    yield things
    stain = flat & (np.abs(height) < LOWEST) & (np.abs(brightness - 1.0) > CONTRAST) & (hidden == 0)
    for at, mask in _components(stain.astype(np.uint8), 0.35 * NARROW_FLAT / ground.mm, ground):
        for corners in convex_parts(mask, at):
            if _counts(corners, NARROW_FLAT, ground):
                things.append(_thing(ThingKind.FLAT, corners, 0.0, margin))
        yield things
    yield things


def robot_shadows(robots: Sequence[Place], ground: GroundPlane, projector: ProjectorPlace) -> Pixels:
    """Mask, on the canvas grid, of what robots hide from the camera or the projector."""
    return _hidden([(_disc(robot, ROBOT[0], ground), ROBOT[1]) for robot in robots], ground, projector)


def _dark(brightness: Map, robots: Pixels) -> Pixels:
    """Mask of what is dark, but neither shadow nor robot."""
    smooth = opencv().blur(brightness, (5, 5))
    return np.asarray((smooth > SHADOW) & (smooth < DARK) & (robots == 0)).astype(np.uint8)


def _within(at: tuple[int, int], part: Pixels) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Rows and columns of a part of the canvas."""
    rows, columns = np.nonzero(part)
    return np.asarray(rows + at[1]), np.asarray(columns + at[0])


def _black_thing(hull: Outline, heights: Map, ground: GroundPlane, margin: float) -> Thing | None:
    """A convex black thing in one piece if its heights are not measured well, as of a glossy one; else None.

    `heights`: of its px, mm; NaN: unknown.
    """
    known = heights[np.abs(heights) < HIGHEST]
    if not len(known):
        return None
    low, top, high = np.percentile(known, (25.0, 50.0, 75.0)).tolist()
    even = np.count_nonzero(np.abs(known - top) < STEEP[0]) > MEASURED * len(heights)
    well = even and abs(top - LOWEST) > STEEP[0]
    if well or high - low > LEVEL or len(heights) < SOLID * abs(signed_area(hull.tolist())):
        return None
    top = top if top > LOWEST else 0.0
    outline = np.array(ground.foot) + (hull - np.array(ground.foot)) * (1.0 - top / ground.height)
    kind = ThingKind.TALL if top else ThingKind.FLAT
    return _thing(kind, outline, top, margin) if _counts(outline, NARROW_TALL, ground) else None


def _convex(at: tuple[int, int], part: Pixels) -> Outline:
    """The hull of a part of the canvas, with few corners; arena px."""
    cv = opencv()
    points = np.argwhere(part)[:, ::-1].astype(np.int32)
    corners = cv.approxPolyDP(cv.convexHull(points), 1.5, True).reshape(-1, 2)
    return np.asarray(corners + np.array(at) - ARENA_AT, dtype=np.float64)


def _grown(mask: Pixels, ground: GroundPlane) -> Pixels:
    """A mask with the surroundings of all that it covers."""
    return np.asarray(opencv().dilate(mask, np.ones((2 * round(AROUND / ground.mm) + 1,) * 2, np.uint8)))


def _tall(height: Map, lit: Mask) -> Mask:
    """Points of tall things, without those across their edges."""
    cv, near = opencv(), np.ones((3, 3), np.uint8)
    range_ = cv.dilate(height, near) - cv.erode(height, near)
    even = range_ < np.float32(STEEP[0]) + np.float32(STEEP[1]) * height
    return np.asarray(lit & even & (height > LOWEST) & (height < HIGHEST))


def _footprints(tall: Mask, height: Map, ground: GroundPlane) -> tuple[Pixels, Map]:
    """The points of tall things moved to the mat below them: a mask, and their heights."""
    cv = opencv()
    rows, columns = np.nonzero(tall)
    z = height[rows, columns]
    share, foot = z / np.float32(ground.height), np.array(ground.foot) + ARENA_AT
    x = np.rint(columns - (columns - foot[0]) * share).astype(np.int32)
    y = np.rint(rows - (rows - foot[1]) * share).astype(np.int32)
    there = (x >= 0) & (x < CANVAS[0]) & (y >= 0) & (y < CANVAS[1])
    mask, heights = np.zeros(CANVAS[::-1], np.uint8), np.zeros(CANVAS[::-1], np.float32)
    mask[y[there], x[there]] = 1
    heights[y[there], x[there]] = z[there]
    return np.asarray(cv.morphologyEx(mask, cv.MORPH_CLOSE, np.ones((3, 3), np.uint8))), heights


def _components(mask: Pixels, thread: float, ground: GroundPlane) -> Iterator[tuple[tuple[int, int], Pixels]]:
    """Connected parts of a mask without threads of this radius in px: the canvas px at the top left, and the part."""
    cv = opencv()
    count, labels, stats, _ = cv.connectedComponentsWithStats(mask, connectivity=8)
    for number in range(1, count):
        left, top, wide, high, size = stats[number].tolist()
        if size * ground.mm**2 > 0.3 * SMALL:
            part = np.pad(labels[top : top + high, left : left + wide] == number, 1).astype(np.uint8)
            yield (left - 1, top - 1), cv.morphologyEx(part, cv.MORPH_OPEN, _round(thread))


def _top(heights: Map, corners: Outline) -> float:
    """Height of the top within an outline, mm."""
    left, top = np.maximum(np.floor((corners + ARENA_AT).min(axis=0)).astype(int), 0)
    right, bottom = np.ceil((corners + ARENA_AT).max(axis=0)).astype(int) + 1
    values = heights[top:bottom, left:right]
    values = values[values > LOWEST]
    return float(np.median(values[values > 0.8 * np.percentile(values, 90.0)])) if len(values) else LOWEST


def _counts(outline: Outline, narrow: float, ground: GroundPlane) -> bool:
    """True if an outline is not a sliver and lies in the arena, at least partly. `narrow`: mm."""
    _, sides, _ = opencv().minAreaRect(outline.astype(np.float32))
    inside = (outline > 0.0).all(axis=1) & (outline < (WIDTH, HEIGHT)).all(axis=1)
    return (
        min(sides) * ground.mm > narrow
        and abs(signed_area(outline.tolist())) * ground.mm**2 > SMALL
        and bool(inside.any())
    )


def _hidden(bodies: Sequence[tuple[Outline, float]], ground: GroundPlane, projector: ProjectorPlace) -> Pixels:
    """Mask of the mat that is hidden from the camera or the projector by bodies, given as outline and height in mm."""
    cv, mask = opencv(), np.zeros(CANVAS[::-1], np.uint8)
    for outline, height in bodies:
        for foot, above in ((ground.foot, ground.height), (projector.foot, projector.height)):
            cast = np.array(foot) + (outline - np.array(foot)) * (above / (above - height))
            cv.fillConvexPoly(mask, _on_canvas(np.concatenate([outline, cast])), 1)
    return _grown(mask, ground)


def _disc(at: Place, radius: float, ground: GroundPlane) -> Outline:
    """A circle of this radius in mm, as an outline."""
    turns = np.arange(24) * (2.0 * pi / 24)
    return np.array(at) + radius / ground.mm * np.column_stack([np.cos(turns), np.sin(turns)])


def _on_canvas(points: Outline) -> NDArray[np.int32]:
    """The hull of points, canvas px."""
    return np.asarray(opencv().convexHull(np.rint(points + ARENA_AT).astype(np.int32)))


def _round(radius: float) -> Any:
    """A disc as a kernel."""
    size = 2 * max(1, round(radius)) + 1
    return opencv().getStructuringElement(opencv().MORPH_ELLIPSE, (size, size))


def _camera_mm(ground: GroundPlane) -> float:
    """Millimetres of the mat per camera px, in the middle of the arena."""
    middle = np.array([(WIDTH / 2.0, HEIGHT / 2.0), (WIDTH / 2.0, HEIGHT / 2.0 + 1.0)])
    seen = ground.to_camera(middle)
    return ground.mm / float(np.hypot(*(seen[1] - seen[0])))


def _thing(kind: ThingKind, outline: Outline, height: float, margin: float) -> Thing:
    return Thing(kind, tuple((float(x), float(y)) for x, y in outline), height, margin)
