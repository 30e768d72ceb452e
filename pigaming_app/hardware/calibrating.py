"""What the calibration wizard does with a camera: look through it, calibrate by two boards, find its height by a robot.

Each is a Worker: it opens the camera, works bit by bit, and lets go of it. What must be projected meanwhile stands in
`board` or `place`; whoever projects it says so (`shown`), and only pictures taken well after that count.
"""

from collections.abc import Callable
from dataclasses import replace
from enum import Enum, auto
from math import inf

import numpy as np

from pigaming_app.hardware.boards import BOARD, FRAMES, HELD_OUT, Board, Look
from pigaming_app.hardware.drift import Drift
from pigaming_app.hardware.ground import Ground, NoGround
from pigaming_app.hardware.markers import ROBOT_IDS, Markers, NoVision
from pigaming_app.hardware.place import hung, stood
from pigaming_app.hardware.said import Said, said
from pigaming_app.hardware.signals import Frame, Image, Mark
from pigaming_app.hardware.site import Measures, Sees, Site
from pigaming_app.hardware.solver import Residuals, solve, verified, verify
from pigaming_app.hardware.worker import Worker

BLIND = 6.0  # s without a picture after which it is given up
LIT = 0.4  # s from a picture being drawn until it is surely seen by the camera, all delays included
SMALL = (520, 292)  # px of the picture that shows what the camera sees
RATE = 1.0  # s over which pictures are counted
PLACES = ((320.0, 220.0), (1280.0, 220.0), (1280.0, 680.0), (320.0, 680.0))  # arena px of the outlines
NEAR = 90.0  # arena px from an outline within which a robot is meant to stand on it
STILL = 12  # pictures in which a robot must not move
UNREST = 1.0  # px of the camera that it may tremble
PATIENCE = 120.0  # s for somebody to put a robot down

NO_PICTURE = Said("The camera sends no pictures.", "no_picture")
BROKEN = Said("Something broke; the log says what.", "broken")


class _Looking(Worker):
    """Opens a camera and hands on its pictures."""

    def __init__(self, site: Site, number: int) -> None:
        super().__init__()
        self.site, self.number = site, number
        self.trouble: str | None = None
        self.small: Image | None = None  # the newest picture, as small as it is shown
        self._eye: Sees | None = None
        self._since = self._newest = inf  # s: when it was opened, when the newest picture came

    def step(self) -> None:
        """Look at the newest picture, if there is a new one."""
        now = self.site.clock()
        if self._eye is None:
            self._since = self._newest = now
            try:
                self._eye = self.site.open(self.number)
            except NoVision as missing:
                self.give_up(said(missing))
                return
        frame = self._eye.newest()
        if frame is not None:
            self._newest = now
            self.small = shrunk(frame.image)
            self.look(frame)
        else:
            self.idle(now - self._newest, self._eye.trouble)

    def look(self, frame: Frame) -> None:
        """A new picture."""

    def idle(self, seconds: float, trouble: str | None) -> None:
        """No new picture for so long."""

    def give_up(self, trouble: str) -> None:
        """End with this sentence."""
        self.trouble = trouble

    def failed(self, error: Exception) -> None:
        self.give_up(BROKEN)

    def end(self) -> None:
        if self._eye is not None:
            self._eye.close()


class Preview(_Looking):
    """What a camera sees: `small`, its `size` in px and how many pictures a second; or what is wrong with it."""

    def __init__(self, site: Site, number: int) -> None:
        super().__init__(site, number)
        self.size = (0, 0)
        self.rate = 0.0
        self.count = 0
        self._counted = (inf, 0)

    def look(self, frame: Frame) -> None:
        self.size, self.trouble = (frame.image.shape[1], frame.image.shape[0]), None
        self.count += 1
        now, (since, before) = self.site.clock(), self._counted
        if now - since > RATE:
            self.rate = (self.count - before) / (now - since)
        if not 0.0 <= now - since <= RATE:
            self._counted = (now, self.count)

    def idle(self, seconds: float, trouble: str | None) -> None:
        if seconds > 1.0:
            self.trouble = trouble or NO_PICTURE


class Checking(_Looking):
    """Whether a calibration still holds: how far the four corner markers are from where it says that they are seen.

    `load` makes the ground for a camera with pictures of so many px, or raises NoGround.
    """

    def __init__(self, site: Site, number: int, load: Callable[[tuple[int, int]], Ground]) -> None:
        super().__init__(site, number)
        self.drift: Drift | None = None
        self.mm: float | None = None  # None: not yet known
        self._load = load

    def look(self, frame: Frame) -> None:
        if self.trouble is not None:
            return
        try:
            if self.drift is None:
                self.drift = Drift(self._load((frame.image.shape[1], frame.image.shape[0])))
        except NoGround as trouble:
            self.give_up(said(trouble))
            return
        self.drift.see(frame)
        self.mm = self.drift.mm or None  # exactly 0: none has been seen often enough

    def idle(self, seconds: float, trouble: str | None) -> None:
        if seconds > BLIND:
            self.give_up(trouble or NO_PICTURE)


class Stage(Enum):
    """How far a calibration is."""

    OPENING = auto()
    LOOKING = auto()
    VERIFYING = auto()
    DONE = auto()
    FAILED = auto()


class Calibration(_Looking):
    """One calibration of the camera on this display. At the end there are `ground` and `residuals`, or `trouble`.

    A calibration that is done may still be too bad to be accepted: `residuals` says so.
    """

    def __init__(self, site: Site, number: int, measures: Measures, display: str) -> None:
        super().__init__(site, number)
        self.measures, self.display = measures, display
        self.stage = Stage.OPENING
        self.board: Board | None = BOARD  # what must be projected
        self.ground: Ground | None = None
        self.residuals: Residuals | None = None
        self.seen = 0  # markers in the newest picture
        self._look: Look | None = None
        self._shown = inf  # s, since when the board is projected

    @property
    def progress(self) -> tuple[int, int]:
        """Pictures taken, and how many of both boards there will be."""
        taken = min(self._look.frames, FRAMES) if self._look else 0
        return {Stage.VERIFYING: FRAMES, Stage.DONE: 2 * FRAMES}.get(self.stage, 0) + taken, 2 * FRAMES

    @property
    def over(self) -> bool:
        """Whether nothing more will happen."""
        return self.stage in (Stage.DONE, Stage.FAILED)

    def shown(self, board: Board) -> None:
        """This board is projected from now on; to be said with every picture."""
        if board is self.board and self._shown == inf:
            self.site.clear(True)
            self._shown = self.site.clock()

    def look(self, frame: Frame) -> None:
        if self.over or frame.captured < max(self._shown + LIT, self._since + self.site.settle):
            return
        if self._look is None:
            self._look = Look()
            self.stage = Stage.LOOKING if self.stage is Stage.OPENING else self.stage
        self.seen = self._look.add(frame)
        if self._look.ready:
            try:
                self._solve(self._look) if self.stage is Stage.LOOKING else self._verify(self._look)
            except NoGround as trouble:
                self.give_up(said(trouble))

    def idle(self, seconds: float, trouble: str | None) -> None:
        if seconds > BLIND and not self.over:
            self.give_up(trouble or NO_PICTURE)

    def give_up(self, trouble: str) -> None:
        self.trouble, self.stage, self.board = trouble, Stage.FAILED, None

    def _solve(self, look: Look) -> None:
        measures = self.measures
        ground = solve(look.corners(), BOARD, look.size, measures.width, self.display)
        ground = replace(ground, lid=measures.lid)
        self.ground = hung(ground, measures.height) if measures.height else ground
        self._look, self._shown = None, inf
        self.stage, self.board = Stage.VERIFYING, HELD_OUT

    def _verify(self, look: Look) -> None:
        assert self.ground is not None
        self.residuals = verify(self.ground, look.corners(), HELD_OUT)
        if self.residuals.accepted:
            self.ground = verified(self.ground, self.residuals)
        self.stage, self.board, self._look = Stage.DONE, None, None

    def end(self) -> None:
        super().end()
        self.site.clear(False)


class Standing(_Looking):
    """A robot is put on one outline after the other; where the camera sees it says how high the camera hangs.

    At the end `found` is the ground with the camera's place, and `marker_mm` how large the robot's marker seems: far
    from its true size, the mat was measured wrongly.
    """

    def __init__(self, site: Site, number: int, ground: Ground) -> None:
        super().__init__(site, number)
        self.ground = ground
        self.found: Ground | None = None
        self.marker_mm = 0.0
        self.seen: list[tuple[float, float]] = []  # camera px, by place
        self._markers: Markers | None = None
        self._lately: list[Mark] = []
        self._begun = self._shown = inf

    @property
    def place(self) -> int | None:
        """Which outline of PLACES is waited for; None: it is over."""
        return None if self.found or self.trouble else len(self.seen)

    @property
    def steady(self) -> float:
        """For how much of the time it needs the robot has stood still, 0..1."""
        return min(1.0, len(self._lately) / STILL)

    def shown(self, place: int) -> None:
        """The outline of this place is projected."""
        if place == self.place and self._shown == inf:
            self._shown = self._begun = self.site.clock()
            self.site.stand(*PLACES[place])

    def look(self, frame: Frame) -> None:
        if self.place is None or frame.captured < max(self._shown + LIT, self._since + self.site.settle):
            return
        if frame.captured > self._begun + PATIENCE:
            self.give_up(Said("Nobody has put a robot on the outline.", "nobody"))
            return
        self._markers = self._markers or Markers(ROBOT_IDS)
        here = [mark for mark in self._markers.everywhere(frame.image) if self._is_near(mark, self.place)]
        if len(here) != 1 or (self._lately and here[0].number != self._lately[0].number):
            self._lately = []
            return
        self._lately.append(here[0])
        del self._lately[:-STILL]
        if len(self._lately) == STILL and _tremble(self._lately) < UNREST:
            self._note()

    def idle(self, seconds: float, trouble: str | None) -> None:
        if seconds > BLIND and self.place is not None:
            self.give_up(trouble or NO_PICTURE)

    def _is_near(self, mark: Mark, place: int) -> bool:
        away = self.ground.on_mat(mark.corners).mean(axis=0) - np.array(PLACES[place])
        return float(away @ away) < NEAR * NEAR

    def _note(self) -> None:
        """The robot stands: take its place down; after the last, all is known."""
        x, y = np.median([mark.corners.mean(axis=0) for mark in self._lately], axis=0).tolist()
        self.seen.append((x, y))
        last, self._lately, self._shown = self._lately[-1], [], inf
        if len(self.seen) < len(PLACES):
            return
        try:
            found = stood(self.ground, PLACES, self.seen)
        except NoGround as trouble:
            self.give_up(said(trouble))
            return
        self.marker_mm = found.edge_mm(last)
        self.found = found


def shrunk(image: Image) -> Image:
    """A picture as small as it is shown, whatever its shape."""
    from pigaming_app.hardware.markers import opencv

    cv = opencv()
    h, w = image.shape
    scale = min(SMALL[0] / w, SMALL[1] / h)
    size = (max(1, round(w * scale)), max(1, round(h * scale)))
    return np.asarray(cv.resize(image, size, interpolation=cv.INTER_AREA), dtype=np.uint8)


def _tremble(marks: list[Mark]) -> float:
    """By how many px of the camera a marker's middle moved, standard deviation."""
    return float(np.std([mark.corners.mean(axis=0) for mark in marks], axis=0).max())
