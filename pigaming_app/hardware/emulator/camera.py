"""The emulated camera: it exposes on time, and hands each picture out late, or never.

A picture is painted only when somebody takes it. What it says about when it was taken is what a real reader can know:
the moment it arrived less the usual delay, wrong by the jitter of the driver.
"""

from collections import deque
from dataclasses import dataclass
from math import ceil
from random import Random
from typing import NamedTuple

from pigaming_app.hardware.emulator.renderer import CameraScene, SceneRenderer
from pigaming_app.hardware.signals import CameraFrame, Clock

UNTAKEN = 4  # pictures kept that have arrived and that nobody has taken


@dataclass(frozen=True)
class FrameTiming:
    """How the camera delivers."""

    fps: float = 60.0
    delay: float = 0.060  # s from the middle of the exposure to the program, usually
    jitter: float = 0.0015  # s, standard deviation
    drops: float = 0.0  # share of the pictures that never arrive


class Exposure(NamedTuple):
    """A picture under way."""

    scene: CameraScene
    arrives: float  # s


class EmulatedCamera:
    """A CameraSource over the emulated mat."""

    def __init__(self, painter: SceneRenderer, pace: FrameTiming, clock: Clock, seed: int) -> None:
        self.painter, self.pace, self.clock = painter, pace, clock
        self.due = clock()  # s, when the next exposure ends
        self.frozen = self.stuck = self.gone = False
        self.more_drops = 0.0
        self.exposed = self.delivered = 0
        self._taken: float | None = None  # s, when the picture was taken that somebody looks at now
        self._random = Random(f"camera {seed}")
        # While nobody takes pictures, only the newest are kept: those still in transit and a few that have arrived.
        self._under_way: deque[Exposure] = deque(maxlen=ceil(2.0 * pace.fps * pace.delay) + UNTAKEN)
        self.last: CameraFrame | None = None  # the newest that was given out

    def expose(self, scene: CameraScene, middle: float) -> None:
        """The shutter closes; `middle` (s) is the middle of the time that it was open."""
        pace, random = self.pace, self._random
        self.exposed += 1
        self.due += 1.0 / pace.fps
        lost = random.random() < pace.drops + self.more_drops
        arrives = middle + max(0.5 * pace.delay, random.gauss(pace.delay, pace.jitter))
        if self._under_way:
            arrives = max(arrives, self._under_way[-1].arrives)
        if not (lost or self.frozen or self.gone):
            self._under_way.append(Exposure(scene, arrives))

    @property
    def overdue(self) -> float:
        """Seconds for which a picture has been waiting to be taken, or whoever took one has not come back for more."""
        if self._taken is not None:
            return self.clock() - self._taken
        try:
            return max(0.0, self.clock() - self._under_way[0].arrives)
        except IndexError:  # none is under way, or it was taken just now
            return 0.0

    def newest(self) -> CameraFrame | None:
        """The newest picture that arrived by now and was not given out before, or None."""
        taken = self._taken = None
        while self._under_way and self._under_way[0].arrives <= self.clock():
            taken = self._under_way.popleft()
        if taken is None or self.gone:
            return None
        self.delivered += 1
        self._taken = self.clock()
        captured = taken.arrives - self.pace.delay
        if self.stuck and self.last is not None:
            self.last = CameraFrame(self.last.image, captured, taken.scene.number)
        else:
            self.last = CameraFrame(self.painter.paint(taken.scene), captured, taken.scene.number)
        return self.last

    def close(self) -> None:
        """Nothing arrives any more."""
        self.gone = True
        self._under_way.clear()
