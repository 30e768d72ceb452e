"""The mat: everything outside the computer that real robots need, real or emulated, and its parts while they are used.

`open` starts camera, tracker and radio for a match or a page, `close` stops the robots and ends every thread. What is
wrong is one sentence, `trouble`; the arcade plays on with simulated robots.
"""

import logging
from math import inf
from typing import TYPE_CHECKING, Protocol

import pygame

from pigaming_app.scenes.canvas import Canvas
from pigaming_app.settings import Settings, folders
from pigaming_app.sim.world import DT

if TYPE_CHECKING:
    from pigaming_app.hardware.assembly import Wiring
    from pigaming_app.hardware.emulator.arena import EmulatedArena
    from pigaming_app.hardware.emulator.paced import Paced
    from pigaming_app.hardware.emulator.site import EmulatedSite
    from pigaming_app.hardware.ground import Ground
    from pigaming_app.hardware.link import Link
    from pigaming_app.hardware.rig import Rig, Talks
    from pigaming_app.hardware.signals import Frame

LIGHT_AFTER = 0.035  # s from a picture being painted until its light lands on the mat
AHEAD = 0.03  # s by which the arena's time may run ahead of the pictures of the window
DIM = 0.015  # s between two pictures that fall on the emulated mat
SLICE = 0.5 * DT  # s of made-up time in which the parts of an emulated mat take turns
DARK = (1080, 1920)  # px of a picture of nothing
FPS = 30.0  # of the emulated camera
WHOLE, QUICK = 3, 30  # every which picture of it is painted whole, in real and in made-up time

log = logging.getLogger("pigaming")


class NoMat(Exception):
    """The robots cannot be used; its argument is one sentence, mostly a `said.Said`."""


class Mat(Protocol):
    """A mat with robots, or what stands in for it."""

    emulated: bool

    @property
    def trouble(self) -> str | None:
        """What is wrong with camera or radio, in one sentence; None: nothing, or they are not in use."""

    def open(self) -> "Rig":
        """Start, or go on with, what real robots need. Raises NoMat."""

    def listen(self) -> "Link | None":
        """The radio alone, where `open` raises; None where there is none either."""

    def close(self) -> None:
        """Stop the robots and end all threads. May be called again."""

    def end(self) -> None:
        """Close for good."""

    def advance(self, seconds: float) -> float:
        """Let time pass, where it does not pass by itself; how much has passed."""


class RealMat:
    """The camera and the radio of the settings."""

    emulated = False

    def __init__(self, settings: Settings, canvas: Canvas) -> None:
        self.settings, self.canvas = settings, canvas
        self._rig: Rig | None = None
        self._link: Link | None = None

    @property
    def trouble(self) -> str | None:
        """What is wrong with camera or radio."""
        if self._rig is not None:
            return trouble_of(self._rig)
        return told(self._link) if self._link else None

    def open(self) -> "Rig":
        """Start camera, tracker and radio in their threads. Raises NoMat."""
        if self._rig is None:
            from pigaming_app.hardware.assembly import connect, measured
            from pigaming_app.hardware.ground import NoGround
            from pigaming_app.hardware.markers import NoVision
            from pigaming_app.sim.drivetrain import DrivetrainError

            try:
                ground = kept_ground("calibration.toml", self.canvas.projection)
                self._rig = connect(self._wiring, ground, measured(folders().config / "robots.toml"))
            except (NoGround, NoVision, DrivetrainError, ImportError) as trouble:
                raise refused(trouble) from trouble
            self._rig.channels = tuple(one - 1 for one in self.settings.radios)
        return self._rig

    def listen(self) -> "Link | None":
        """The radio of the settings."""
        if self._link is None:
            from pigaming_app.hardware.assembly import linked

            self._link = linked(self._wiring).start()
        return self._link

    def close(self) -> None:
        """Stop the robots and end all threads."""
        rig, self._rig, link, self._link = self._rig, None, self._link, None
        if rig is not None:
            rig.close()
        if link is not None:
            link.close()

    def end(self) -> None:
        """Close for good."""
        self.close()

    def advance(self, seconds: float) -> float:
        """Real time passes by itself."""
        return seconds

    @property
    def _wiring(self) -> "Wiring":
        from pigaming_app.hardware.assembly import Wiring

        chosen = self.settings
        return Wiring(chosen.camera, chosen.port, chosen.baud, chosen.radio)


class EmulatedMat:
    """The emulated arena. `live`: its time passes like the real one; else in `advance` alone."""

    emulated = True

    def __init__(self, canvas: Canvas | None = None, seed: int = 1, live: bool = True) -> None:
        self.canvas, self.seed, self.live = canvas, seed, live
        self._arena: EmulatedArena | None = None
        self._made: Ground | None = None  # found without showing it
        self._rig: Rig | None = None
        self._time: Paced | None = None
        self._lit = self._now = -1.0  # s of the arena's clock: when it was last lit, and asked for the time
        if canvas is not None:
            canvas.watchers.append(self.see)

    @property
    def trouble(self) -> str | None:
        """What is wrong with the radio; the emulated camera never tells."""
        return trouble_of(self._rig) if self._rig else None

    @property
    def arena(self) -> "EmulatedArena":
        """The arena, made and calibrated when it is first needed; then its time passes. Raises NoMat without OpenCV."""
        if self._arena is None:
            from pigaming_app.hardware.markers import NoVision, opencv

            try:
                opencv()
            except NoVision as trouble:
                raise refused(trouble) from trouble
            import numpy as np

            from pigaming_app.hardware.emulator.arena import EmulatedArena
            from pigaming_app.hardware.emulator.camera import Pace
            from pigaming_app.hardware.testbed import MODERATE, calibrated

            arena = EmulatedArena(self.seed, Pace(FPS), MODERATE, refresh=WHOLE if self.live else QUICK)
            self._made = calibrated(arena)
            arena.project(np.zeros(DARK, np.uint8))  # until the window shows something
            self._arena = arena
        if self.live and self._time is None:
            from pigaming_app.hardware.emulator.paced import Paced

            self._time = Paced(self._arena).start()
        return self._arena

    @property
    def newest(self) -> "Frame | None":
        """The newest picture that the camera gave out."""
        return self._arena.camera.last if self._arena else None

    @property
    def site(self) -> "EmulatedSite":
        """The arena for the calibration: its robots are off the mat until they are asked for."""
        from pigaming_app.hardware.emulator.site import EmulatedSite

        return EmulatedSite(self.seed, self.live, self.arena)

    def open(self) -> "Rig":
        """Start the arena, its camera, a tracker and a link. Raises NoMat."""
        if self._rig is None:
            from pigaming_app.hardware.emulator.site import EmulatedEye
            from pigaming_app.hardware.link import Link
            from pigaming_app.hardware.rig import UNMEASURED, Rig
            from pigaming_app.hardware.tracker import Tracker
            from pigaming_app.sim.world import ROBOTS

            arena, trains = self.arena, [UNMEASURED] * ROBOTS
            arena.cleared = False
            self._now = arena.clock()
            link = Link(arena.radio.open, arena.clock, name="EMU0")
            tracker = Tracker(self._ground(), arena.clock, trains)
            self._rig = Rig(EmulatedEye(arena), tracker, link, arena.clock, trains)
            if self._time is not None:
                self._rig.start()
                self._time.watched, self._time.limit = True, self._now + AHEAD
        return self._rig

    def listen(self) -> "Link | None":
        """There is no radio where there is no arena."""
        return None

    def close(self) -> None:
        """Stop the robots and let go of camera and radio; the arena's time goes on."""
        rig, self._rig = self._rig, None
        if rig is not None:
            rig.close()
        if self._time is not None:
            self._time.watched, self._time.limit = False, inf

    def end(self) -> None:
        """Close, and stop the arena's time too."""
        self.close()
        passing, self._time = self._time, None
        if passing is not None:
            passing.close()

    def advance(self, seconds: float) -> float:
        """Let time pass in the arena; how much has passed: less than asked for where this computer is too slow."""
        if self._rig is None:
            return seconds
        if self._time is None:
            for _ in range(max(1, round(seconds / SLICE))):
                self._rig.pump()
                self.arena.advance(SLICE)
            return seconds
        before, self._now = self._now, self.arena.clock()
        self._time.limit = self._now + seconds + AHEAD
        return self._now - before

    def see(self, window: pygame.Surface) -> None:
        """What the window shows falls on the mat, once there is one."""
        if self._arena is not None and self._arena.clock() - self._lit > DIM:
            self._lit = self._arena.clock()
            from pigaming_app.hardware.emulator.projector import Projector
            from pigaming_app.scenes.pixels import pixels_of

            picture = self.canvas.screen if self.canvas and not self.canvas.corners else window  # bars are no picture
            Projector(self._arena).see(pixels_of(picture))

    def _ground(self) -> "Ground":
        """The calibration of the wizard, or else the one that was made when the arena was."""
        from pigaming_app.hardware.ground import NoGround

        try:
            return kept_ground("calibration-emulated.toml", self.canvas.projection if self.canvas else "")
        except NoGround:
            assert self._made is not None
            return self._made


def kept_ground(file: str, projection: str) -> "Ground":
    """The calibration kept for this projection. Raises NoGround."""
    from pigaming_app.hardware.assembly import ground_of
    from pigaming_app.hardware.ground import read, written

    ground = ground_of(folders().config / file)
    return read(written(ground), projection, ground.lens.size)


def trouble_of(rig: "Rig") -> str | None:
    """What a camera or a link says is wrong with it."""
    return getattr(rig.eye, "trouble", None) or told(rig.link)


def told(link: "Talks") -> str | None:
    """What a link says is wrong with it, with a key for other languages."""
    from pigaming_app.hardware.said import Said

    trouble = link.trouble
    if trouble is None:
        return None
    return Said(str(trouble), f"radio_{trouble.reason}", port=trouble.port, detail=trouble.detail)


def refused(trouble: BaseException) -> NoMat:
    """The same trouble as NoMat; the log has it too."""
    from pigaming_app.hardware.said import said

    sentence = said(trouble)
    log.warning("%s", sentence)
    return NoMat(sentence)
