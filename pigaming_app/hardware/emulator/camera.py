"""The emulated camera: it exposes on time and delivers each picture late or never; its driver sets exposure and gain.

A picture is rendered only on request. Its timestamp is the one available to a real reader: the time of arrival minus
the usual delay, with the jitter of the driver as error.
"""

from collections import deque
from dataclasses import dataclass
from math import ceil, log2
from random import Random
from typing import NamedTuple

from pigaming_app.hardware.emulator.optics import SENSOR, TrueLens
from pigaming_app.hardware.emulator.renderer import ExposureSetup, SceneRenderer
from pigaming_app.hardware.signals import CameraFrame, Clock

QUEUE = 4  # arrived pictures that wait to be read
METERED = 0.006  # s, exposure of a normal picture in normal light
DOUBLING = 64.0  # units of gain that double the brightness


@dataclass(frozen=True)
class FrameTiming:
    """Timing of the camera."""

    fps: float = 60.0
    delay: float = 0.060  # s from the middle of the exposure to the program, mean
    jitter: float = 0.0015  # s, standard deviation
    drops: float = 0.0  # share of lost pictures


@dataclass(frozen=True)
class CameraTraits:
    """Quality of a camera and its driver.

    `units` of the exposure: `V4L2` (100 us), `DSHOW` (powers of two, s), or "" for a driver without exposure control.
    """

    units: str = "V4L2"
    metered: float = METERED  # s, exposure of a normal picture without gain: long in dim light
    shortest: float = 0.0003  # s, that the driver sets
    gains: float = 255.0  # highest gain
    defocus: float = 0.0  # px of the delivered picture, standard deviation
    size: tuple[int, int] = SENSOR  # px, of the delivered picture
    lens: TrueLens | None = None  # None: that of the arena
    jpeg: int = 0  # quality of the compression, 0: none
    readout: float = 0.0  # s from the first to the last row of a rolling shutter


TRAITS = {
    "good": CameraTraits(),
    "defocused": CameraTraits(defocus=2.2),
    "long": CameraTraits(metered=1 / 30),
    "stubborn": CameraTraits(metered=1 / 30, shortest=1 / 30),
    "silent": CameraTraits(units="", metered=1 / 30),
    "dim": CameraTraits(metered=1 / 8),
    "dark": CameraTraits(metered=1 / 8, gains=0.0),
    "compressed": CameraTraits(metered=1 / 60, size=(1280, 720), defocus=1.2, jpeg=80, readout=1 / 40),
    "tilted": CameraTraits(
        defocus=1.0, size=(1280, 720), lens=TrueLens((60.0, 1190.0, 2480.0), (5.0, 36.0), 0.021, 1900.0)
    ),
}


class Exposure(NamedTuple):
    """A picture in transit."""

    scene: ExposureSetup
    arrives: float  # s


class EmulatedCamera:
    """A CameraSource over the emulated mat."""

    def __init__(
        self, painter: SceneRenderer, timing: FrameTiming, clock: Clock, seed: int, traits: CameraTraits | None = None
    ) -> None:
        self.painter, self.timing, self.clock, self.traits = painter, timing, clock, traits or CameraTraits()
        self.automatic = True  # exposure
        self.manual, self.gain = METERED, 0.0  # s; units of the driver
        self.due = clock()  # s, when the next exposure ends
        self.frozen = self.stuck = self.gone = False
        self.extra_drops = 0.0
        self.exposed = self.delivered = 0
        self._taken: float | None = None  # s, when the picture in processing was read
        self._random = Random(f"camera {seed}")
        # Without a reader only the newest are kept: those in transit and a few that have arrived.
        self._in_transit: deque[Exposure] = deque(maxlen=ceil(2.0 * timing.fps * timing.delay) + QUEUE)
        self.last: CameraFrame | None = None  # the newest delivered frame

    def expose(self, scene: ExposureSetup, middle: float) -> None:
        """End an exposure; `middle` is the middle of its time, s."""
        timing, random = self.timing, self._random
        self.exposed += 1
        self.due += 1.0 / timing.fps
        lost = random.random() < timing.drops + self.extra_drops
        arrives = middle + max(0.5 * timing.delay, random.gauss(timing.delay, timing.jitter))
        if self._in_transit:
            arrives = max(arrives, self._in_transit[-1].arrives)
        if not (lost or self.frozen or self.gone):
            self._in_transit.append(Exposure(scene, arrives))

    @property
    def shutter(self) -> float:
        """Exposure time, s: as metered, at most a whole frame, or as set."""
        return min(self.traits.metered, 1.0 / self.timing.fps) if self.automatic else self.manual

    @property
    def boost(self) -> float:
        """Amplification by the gain, of light and noise."""
        return float(2.0 ** (self.gain / DOUBLING))

    @property
    def brightness(self) -> float:
        """Brightness of a picture relative to a normal one."""
        return self.boost * self.shutter / self.traits.metered

    @property
    def overdue(self) -> float:
        """Seconds for which a picture has been waiting, or for which the reader has been processing one."""
        if self._taken is not None:
            return self.clock() - self._taken
        try:
            return max(0.0, self.clock() - self._in_transit[0].arrives)
        except IndexError:  # none is in transit, or it was read just now
            return 0.0

    def newest(self) -> CameraFrame | None:
        """The newest arrived picture not delivered before, or None."""
        taken = self._taken = None
        while self._in_transit and self._in_transit[0].arrives <= self.clock():
            taken = self._in_transit.popleft()
        if taken is None or self.gone:
            return None
        self.delivered += 1
        self._taken = self.clock()
        captured = taken.arrives - self.timing.delay
        if self.stuck and self.last is not None:
            self.last = CameraFrame(self.last.image, captured, taken.scene.number)
        else:
            self.last = CameraFrame(self.painter.paint(taken.scene), captured, taken.scene.number)
        return self.last

    def close(self) -> None:
        """Discard all pictures; none arrives any more."""
        self.gone = True
        self._in_transit.clear()


class CameraDriver:
    """The driver of an emulated camera: property access like `cv2.VideoCapture`, properties by their cv2 numbers."""

    def __init__(self, camera: EmulatedCamera) -> None:
        import cv2

        self._camera, self._cv = camera, cv2
        self._on = 3.0 if camera.traits.units == "V4L2" else 1.0  # code of automatic exposure

    def getBackendName(self) -> str:  # noqa: N802
        return self._camera.traits.units or "AVFOUNDATION"

    def get(self, name: int) -> float:
        """The value of a property; 0 if the driver has none."""
        camera, cv = self._camera, self._cv
        if name == cv.CAP_PROP_GAIN and camera.traits.gains:
            return camera.gain
        if name == cv.CAP_PROP_EXPOSURE and camera.traits.units:
            return float(round(camera.shutter * 1e4) if camera.traits.units == "V4L2" else round(log2(camera.shutter)))
        return 0.0

    def set(self, name: int, value: float) -> bool:
        """Set a property, within its limits; False if the driver refuses."""
        camera, cv, traits = self._camera, self._cv, self._camera.traits
        if name == cv.CAP_PROP_GAIN and traits.gains:
            camera.gain = min(traits.gains, max(0.0, value))
            return True
        if name not in (cv.CAP_PROP_AUTO_EXPOSURE, cv.CAP_PROP_EXPOSURE):
            return False
        if name == cv.CAP_PROP_AUTO_EXPOSURE and traits.units:
            camera.manual, camera.automatic = camera.shutter, value == self._on
        elif traits.units:
            wanted = value * 1e-4 if traits.units == "V4L2" else 2.0 ** min(0.0, value)
            camera.manual, camera.automatic = max(traits.shortest, wanted), False
        return bool(traits.units)
