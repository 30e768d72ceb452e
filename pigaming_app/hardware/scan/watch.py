"""Watch over the things during a match: once a second, the camera picture is compared with the expected one.

The scene hands over the pictures it projects around that moment (`wants`, `note_canvas`), then the camera's frames
(`looks`, `process`); the expected light lies between the pictures' least and greatest, so that moving content cannot
disagree. The room light may change: it is measured by the median of a wide neighbourhood, which no thing fills. Robots
are left out. A disagreement counts if it stays in its place for PATIENCE checks in a row.
"""

from collections import deque
from collections.abc import Callable, Sequence

import numpy as np

from pigaming_app.hardware.calibration.boards import ARENA_AT
from pigaming_app.hardware.scan.expected import CELL, ExpectedLight, shrunk
from pigaming_app.hardware.scan.heights import Map, Mask
from pigaming_app.hardware.scan.outlines import robot_shadows
from pigaming_app.hardware.scan.projector_place import Place
from pigaming_app.hardware.signals import CameraFrame, Clock, Image
from pigaming_app.hardware.vision.markers import opencv
from pigaming_app.sim.world import HEIGHT, WIDTH

PERIOD = 1.0  # s between two checks
AT_ONCE = 0.25  # s between two checks of a still picture, in which PATIENCE only guards against a frame that is late
LIGHT_AFTER = 0.035  # s from drawing a picture to its light
SLACK = 0.07  # s by which the time of a camera frame, or of the light, may be wrong
WAIT = 0.2  # s after which a camera frame is used though no later picture of the canvas was kept
BURST = 0.3  # s before a check from which on pictures of the canvas are kept
PATIENCE = 3  # checks in a row
LEAST, SHARE = 6.0, 0.35  # grey levels, and share of the projected light, by which a cell may be off
SMALL = 400.0  # mm^2, least area of a disagreement: little of a thing of the mat's own colour is seen in dim light
WIDE = 61  # cells, window in which the room light changes alike
SLOW, OUTLIER = 41, 12.0  # cells, window of gradients that are left then; grey levels that count for them at most
DARK = 10.0  # grey levels of room light, below which its relative change is noise
STEADY = (
    3.0,
    0.1,
)  # grey levels, and share of the light, by which the expectation of a cell may vary that measures light
BESIDE = 40  # px round the arena in which things matter; further out are scores, markers and the edge of the light


class ThingsWatch:
    """Compares a match with the scanned mat. `changed` is True once things have moved, at `places` (arena px)."""

    def __init__(self, expected: ExpectedLight, clock: Clock, period: float = PERIOD) -> None:
        """`period`: s between two checks."""
        self.expected, self.clock, self.period = expected, clock, period
        self.changed = False
        self.places: list[Place] = []
        self.checks = 0
        self._canvases: deque[tuple[float, Image]] = deque(maxlen=64)
        self._due = clock() + period
        self._before: list[Mask] = []  # disagreements of the previous checks

    @property
    def wants(self) -> bool:
        """True while the pictures of the canvas are needed."""
        return self.clock() > self._due - BURST

    @property
    def looks(self) -> bool:
        """True while a frame of the camera is needed."""
        return self.clock() >= self._due

    def note_canvas(self, pixels: Callable[[], Image], drawn: float) -> None:
        """Keep the projected picture if it is needed. `pixels`: grey (1080, 1920) or BGRA; `drawn`: s of the clock."""
        if self.wants:
            self._canvases.append((drawn, shrunk(pixels())))

    def process(self, frame: CameraFrame, robots: Sequence[Place]) -> None:
        """Check a camera frame if one is due. `robots`: those seen or expected on the mat, arena px. About 8 ms."""
        lit = frame.captured - LIGHT_AFTER
        if frame.captured < self._due:
            return
        kept = tuple(self._canvases)  # the window adds to them in its own thread
        if not kept or (kept[-1][0] < lit + SLACK and self.clock() < frame.captured + WAIT):
            return  # a later picture may still come
        shown = [image for drawn, image in kept if lit - SLACK < drawn < lit + SLACK]
        earlier = [image for drawn, image in kept if drawn <= lit - SLACK]
        self._due = self.clock() + self.period
        self._canvases.clear()
        if earlier and len(shown) > 1:
            self.check(frame.image, [earlier[-1], *shown], robots)

    def check(self, image: Image, canvases: list[Image], robots: Sequence[Place]) -> None:
        """Compare a camera picture with what these pictures, as kept by `shrunk`, cause on the mat."""
        self.checks += 1
        self._before = [*self._before[1 - PATIENCE :], self.disagreement(image, canvases, robots)]
        if len(self._before) == PATIENCE:
            lasting = np.logical_and.reduce(self._before)
            self.places = _large_parts(lasting, self.expected.ground.mm)
            self.changed = self.changed or bool(self.places)

    def disagreement(self, image: Image, canvases: list[Image], robots: Sequence[Place]) -> Mask:
        """Cells whose light cannot be explained."""
        cv, expected = opencv(), self.expected
        seen, light = expected.seen(image), expected.light(canvases)
        usable = expected.usable & ~self._hidden(robots)
        low, high = light.room + light.least, light.room + light.most
        middle, steady = np.float32(0.5) * (low + high), usable & (high - low < STEADY[0] + STEADY[1] * high)
        gain = _gain(seen, middle, steady)
        room = gain * (light.room + np.float32(DARK))
        change = room * _room_change((seen - gain * middle) / room, steady)
        off = seen - np.clip(seen, gain * low + change, gain * high + change)
        off = np.abs(off - _gradient(off, usable))
        wrong = usable & (off > LEAST + SHARE * gain * light.most)
        solid = (wrong | ~expected.usable).astype(np.uint8)  # edges of things, of unknown light, make no part thinner
        return np.asarray(wrong & (cv.morphologyEx(solid, cv.MORPH_OPEN, np.ones((3, 3), np.uint8)) > 0))

    def _hidden(self, robots: Sequence[Place]) -> Mask:
        """Cells that robots occupy, or that are beside the arena."""
        hidden = robot_shadows(robots, self.expected.ground, self.expected.projector)
        (left, top), beside = map(round, ARENA_AT), np.ones_like(hidden)
        rows = slice(top - BESIDE, top + round(HEIGHT) + BESIDE)
        beside[rows, left - BESIDE : left + round(WIDTH) + BESIDE] = 0
        return np.asarray((hidden | beside)[CELL // 2 :: CELL, CELL // 2 :: CELL] > 0)


def _gain(seen: Map, expected: Map, usable: Mask) -> np.float32:
    """Exposure now relative to the scan's: the median ratio."""
    bright = usable & (expected > 15.0)
    if bright.sum() < 500:
        return np.float32(1.0)
    return np.float32(np.clip(np.median(seen[bright] / expected[bright]), 0.4, 2.5))


def _room_change(share: Map, steady: Mask) -> Map:
    """Relative change of the room light round each cell: the median of the steady cells' shares, at most 1."""
    cv, wide = opencv(), (WIDE, WIDE)
    bounded = np.where(steady, np.clip(share, -0.15, 0.15), np.float32(0.0))
    around = cv.blur(bounded, wide) / (cv.blur(steady.astype(np.float32), wide) + np.float32(1e-3))
    levels = np.clip(np.where(steady, share, around) * 127.0 + 128.5, 0.0, 255.0).astype(np.uint8)
    change = (cv.medianBlur(levels, WIDE).astype(np.float32) - np.float32(128.0)) / np.float32(127.0)
    return np.asarray(cv.blur(change, (9, 9)))


def _gradient(off: Map, usable: Mask) -> Map:
    """The mean of a difference in a wide neighbourhood of each cell: wandering room light, but nothing small."""
    cv, wide = opencv(), (SLOW, SLOW)
    bounded = np.where(usable, np.clip(off, -OUTLIER, OUTLIER), np.float32(0.0))
    return np.asarray(cv.blur(bounded, wide) / (cv.blur(usable.astype(np.float32), wide) + np.float32(1e-3)))


def _large_parts(mask: Mask, mm: float) -> list[Place]:
    """Centres of the large connected parts of a mask of cells, arena px."""
    count, _, stats, centres = opencv().connectedComponentsWithStats(mask.astype(np.uint8), connectivity=8)
    return [
        (CELL * (float(centres[i][0]) + 0.5) - ARENA_AT[0], CELL * (float(centres[i][1]) + 0.5) - ARENA_AT[1])
        for i in range(1, count)
        if stats[i][4] * (CELL * mm) ** 2 > SMALL
    ]
