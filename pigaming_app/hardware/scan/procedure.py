"""Scan of the mat: project 14 pictures, observe each, compute the things; about 4 s and 1 s.

`Scan` needs no camera of its own: a scene projects `pattern`, confirms every frame by `mark_shown` and passes camera
frames to `process`, for instance as a viewer of the rig; a thread then calls `compute` until `finished`. Robots may
stand on the mat, but must not move.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import hypot, inf

import numpy as np

from pigaming_app.hardware.calibration.boards import CANVAS
from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane, size_mismatch
from pigaming_app.hardware.scan.expected import ExpectedLight
from pigaming_app.hardware.scan.heights import Map, Rectified, Surface, surface
from pigaming_app.hardware.scan.outlines import find_things, robot_shadows
from pigaming_app.hardware.scan.patterns import PATTERNS, SETS, STEPS, Pattern
from pigaming_app.hardware.scan.projector_place import Place, projector_place
from pigaming_app.hardware.scan.things import ProjectorPlace, Thing, ThingLayout, largest
from pigaming_app.hardware.signals import CameraFrame, Clock
from pigaming_app.hardware.vision.markers import WEARERS, MarkerDetector, opencv
from pigaming_app.sim.world import RADIUS
from pigaming_app.storage.messages import OperatorMessage

FRAMES = 3  # camera frames averaged for each picture
SOONEST, FIRST = 0.06, 0.4  # s from drawing a picture, and the first one, to the earliest frame that may show it
SAME, OTHER = 0.05, 0.12  # shares of the light: frames of one picture differ by less, those of two pictures by more
NOISE = 4.0  # grey levels by which frames of the same picture may always differ
DARK = 8.0  # grey levels, least mean difference between white and black
SPARSE = 8  # px between the samples of these comparisons
PATIENCE = 4.0  # s for each picture
MOVED, SOME = 6.0, 9  # grey levels by which the mean of fringes may vary, and connected samples beyond them
BRIGHT = 250.0  # grey levels of the white picture
GLARE = 0.02  # share of its px beyond them that is too bright
AROUND = 41  # samples, window of the gradients that changing room light leaves
BAND = 60  # rows of a slice of the computation


class Scan:
    """One scan. It ends with a `layout`, or with a `fault`.

    `before`: the layout known so far, whose projector is used if there are no robots to find its place again. `known`:
    places of robots, arena px, that are on the mat even if their markers cannot be read during the scan.
    """

    def __init__(
        self, ground: GroundPlane, clock: Clock, before: ThingLayout | None = None, known: Sequence[Place] = ()
    ) -> None:
        self.ground, self.clock = ground, clock
        self.fault: OperatorMessage | None = None
        self.layout: ThingLayout | None = None
        self.expected: ExpectedLight | None = None  # of the scanned mat, for `ThingsWatch`
        self.robots: list[Place] = []  # arena px, on the mat during the scan
        self.left_out = 0  # things found beyond those that an arena has room for
        self._projector, self._known = before.projector if before else None, known
        self._pictures: list[Map] = []
        self._sum: Map | None = None
        self._count = 0
        self._shown = inf  # s, when the present picture was first projected
        self._last: Map | None = None  # sparse samples of the previous frame of the present picture
        self._seen: list[Map] = []  # sparse samples of each finished picture
        self._work: Iterator[None] | None = None
        self._slices = 0

    @property
    def pattern(self) -> Pattern | None:
        """The picture to project; None when all were taken."""
        done = len(self._pictures)
        return PATTERNS[done] if done < len(PATTERNS) and not self.finished else None

    @property
    def finished(self) -> bool:
        """True with a layout or a fault."""
        return self.layout is not None or self.fault is not None

    @property
    def computing(self) -> bool:
        """True when all pictures were taken and `compute` is to be called."""
        return len(self._pictures) == len(PATTERNS) and not self.finished

    @property
    def progress(self) -> float:
        """Share of the work that is done, 0..1."""
        taken = (len(self._pictures) + self._count / FRAMES) / len(PATTERNS)
        return 1.0 if self.layout else min(0.99, 0.75 * taken + 0.007 * self._slices)

    def mark_shown(self, pattern: Pattern) -> None:
        """Confirm that `pattern` is projected; call it with every frame."""
        if pattern is self.pattern and self._shown == inf:
            self._shown = self.clock()

    def process(self, frame: CameraFrame) -> None:
        """Use a camera frame, if it shows the present picture."""
        if self.pattern is None or self._shown == inf:
            return
        if self.clock() - self._shown > PATIENCE:
            self.fault = OperatorMessage("scan_dark" if len(self._pictures) < 3 else "slow")
        size = (frame.image.shape[1], frame.image.shape[0])
        if size != self.ground.lens.size:
            self.fault = size_mismatch(self.ground, size)
        if self.finished or frame.captured < self._shown + (SOONEST if self._seen else FIRST):
            return
        few = frame.image[::SPARSE, ::SPARSE].astype(np.float32)
        if self._seen and _difference(few, self._seen[-1]) < max(NOISE, OTHER * self._light()):
            return  # the camera still shows the picture before
        if self._last is not None and _difference(few, self._last) > max(NOISE, SAME * self._light()):
            self._sum, self._count = None, 0  # still changing
        self._last = few
        if self._sum is None:
            self._sum = np.zeros(frame.image.shape, np.float32)
        opencv().accumulate(frame.image, self._sum)
        self._count += 1
        if self._count == FRAMES:
            self._finish(few)

    def compute(self) -> None:
        """Carry out the next slice of the computation, at most some 50 ms."""
        if not self.computing:
            return
        self._work = self._work or self._computation()
        self._slices += 1
        try:
            next(self._work, None)
        except CalibrationError as error:
            self.fault = error.message

    def _light(self) -> float:
        """Mean difference between white and black, grey levels; 0 until both were seen."""
        return _difference(self._seen[0], self._seen[1]) if len(self._seen) > 1 else 0.0

    def _finish(self, few: Map) -> None:
        assert self._sum is not None
        self._pictures.append(self._sum * np.float32(1.0 / FRAMES))
        self._seen.append(few)
        self._sum, self._count, self._last, self._shown = None, 0, None, inf
        if len(self._pictures) == 2 and self._light() < DARK:
            self.fault = OperatorMessage("scan_dark")

    def _computation(self) -> Iterator[None]:
        if _has_moved(self._pictures):
            bright = (self._pictures[0][::SPARSE, ::SPARSE] > BRIGHT).mean() > GLARE
            self.fault = OperatorMessage("scan_bright" if bright else "scan_moved")
            return
        yield
        seen = _robots(self._pictures[0], self.ground)
        self.robots = [*seen, *(at for at in self._known if all(hypot(at[0] - x, at[1] - y) > RADIUS for x, y in seen))]
        yield
        pictures = Rectified(self.ground, self._pictures)
        yield
        projector = self._place(pictures, seen)
        whole = Surface(*(np.zeros(CANVAS[::-1], np.float32) for _ in Surface._fields))
        for top in range(0, CANVAS[1], BAND):
            rows = slice(top, top + BAND)
            for all_rows, part in zip(whole, surface(pictures, projector, rows, slice(0, CANVAS[0])), strict=True):
                all_rows[rows] = part
            yield
        found: list[Thing] = []
        for things in find_things(whole, pictures, projector, self.robots):
            found = things
            yield
        layout = ThingLayout(largest(found), projector)
        self.left_out = len(found) - len(layout.things)
        covered = robot_shadows(self.robots, self.ground, projector)
        self.expected = ExpectedLight(pictures, whole, projector, covered)
        self.layout, self._pictures = layout, []  # 120 MB

    def _place(self, pictures: Rectified, robots: Sequence[Place]) -> ProjectorPlace:
        """The projector's place by robots on the mat, or else the one known before. Raises CalibrationError."""
        try:
            return projector_place(pictures, robots)
        except CalibrationError:
            if self._projector is None:
                raise
            return self._projector


def _difference(one: Map, other: Map) -> float:
    """Mean difference of two sparse pictures, grey levels."""
    return float(np.abs(one - other).mean())


def _has_moved(pictures: Sequence[Map]) -> bool:
    """True if something moved meanwhile, such as a hand, a robot or a thing.

    The mean of three phases of any fringes is the same even grey, between black and white. Each is compared with the
    sum of two others, each times a factor, that fits best: room light and exposure may change meanwhile.
    """
    cv = opencv()
    wide, high = pictures[0].shape[1] // SPARSE, pictures[0].shape[0] // SPARSE
    small = [cv.resize(picture, (wide, high), interpolation=cv.INTER_AREA) for picture in pictures]
    white, black = small[:2]
    means = [np.mean(small[2 + STEPS * i : 2 + STEPS * (i + 1)], axis=0) for i in range(len(SETS))]
    grey = np.mean(means, axis=0)
    pairs = [(grey, white), *pairwise(means), *pairwise(means[::-1])]
    return any(_differs_at_a_place(one, other, black) for one, other in pairs)


def _differs_at_a_place(one: Map, other: Map, black: Map) -> bool:
    """True if a picture is no such sum of two others at some place; wide gradients do not count."""
    cv = opencv()
    parts = np.column_stack([other.ravel(), black.ravel()])
    factors, *_ = np.linalg.lstsq(parts, one.ravel(), rcond=None)
    off = one - (parts @ factors).reshape(one.shape)
    off = np.asarray(off - cv.blur(off, (AROUND, AROUND)), dtype=np.float32)
    _, _, stats, _ = cv.connectedComponentsWithStats((np.abs(off) > MOVED).astype(np.uint8), connectivity=4)
    return int(stats[1:, 4].max(initial=0)) >= SOME


def _robots(white: Map, ground: GroundPlane) -> list[Place]:
    """Places of the robots whose markers the white picture shows, arena px."""
    image = np.asarray(np.rint(white).clip(0, 255), dtype=np.uint8)
    markers = MarkerDetector(WEARERS)
    marks = markers.refine(image, markers.detect(image))
    return [(fix.x, fix.y) for fix in ground.fixes(marks, 0.0) if not isinstance(fix, str)]
