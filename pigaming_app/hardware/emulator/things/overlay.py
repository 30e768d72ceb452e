"""Look of things in the emulated camera: their tops and sides, and the shadows that they cast in projected light.

A camera ray ends at the highest prism it meets, or on the mat. That point is lit by the ray of the projector that
passes through it, unless a prism stands in between. All of it depends on the geometry alone, so it is computed once
for a set of things, with FINE x FINE rays a px; a picture then only looks up the projected image.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.emulator.objects import BLACK, MARKER, WHITE
from pigaming_app.hardware.emulator.optics import LAMP, SENSOR, Floats, Optics, canvas_px
from pigaming_app.hardware.emulator.things.prism import TEXELS, Map, Prism, cut, texture
from pigaming_app.hardware.signals import Image

FINE = 3  # rays a px, along each axis
SPARE = 8  # px, margin of a patch
SIDE_ROOM = 0.65  # share of the room light that reaches a side
TOUCH = 0.05  # mm above a surface from which on something may shade it


@dataclass(eq=False)
class Patch:
    """A part of the sensor with things in it."""

    rows: slice
    columns: slice
    canvas: tuple[Map, Map]  # px of the projected image that light each fine ray's end
    lamp: Map  # reflectance for projected light, fine
    room: Map  # reflectance for room light, a px
    height: Map  # mm, a px
    _last: tuple[Image, Map] | None = None  # the last projected image, and its light

    def projected(self, image: Image, blur: float) -> Map:
        """Projected light that the patch returns, as a share of white paper's under full light, (rows, columns)."""
        if self._last is None or self._last[0] is not image:
            self._last = image, self._lit_by(image, blur)
        return self._last[1]

    def _lit_by(self, image: Image, blur: float) -> Map:
        import cv2

        shown = cv2.remap(image, *self.canvas, cv2.INTER_LINEAR, borderValue=0)
        light = cv2.multiply(self.lamp, shown, dtype=cv2.CV_32F, scale=1.0 / 255.0)
        small = cv2.resize(light, self.room.shape[::-1], interpolation=cv2.INTER_AREA)
        return np.asarray(cv2.GaussianBlur(small, (5, 5), blur))


def patches(things: Sequence[Prism], optics: Optics, mat: Map) -> list[Patch]:
    """The patches of a set of things. `mat`: reflectance of the mat at each px of the sensor."""
    return [_patch(window, things, optics, mat) for window in (_window(thing, optics) for thing in things) if window]


def shaded(things: Sequence[Prism], x: Map, y: Map, height: float) -> NDArray[np.bool_]:
    """True where a thing keeps the projector's light from points `height` mm above the mat."""
    z = np.full(x.shape, height, np.float32)
    dark = np.zeros(x.shape, np.bool_)
    for thing in things:
        if thing.height > height:
            dark |= _blocks(thing, x, y, z)
    return dark


def _window(thing: Prism, optics: Optics) -> tuple[slice, slice] | None:
    """The part of the sensor in which a thing or its shadow may be seen, or None."""
    ground = np.array(thing.outline)
    grown = LAMP[2] / (LAMP[2] - thing.height)
    shadow = LAMP[:2] + (ground - LAMP[:2]) * grown
    seen = np.concatenate([optics.sensor(ground), optics.sensor(ground, thing.height), optics.sensor(shadow)])
    left, top = np.maximum(np.floor(seen.min(axis=0)).astype(int) - SPARE, 0)
    right, bottom = np.minimum(np.ceil(seen.max(axis=0)).astype(int) + SPARE, SENSOR)
    return (slice(top, bottom), slice(left, right)) if top < bottom and left < right else None


def _patch(window: tuple[slice, slice], things: Sequence[Prism], optics: Optics, mat: Map) -> Patch:
    import cv2

    rows, columns = window
    shape = rows.stop - rows.start, columns.stop - columns.start
    x, y = (_fine(axis) for axis in optics.plane(0.0, rows, columns))
    cloth = _fine(np.ascontiguousarray(mat[rows, columns]))
    eye_x, eye_y, eye_z = (np.float32(value) for value in optics.lens.eye)
    vx, vy = (eye_x - x) / eye_z, (eye_y - y) / eye_z
    z, lamp, room = np.zeros_like(x), cloth.copy(), cloth.copy()
    owner = np.full(x.shape, -1, np.int32)
    for number, thing in enumerate(things):
        if not _may_meet(thing, x, y, 0.0, optics.lens.eye):
            continue
        low, high, face = cut(thing, x, y, vx, vy)
        top = np.minimum(high, np.float32(thing.height))
        seen = (top > np.maximum(low, 0.0)) & (top > z)
        if not seen.any():
            continue
        z, owner = np.where(seen, top, z), np.where(seen, number, owner)
        lamp[seen], room[seen] = _surface(
            thing, x[seen] + top[seen] * vx[seen], y[seen] + top[seen] * vy[seen], top[seen], face[seen]
        )
    at_x, at_y = x + z * vx, y + z * vy
    lamp *= (np.float32(LAMP[2]) / (np.float32(LAMP[2]) - z)) ** 2
    for number, thing in enumerate(things):
        lamp[_blocks(thing, at_x, at_y, z) & (owner != number)] = 0.0
    canvas = canvas_px(optics.to_canvas, at_x, at_y, np.float32(LAMP[2]) / (np.float32(LAMP[2]) - z))
    size = shape[::-1]
    small = cv2.GaussianBlur(cv2.resize(room, size, interpolation=cv2.INTER_AREA), (5, 5), 0.7)
    height = cv2.resize(z, size, interpolation=cv2.INTER_AREA)
    return Patch(rows, columns, canvas, lamp, np.asarray(small), np.asarray(height))


def _surface(thing: Prism, x: Map, y: Map, z: Map, face: NDArray[np.int32]) -> tuple[Map, Map]:
    """Reflectance for projected light and for room light at points (n,) of a thing: on its top, or on a `face`."""
    light = texture(thing.look, thing.grey, thing.seed)
    c, s = np.float32(np.cos(thing.turn)), np.float32(np.sin(thing.turn))
    dx, dy = x - np.float32(thing.middle[0]), y - np.float32(thing.middle[1])
    along, across = c * dx + s * dy, c * dy - s * dx
    side = z < np.float32(thing.height) - np.float32(1e-3)
    normals, _ = thing.faces
    nx, ny = normals[face, 0].astype(np.float32), normals[face, 1].astype(np.float32)
    u, v = np.where(side, ny * dx - nx * dy, along), np.where(side, z + 150.0, across)
    columns, rows = (np.rint(axis + TEXELS / 2).astype(np.int32) % TEXELS for axis in (u, v))
    reflected = light[rows, columns]
    if thing.marker is not None:
        reflected = np.where(side, reflected, _marked(thing.marker, along, across, reflected))
    facing = (nx * (np.float32(LAMP[0]) - x) + ny * (np.float32(LAMP[1]) - y)) / (np.float32(LAMP[2]) - z)
    return (
        reflected * np.where(side, np.maximum(facing, 0.0), 1.0).astype(np.float32),
        reflected * np.where(side, np.float32(SIDE_ROOM), np.float32(1.0)),
    )


def _marked(number: int, along: Map, across: Map, plain: Map) -> Map:
    """Reflectance of a top with a marker in its middle, and a white cell around it."""
    import cv2

    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    cells = np.pad(cv2.aruco.generateImageMarker(dictionary, number, 6), 1, constant_values=255)
    edge = MARKER / 6.0
    columns, rows = (np.floor(axis / edge + 4.0).astype(np.int32) for axis in (along, across))
    on = (columns >= 0) & (columns < 8) & (rows >= 0) & (rows < 8)
    white = cells[rows.clip(0, 7), columns.clip(0, 7)] > 127
    return np.asarray(np.where(on, np.where(white, WHITE, BLACK), plain), dtype=np.float32)


def _blocks(thing: Prism, x: Map, y: Map, z: Map) -> NDArray[np.bool_]:
    """True where a thing is between a point and the projector."""
    if not _may_meet(thing, x, y, float(z.min()), LAMP):
        return np.zeros(x.shape, np.bool_)
    up = np.float32(LAMP[2]) - z
    low, high, _ = cut(thing, x, y, (np.float32(LAMP[0]) - x) / up, (np.float32(LAMP[1]) - y) / up)
    return np.asarray(np.minimum(high, np.float32(thing.height) - z) > np.maximum(low, np.float32(TOUCH)))


def _may_meet(thing: Prism, x: Map, y: Map, lowest: float, source: Sequence[float] | Floats) -> bool:
    """False if no line from these points, at least `lowest` mm high, to a lamp or an eye meets a thing."""
    share = max(0.0, (thing.height - lowest) / (float(source[2]) - lowest))
    for axis, above, corners in zip((x, y), source, zip(*thing.outline, strict=True), strict=False):
        first, last = float(axis.min()), float(axis.max())
        first, last = min(first, first + share * (above - first)), max(last, last + share * (above - last))
        if last < min(corners) or first > max(corners):
            return False
    return True


def _fine(axis: Map) -> Map:
    """A map with FINE x FINE values a px."""
    import cv2

    high, wide = axis.shape
    v, u = ((np.arange(FINE * size) + 0.5) / FINE - 0.5 for size in (high, wide))
    columns, rows = np.meshgrid(u.astype(np.float32), v.astype(np.float32))
    inner = cv2.remap(axis, columns, rows, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(inner, dtype=np.float32)
