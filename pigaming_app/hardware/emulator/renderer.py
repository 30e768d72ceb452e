"""One exposure of the emulated camera becomes a grey picture: projected light, lids, lens, light of the room, noise.

The picture is exact around everything that stands on the mat. The rest of it is painted anew only every `refresh`
pictures, because that takes ten times as long as all the rest and a tracker hardly looks there; 1 leaves nothing out.
"""

from math import cos, pi, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.emulator.objects import LID_HEIGHT, TEXELS, FlatObject, Placing, Print
from pigaming_app.hardware.emulator.optics import SENSOR, Map, Optics
from pigaming_app.hardware.signals import Image

LAMP_LIGHT, ROOM_LIGHT = 130.0, 55.0  # grey levels of white paper under white of the projector, and in the room's light
BLUR = 0.7  # px, of the lens
SPARE = 4  # px around what is painted
STEADY = 100  # steps in which the room's light goes through a turn
NOISE = 2.5  # grey levels, standard deviation

Floats = NDArray[np.float32]


class CameraScene(NamedTuple):
    """What the sensor gathered in one exposure."""

    image: Image  # (1080, 1920), what the projector showed
    things: tuple[FlatObject, ...]
    light: float  # phase of the light that wanders through the room, in turns
    gain: float  # 1 as the camera was set
    number: int


class ImageRegion(NamedTuple):
    """A part of the sensor: from row and column to row and column."""

    top: int
    left: int
    bottom: int
    right: int

    def cut(self) -> tuple[slice, slice]:
        """Its rows and columns."""
        return slice(self.top, self.bottom), slice(self.left, self.right)

    def meets(self, other: "ImageRegion") -> bool:
        """Whether the two have a pixel in common."""
        return (
            self.left < other.right and other.left < self.right and self.top < other.bottom and other.top < self.bottom
        )

    def joined(self, other: "ImageRegion") -> "ImageRegion":
        """The smallest window that holds both."""
        return ImageRegion(
            min(self.top, other.top),
            min(self.left, other.left),
            max(self.bottom, other.bottom),
            max(self.right, other.right),
        )


WHOLE = ImageRegion(0, 0, SENSOR[1], SENSOR[0])


class SceneRenderer:
    """Paints scenes as one camera sees them. Two painters with the same seed paint the same."""

    def __init__(self, optics: Optics, seed: int, refresh: int = 1, noise: float = NOISE) -> None:
        """`refresh`: every which picture is whole; `noise`: grey levels, standard deviation."""
        self.refresh = refresh
        self.ambient = 1.0  # share of the room's light that is on
        self._seed = seed
        random = np.random.default_rng(seed)
        self._noise = np.clip(np.rint(random.normal(0.0, noise, (1400, 2300))), -127, 127).astype(np.int8)
        self.look_through(optics)
        self._mat = _cloth(random)
        self._shade = _vignette()
        self._room: Image | None = None
        self._glow: tuple[int, Floats] = (-1, self._mat)  # when the room's light was so, in STEADY ths of a turn

    def look_through(self, optics: Optics) -> None:
        """Hang the camera elsewhere."""
        self.optics = optics
        self._floor, self._lids = optics.lit_by(0.0), optics.lit_by(LID_HEIGHT)
        self._age = self.refresh

    def paint(self, scene: CameraScene) -> Image:
        """The picture, (1080, 1920)."""
        random = np.random.default_rng((self._seed, scene.number))
        windows = [(thing, self._window(thing)) for thing in scene.things]
        if self.refresh == 1:
            return self._painted(scene, WHOLE, windows, random)
        self._age += 1
        if self._room is None or self._age >= self.refresh:
            self._room, self._age = self._painted(scene, WHOLE, [], random), 0
        picture = self._room.copy()
        for window in _apart([window for _, window in windows]):
            picture[window.cut()] = self._painted(scene, window, windows, random)
        return picture

    def _painted(
        self,
        scene: CameraScene,
        window: ImageRegion,
        things: list[tuple[FlatObject, ImageRegion]],
        random: np.random.Generator,
    ) -> Image:
        import cv2

        room = np.float32(self.ambient) * self._room_light(scene.light)[window.cut()]
        light = self._lit(scene, self._floor, window, room)
        cv2.multiply(light, self._mat[window.cut()], dst=light)
        for thing, place in sorted(things, key=lambda pair: pair[0].height):
            if place.meets(window):
                self._lay(scene, thing, place, window, room, light)
        cv2.multiply(light, self._shade[window.cut()], dst=light, scale=scene.gain)
        height, width = light.shape
        top, left = int(random.integers(1400 - height)), int(random.integers(2300 - width))
        noise = self._noise[top : top + height, left : left + width]
        return np.asarray(cv2.add(light, noise, dtype=cv2.CV_8U))

    def _lay(
        self,
        scene: CameraScene,
        thing: FlatObject,
        place: ImageRegion,
        window: ImageRegion,
        room: Floats,
        light: Floats,
    ) -> None:
        """Paint one thing into the light of a window, in the mean over its poses."""
        part = ImageRegion(
            max(place.top, window.top),
            max(place.left, window.left),
            min(place.bottom, window.bottom),
            min(place.right, window.right),
        )
        x, y = self.optics.plane(thing.height, *part.cut())
        look = _look(thing.look, x, y, thing.poses if thing.poses[0] != thing.poses[-1] else thing.poses[:1])
        rows = slice(part.top - window.top, part.bottom - window.top)
        columns = slice(part.left - window.left, part.right - window.left)
        there = light[rows, columns]
        if thing.dull:
            there *= 1.0 + look[..., 0] - look[..., 1]
            return
        lit = self._lit(scene, self._lids if thing.height else self._floor, part, room[rows, columns])
        there += look[..., 0] * lit - look[..., 1] * there

    def _lit(self, scene: CameraScene, maps: tuple[Map, Map], window: ImageRegion, room: Floats) -> Floats:
        """How much light falls on white paper."""
        import cv2

        cut = window.cut()
        shown = cv2.remap(scene.image, maps[0][cut], maps[1][cut], cv2.INTER_LINEAR)
        shown = cv2.GaussianBlur(shown, (5, 5), BLUR)
        return np.asarray(cv2.addWeighted(shown, LAMP_LIGHT / 255.0, room, 1.0, 0.0, dtype=cv2.CV_32F))

    def _room_light(self, turn: float) -> Floats:
        """The room's light on white paper: a bright spot wanders over the mat."""
        when = int(turn * STEADY)
        if self._glow[0] != when:
            self._glow = when, _room_light(when / STEADY)
        return self._glow[1]

    def _window(self, thing: FlatObject) -> ImageRegion:
        """Where on the sensor a thing may be seen."""
        points = np.array([(pose[0], pose[1]) for pose in thing.poses])
        pixels = self.optics.sensor(points, thing.height)
        lens = self.optics.lens
        reach = thing.reach * lens.focal / (lens.eye[2] - thing.height) + SPARE
        left, top = np.floor(pixels.min(axis=0) - reach).astype(int)
        right, bottom = np.ceil(pixels.max(axis=0) + reach).astype(int)
        wide, high = SENSOR
        top, left = min(max(int(top), 0), high - 1), min(max(int(left), 0), wide - 1)
        return ImageRegion(top, left, min(max(int(bottom), top + 1), high), min(max(int(right), left + 1), wide))


def _look(look: Print, x: Map, y: Map, poses: tuple[Placing, ...]) -> Floats:
    """A print in the mean over its poses, as seen at points of its plane: (rows, columns, 2)."""
    import cv2

    middle = len(look) / 2 - 0.5
    whole = np.zeros((*x.shape, 2), dtype=np.float32)
    for at_x, at_y, heading in poses:
        c, s = np.float32(TEXELS * cos(heading)), np.float32(TEXELS * sin(heading))
        over, down = np.float32(middle + at_x * s - at_y * c), np.float32(middle + at_x * c + at_y * s)
        seen = cv2.remap(look, y * c - x * s + over, down - x * c - y * s, cv2.INTER_LINEAR)
        cv2.accumulate(seen, whole)
    whole *= np.float32(1.0 / (255.0 * len(poses)))
    return whole


def _apart(windows: list[ImageRegion]) -> list[ImageRegion]:
    """Windows that overlap become one."""
    apart: list[ImageRegion] = []
    for window in windows:
        meeting = [other for other in apart if other.meets(window)]
        while meeting:
            for other in meeting:
                apart.remove(other)
                window = window.joined(other)
            meeting = [other for other in apart if other.meets(window)]
        apart.append(window)
    return apart


def _room_light(turn: float) -> Floats:
    u, v = SENSOR[0] * (0.5 + 0.35 * sin(2 * pi * turn)), SENSOR[1] * (0.5 + 0.35 * sin(2 * pi * 1.7 * turn + 1.0))
    across = np.exp(-(((np.arange(SENSOR[0]) - u) / 500.0) ** 2)).astype(np.float32)
    down = np.exp(-(((np.arange(SENSOR[1]) - v) / 400.0) ** 2)).astype(np.float32)
    return np.asarray(np.float32(ROOM_LIGHT) * (1.0 + np.outer(np.float32(0.4) * down, across)), dtype=np.float32)


def _cloth(random: np.random.Generator) -> Floats:
    """How much light the mat throws back at each px: white cloth with clouds in it."""
    import cv2

    clouds = random.normal(0.85, 0.02, (34, 60)).astype(np.float32)
    return np.asarray(cv2.resize(clouds, SENSOR, interpolation=cv2.INTER_CUBIC), dtype=np.float32)


def _vignette() -> Floats:
    """Less light towards the corners of the sensor: 30 % less in them."""
    v, u = (axis.astype(np.float32) for axis in np.ogrid[0 : SENSOR[1], 0 : SENSOR[0]])
    r2 = ((u - SENSOR[0] / 2) ** 2 + (v - SENSOR[1] / 2) ** 2) / np.float32((SENSOR[0] ** 2 + SENSOR[1] ** 2) / 4)
    return np.asarray(1.0 - np.float32(0.3) * r2, dtype=np.float32)
