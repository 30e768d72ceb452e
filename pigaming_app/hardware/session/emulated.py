"""The emulated arena as a mat: for people its time passes by itself, for tests and pictures it is made up."""

from math import inf
from typing import TYPE_CHECKING

import pygame

from pigaming_app.hardware.session.real import kept_ground, refused, trouble_of
from pigaming_app.sim.world import DT
from pigaming_app.ui.window import Canvas

if TYPE_CHECKING:
    from pigaming_app.hardware.calibration.ground_plane import Ground
    from pigaming_app.hardware.control.rig import Rig
    from pigaming_app.hardware.emulator.arena import EmulatedArena
    from pigaming_app.hardware.emulator.paced import Paced
    from pigaming_app.hardware.emulator.site import EmulatedSite
    from pigaming_app.hardware.radio.link import Link
    from pigaming_app.hardware.signals import Frame

AHEAD = 0.03  # s by which the arena's time may run ahead of the pictures of the window
DIM = 0.015  # s between two pictures that fall on the emulated mat
SLICE = 0.5 * DT  # s of made-up time in which the parts of an emulated mat take turns
DARK = (1080, 1920)  # px of a picture of nothing
FPS = 30.0  # of the emulated camera
WHOLE, QUICK = 3, 30  # every which picture of it is painted whole, in real and in made-up time


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
            from pigaming_app.hardware.vision.markers import NoVision, opencv

            try:
                opencv()
            except NoVision as trouble:
                raise refused(trouble) from trouble
            import numpy as np

            from pigaming_app.hardware.emulator.arena import EmulatedArena
            from pigaming_app.hardware.emulator.camera import Pace
            from pigaming_app.hardware.proof.testbed import MODERATE, calibrated

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
            from pigaming_app.hardware.control.rig import UNMEASURED, Rig
            from pigaming_app.hardware.emulator.site import EmulatedEye
            from pigaming_app.hardware.radio.link import Link
            from pigaming_app.hardware.tracking.tracker import Tracker
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
            from pigaming_app.ui.draw.pixels import pixels_of

            picture = self.canvas.screen if self.canvas and not self.canvas.corners else window  # bars are no picture
            Projector(self._arena).see(pixels_of(picture))

    def _ground(self) -> "Ground":
        """The calibration of the wizard, or else the one that was made when the arena was."""
        from pigaming_app.hardware.calibration.ground_plane import NoGround

        try:
            return kept_ground("calibration-emulated.toml", self.canvas.projection if self.canvas else "")
        except NoGround:
            assert self._made is not None
            return self._made
