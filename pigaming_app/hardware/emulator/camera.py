"""The emulated camera: it exposes on time and delivers each picture late or never.

A picture is rendered only on request. Its timestamp is the one available to a real reader: the time of arrival minus
the usual delay, with the jitter of the driver as error.
"""

from collections import deque
from dataclasses import dataclass
from math import ceil
from random import Random
from typing import NamedTuple

from pigaming_app.hardware.emulator.renderer import CameraScene, SceneRenderer
from pigaming_app.hardware.signals import CameraFrame, Clock

QUEUE = 4  # arrived pictures that wait to be read


@dataclass(frozen=True)
class FrameTiming:
    """Timing of the camera."""

    fps: float = 60.0
    delay: float = 0.060  # s from the middle of the exposure to the program, mean
    jitter: float = 0.0015  # s, standard deviation
    drops: float = 0.0  # share of lost pictures


class Exposure(NamedTuple):
    """A picture in transit."""

    scene: CameraScene
    arrives: float  # s


class EmulatedCamera:
    """A CameraSource over the emulated mat."""

    def __init__(self, painter: SceneRenderer, timing: FrameTiming, clock: Clock, seed: int) -> None:
        self.painter, self.timing, self.clock = painter, timing, clock
        self.due = clock()  # s, when the next exposure ends
        self.frozen = self.stuck = self.gone = False
        self.extra_drops = 0.0
        self.exposed = self.delivered = 0
        self._taken: float | None = None  # s, when the picture in processing was read
        self._random = Random(f"camera {seed}")
        # Without a reader only the newest are kept: those in transit and a few that have arrived.
        self._in_transit: deque[Exposure] = deque(maxlen=ceil(2.0 * timing.fps * timing.delay) + QUEUE)
        self.last: CameraFrame | None = None  # the newest delivered frame

    def expose(self, scene: CameraScene, middle: float) -> None:
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
