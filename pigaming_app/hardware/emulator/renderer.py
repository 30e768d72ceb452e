"""Renderer of the emulated camera: projected light, objects, lens, room light and noise to a grey picture.

Regions around objects are rendered in every picture. The background is rendered only every `refresh` pictures, because
it takes ten times as long and a tracker hardly uses it; with 1 every picture is complete.
"""

from collections.abc import Sequence
from math import cos, pi, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.emulator.objects import LID_HEIGHT, TEXELS, FlatObject, Placing, Print
from pigaming_app.hardware.emulator.optics import SENSOR, Map, Optics
from pigaming_app.hardware.emulator.television import DIFFUSE, Television
from pigaming_app.hardware.emulator.things.overlay import Patch, patches, shaded
from pigaming_app.hardware.emulator.things.prism import Prism
from pigaming_app.hardware.signals import Image

LAMP_LIGHT, ROOM_LIGHT = 130.0, 55.0  # grey levels of white paper under projected white, and in room light
BLUR = 0.7  # px, of the lens
SPARE = 4  # px, margin around an object
LIGHT_STEPS = 100  # of the room light's period
NOISE = 2.5  # grey levels, standard deviation
KEPT = 32  # windows whose light is kept while the same picture is projected

Floats = NDArray[np.float32]


class ExposureSetup(NamedTuple):
    """Everything that determines one exposure."""

    image: Image  # (1080, 1920), the projected picture
    things: tuple[FlatObject, ...]
    light: float  # phase of the moving room light, in turns
    gain: float  # of the exposure
    number: int
    noise: float = 1.0  # amplification
    shine: tuple[float, ...] = (
        1.0,
    )  # light of a television that flickers, in equal parts from the first row to the last


class ImageRegion(NamedTuple):
    """A rectangle of the sensor, px; bottom and right are exclusive."""

    top: int
    left: int
    bottom: int
    right: int

    def cut(self) -> tuple[slice, slice]:
        """Slices of rows and columns."""
        return slice(self.top, self.bottom), slice(self.left, self.right)

    def overlaps(self, other: "ImageRegion") -> bool:
        """True if the regions overlap."""
        return (
            self.left < other.right and other.left < self.right and self.top < other.bottom and other.top < self.bottom
        )

    def union(self, other: "ImageRegion") -> "ImageRegion":
        """The bounding rectangle of both."""
        return ImageRegion(
            min(self.top, other.top),
            min(self.left, other.left),
            max(self.bottom, other.bottom),
            max(self.right, other.right),
        )


WHOLE = ImageRegion(0, 0, SENSOR[1], SENSOR[0])


class SceneRenderer:
    """Renders scenes for one camera. The same seed gives the same pictures."""

    def __init__(
        self,
        optics: Optics,
        seed: int,
        refresh: int = 1,
        size: tuple[int, int] = SENSOR,
        defocus: float = 0.0,
        jpeg: int = 0,
    ) -> None:
        """`refresh`: interval of complete pictures.

        `size`: px of the delivered pictures, scaled from the sensor's; `defocus`: px of them, standard deviation;
        `jpeg`: quality of their compression, 0: none.
        """
        self.refresh, self.size, self.jpeg = refresh, size, jpeg
        self._blur, noise = defocus * SENSOR[0] / size[0], NOISE * SENSOR[0] / size[0]  # scaling averages noise
        self.ambient = 1.0  # share of the room light
        self._screen: tuple[Map, Map] | None = None  # a television: light of its white, and of lamps in its glass
        self._seed = seed
        random = np.random.default_rng(seed)
        self._noise = np.clip(np.rint(random.normal(0.0, noise, (1400, 2300))), -127, 127).astype(np.int8)
        self._solid: tuple[Prism, ...] = ()
        self._cloth = self._mat = _cloth(random)
        self.look_through(optics)
        self._shade = _vignette()
        self._room: Image | None = None
        self._glow: tuple[int, Floats] = (-1, self._mat)  # phase in 1 / LIGHT_STEPS turns, and the room light there

    def look_through(self, optics: Optics) -> None:
        """Replace the optics, for a camera that was moved."""
        self.optics = optics
        self._floor, self._lids = optics.lit_by(0.0), optics.lit_by(LID_HEIGHT)
        self._beams = optics.beam(0.0), optics.beam(LID_HEIGHT)
        self._lights: tuple[Image | None, dict[tuple[bool, ImageRegion], Image]] = None, {}  # of a projected picture
        self.furnish(self._solid)

    def lay_television(self, television: Television) -> None:
        """Replace mat and projector by a television."""
        self._screen = television.seen(self.optics)

    def lay_paper(self, paper: Image, mm: float) -> None:
        """Lay printed paper on the mat in place of what lay there, grey, middle on middle; `mm`: of one of its px."""
        import cv2

        x, y = self.optics.plane(0.0, *WHOLE.cut())
        high, wide = paper.shape
        at = x / np.float32(mm) + np.float32(wide / 2 - 0.5), y / np.float32(mm) + np.float32(high / 2 - 0.5)
        footprint = self.optics.lens.eye[2] / self.optics.lens.focal / mm  # paper px in a px of the camera
        soft = cv2.GaussianBlur(paper, (0, 0), max(0.3, 0.4 * footprint))
        ink = cv2.remap(soft, *at, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT, borderValue=255.0)
        self._mat = np.asarray(self._cloth * (ink / np.float32(255.0)), dtype=np.float32)
        self.furnish(self._solid)

    def furnish(self, things: Sequence[Prism]) -> None:
        """Put these things on the mat, in place of all that stand on it. Takes about 0.1 s a thing."""
        self._solid = tuple(things)
        self._patches = patches(self._solid, self.optics, self._mat)
        self._tall = np.zeros(self._mat.shape, dtype=np.float32)  # mm, height of what each px shows
        for patch in self._patches:
            self._tall[patch.rows, patch.columns] = patch.height
        self._age = self.refresh

    def paint(self, scene: ExposureSetup) -> Image:
        """Render a picture of the camera's size, grey."""
        import cv2

        picture = self._painted(scene)
        if self.size != SENSOR:
            picture = np.asarray(cv2.resize(picture, self.size, interpolation=cv2.INTER_AREA))
        if self.jpeg:
            packed = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, self.jpeg])[1]
            picture = np.asarray(cv2.imdecode(packed, cv2.IMREAD_GRAYSCALE))
        return picture

    def _painted(self, scene: ExposureSetup) -> Image:
        """Render a picture of the whole sensor, (1080, 1920) grey."""
        random = np.random.default_rng((self._seed, scene.number))
        windows = [(thing, self._window(thing)) for thing in scene.things]
        if self.refresh == 1:
            return self._rendered(scene, WHOLE, windows, random)
        self._age += 1
        if self._room is None or self._age >= self.refresh:
            self._room, self._age = self._rendered(scene, WHOLE, [], random), 0
        picture = self._room.copy()
        for window in _merged([window for _, window in windows]):
            picture[window.cut()] = self._rendered(scene, window, windows, random)
        return picture

    def _rendered(
        self,
        scene: ExposureSetup,
        window: ImageRegion,
        things: list[tuple[FlatObject, ImageRegion]],
        random: np.random.Generator,
    ) -> Image:
        import cv2

        room = self._room_light(scene.light)[window.cut()]
        if self.ambient != 1.0:
            room = np.float32(self.ambient) * room
        light = self._ground(scene, window, room)
        for patch in self._patches:
            self._overlay(scene, patch, window, room, light)
        for thing, place in sorted(things, key=lambda pair: pair[0].height):
            if place.overlaps(window):
                self._lay(scene, thing, place, window, room, light)
        cv2.multiply(light, self._shade[window.cut()], dst=light, scale=scene.gain)
        if self._blur:
            cv2.GaussianBlur(light, (0, 0), self._blur, dst=light)
        height, width = light.shape
        top, left = int(random.integers(1400 - height)), int(random.integers(2300 - width))
        noise = self._noise[top : top + height, left : left + width]
        if scene.noise != 1.0:
            return np.asarray(cv2.add(light, noise * np.float32(scene.noise), dtype=cv2.CV_8U))
        return np.asarray(cv2.add(light, noise, dtype=cv2.CV_8U))

    def _ground(self, scene: ExposureSetup, window: ImageRegion, room: Floats) -> Floats:
        """Light of the empty mat, or of the glass of a television, in grey levels."""
        import cv2

        if self._screen is None:
            light = self._lit(scene, 0.0, window, room)
            cv2.multiply(light, self._mat[window.cut()], dst=light)
            return light
        white, lamps = (part[window.cut()] for part in self._screen)
        shown = self._shown(scene, 0.0, window).astype(np.float32) / np.float32(255.0)
        rows = (np.arange(window.top, window.bottom) + 0.5) / SENSOR[1] * len(scene.shine) - 0.5
        shine = np.interp(rows, np.arange(len(scene.shine)), scene.shine).astype(np.float32)
        return np.asarray(shine[:, None] * white * shown + lamps + np.float32(DIFFUSE) * room)

    def _overlay(self, scene: ExposureSetup, patch: Patch, window: ImageRegion, room: Floats, light: Floats) -> None:
        """Replace the light of a window by that of a patch with things."""
        top, bottom = max(patch.rows.start, window.top), min(patch.rows.stop, window.bottom)
        left, right = max(patch.columns.start, window.left), min(patch.columns.stop, window.right)
        if top >= bottom or left >= right:
            return
        inner = (
            slice(top - patch.rows.start, bottom - patch.rows.start),
            slice(left - patch.columns.start, right - patch.columns.start),
        )
        here = slice(top - window.top, bottom - window.top), slice(left - window.left, right - window.left)
        lamp = patch.projected(scene.image, BLUR)[inner]
        light[here] = np.float32(LAMP_LIGHT) * lamp + patch.room[inner] * room[here]

    def _lay(
        self,
        scene: ExposureSetup,
        thing: FlatObject,
        place: ImageRegion,
        window: ImageRegion,
        room: Floats,
        light: Floats,
    ) -> None:
        """Blend one object into the light of a window, averaged over its poses (motion blur)."""
        part = ImageRegion(
            max(place.top, window.top),
            max(place.left, window.left),
            min(place.bottom, window.bottom),
            min(place.right, window.right),
        )
        x, y = self.optics.plane(thing.height, *part.cut())
        if thing.slant != (0.0, 0.0):
            later = np.arange(part.top, part.bottom, dtype=np.float32)[:, None] - 0.5 * (place.top + place.bottom)
            x, y = x - np.float32(thing.slant[0]) * later, y - np.float32(thing.slant[1]) * later
        texture = _look(thing.texture, x, y, thing.poses if thing.poses[0] != thing.poses[-1] else thing.poses[:1])
        rows = slice(part.top - window.top, part.bottom - window.top)
        columns = slice(part.left - window.left, part.right - window.left)
        region = light[rows, columns]
        if self._solid:
            texture[self._tall[part.cut()] > thing.height] = 0.0  # hidden
        if thing.dark:
            region *= 1.0 + texture[..., 0] - texture[..., 1]
            return
        lit = self._lit(scene, thing.height, part, room[rows, columns])
        if self._solid:
            shade = shaded(self._solid, x, y, thing.height)
            lit[shade] = room[rows, columns][shade]
        region += texture[..., 0] * lit - texture[..., 1] * region

    def _lit(self, scene: ExposureSetup, height: float, window: ImageRegion, room: Floats) -> Floats:
        """Light on white paper on the mat, or at the height of a lid, in grey levels."""
        import cv2

        if self._screen is not None:
            return room.copy()
        shown = self._shown(scene, height, window)
        return np.asarray(cv2.addWeighted(shown, LAMP_LIGHT / 255.0, room, 1.0, 0.0, dtype=cv2.CV_32F))

    def _shown(self, scene: ExposureSetup, height: float, window: ImageRegion) -> Image:
        """The picture as it falls on a height, through the lens."""
        import cv2

        if self._lights[0] is not scene.image or len(self._lights[1]) >= KEPT:
            self._lights = scene.image, {}
        lights, key = self._lights[1], (height > 0.0, window)
        if key not in lights:
            x, y = self._lids if height else self._floor
            shown = cv2.remap(scene.image, x[window.cut()], y[window.cut()], cv2.INTER_LINEAR)
            lights[key] = np.asarray(cv2.GaussianBlur(shown, (5, 5), BLUR))
            if (beam := self._beams[height > 0.0]) is not None and self._screen is None:
                lights[key] = np.asarray(cv2.multiply(lights[key], beam[window.cut()], dtype=cv2.CV_8U))
        return lights[key]

    def _room_light(self, turn: float) -> Floats:
        """Room light on white paper: a bright spot moves over the mat."""
        phase = int(turn * LIGHT_STEPS)
        if self._glow[0] != phase:
            self._glow = phase, _room_light(phase / LIGHT_STEPS)
        return self._glow[1]

    def _window(self, thing: FlatObject) -> ImageRegion:
        """The region of the sensor that contains an object."""
        points = np.array([(pose[0], pose[1]) for pose in thing.poses])
        pixels = self.optics.sensor(points, thing.height)
        lens = self.optics.lens
        reach = thing.reach * lens.focal / (lens.eye[2] - thing.height) + SPARE + 3.0 * self._blur
        left, top = np.floor(pixels.min(axis=0) - reach).astype(int)
        right, bottom = np.ceil(pixels.max(axis=0) + reach).astype(int)
        wide, high = SENSOR
        top, left = min(max(int(top), 0), high - 1), min(max(int(left), 0), wide - 1)
        return ImageRegion(top, left, min(max(int(bottom), top + 1), high), min(max(int(right), left + 1), wide))


def _look(texture: Print, x: Map, y: Map, poses: tuple[Placing, ...]) -> Floats:
    """A print sampled at points of its plane and averaged over its poses, (rows, columns, 2)."""
    import cv2

    middle = len(texture) / 2 - 0.5
    whole = np.zeros((*x.shape, 2), dtype=np.float32)
    for at_x, at_y, heading in poses:
        c, s = np.float32(TEXELS * cos(heading)), np.float32(TEXELS * sin(heading))
        over, down = np.float32(middle + at_x * s - at_y * c), np.float32(middle + at_x * c + at_y * s)
        seen = cv2.remap(texture, y * c - x * s + over, down - x * c - y * s, cv2.INTER_LINEAR)
        cv2.accumulate(seen, whole)
    whole *= np.float32(1.0 / (255.0 * len(poses)))
    return whole


def _merged(windows: list[ImageRegion]) -> list[ImageRegion]:
    """Merge overlapping windows."""
    merged: list[ImageRegion] = []
    for window in windows:
        overlapping = [other for other in merged if other.overlaps(window)]
        while overlapping:
            for other in overlapping:
                merged.remove(other)
                window = window.union(other)
            overlapping = [other for other in merged if other.overlaps(window)]
        merged.append(window)
    return merged


def _room_light(turn: float) -> Floats:
    u, v = SENSOR[0] * (0.5 + 0.35 * sin(2 * pi * turn)), SENSOR[1] * (0.5 + 0.35 * sin(2 * pi * 1.7 * turn + 1.0))
    across = np.exp(-(((np.arange(SENSOR[0]) - u) / 500.0) ** 2)).astype(np.float32)
    down = np.exp(-(((np.arange(SENSOR[1]) - v) / 400.0) ** 2)).astype(np.float32)
    return np.asarray(np.float32(ROOM_LIGHT) * (1.0 + np.outer(np.float32(0.4) * down, across)), dtype=np.float32)


def _cloth(random: np.random.Generator) -> Floats:
    """Reflectance of the mat at each px: white cloth with soft blotches."""
    import cv2

    clouds = random.normal(0.85, 0.02, (34, 60)).astype(np.float32)
    return np.asarray(cv2.resize(clouds, SENSOR, interpolation=cv2.INTER_CUBIC), dtype=np.float32)


def _vignette() -> Floats:
    """Vignetting of the lens: 30 % less light in the corners."""
    v, u = (axis.astype(np.float32) for axis in np.ogrid[0 : SENSOR[1], 0 : SENSOR[0]])
    r2 = ((u - SENSOR[0] / 2) ** 2 + (v - SENSOR[1] / 2) ** 2) / np.float32((SENSOR[0] ** 2 + SENSOR[1] ** 2) / 4)
    return np.asarray(1.0 - np.float32(0.3) * r2, dtype=np.float32)
