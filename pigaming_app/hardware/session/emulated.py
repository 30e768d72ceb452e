"""Emulated robots: a calibrated emulated arena, in real time for people, in simulated time for tests and jobs."""

from collections.abc import Callable
from math import inf
from typing import TYPE_CHECKING, Any

from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.session.robot_session import RobotsUnavailable, new_rig, trouble_of
from pigaming_app.sim.world import DT, HZ

if TYPE_CHECKING:
    from pigaming_app.hardware.calibration.ground_plane import GroundPlane
    from pigaming_app.hardware.control.rig import Rig
    from pigaming_app.hardware.emulator.arena import EmulatedArena
    from pigaming_app.hardware.emulator.camera import FrameTiming
    from pigaming_app.hardware.emulator.paced import PacedArena
    from pigaming_app.hardware.emulator.radio import RadioChannel
    from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite
    from pigaming_app.hardware.radio.link import Link
    from pigaming_app.hardware.session.lighting import Lighting
    from pigaming_app.hardware.signals import CameraFrame
    from pigaming_app.hardware.tracking.tracker import Tracker

AHEAD = 0.03  # s by which the arena's time may run ahead of the pictures of the window
DIM = 0.015  # s between two pictures that fall on the emulated mat
SLICE = 0.5 * DT  # s of simulated time in which arena and rig take turns
DARK = (1080, 1920)  # px of a picture of nothing
FPS = 30.0  # of the emulated camera
WHOLE, QUICK = 3, 30  # every which picture of it is painted whole, in real and in simulated time
SEARCH = 10.0  # s in which all robots must be found


class EmulatedSession:
    """The emulated arena of a seed. `live`: its time passes like the real one; else in `advance` alone.

    `projection` is `Canvas.projection`, and chooses the calibration that the wizard has kept; None: the one that is
    made with the arena, or `ground`. `lighting` lights the mat where there is no window to `show`. `pace`, `air` and
    `unrest` (share of an exposure step) are how well the arena delivers.
    """

    emulated = True

    def __init__(
        self,
        seed: int = 1,
        live: bool = True,
        projection: Callable[[], str | None] = lambda: None,
        lighting: "Lighting | None" = None,
        pace: "FrameTiming | None" = None,
        air: "RadioChannel | None" = None,
        unrest: float = 0.0,
        ground: "GroundPlane | None" = None,
        tracker: "type[Tracker] | None" = None,
    ) -> None:
        self.seed, self.live, self.projection, self.lighting = seed, live, projection, lighting
        self.mm = 0.0
        self._pace, self._air, self._unrest, self._tracker = pace, air, unrest, tracker
        self._arena: EmulatedArena | None = None
        self._made = ground
        self._rig: Rig | None = None
        self._time: PacedArena | None = None
        self._lit = self._now = -1.0  # s of the arena's clock: when it was last lit, and asked for the time

    @property
    def trouble(self) -> OperatorMessage | None:
        return trouble_of(self._rig) if self._rig else None

    @property
    def arena(self) -> "EmulatedArena":
        """The arena, made and calibrated when it is first needed; then its time passes. Raises RobotsUnavailable."""
        if self._arena is None:
            from pigaming_app.hardware.vision.markers import OpenCVMissing, opencv

            try:
                opencv()
            except OpenCVMissing as trouble:
                raise RobotsUnavailable(trouble.message) from trouble
            self._arena = self._new_arena()
        if self.live and self._time is None:
            from pigaming_app.hardware.emulator.paced import PacedArena

            self._time = PacedArena(self._arena).start()
        return self._arena

    @property
    def ground(self) -> "GroundPlane":
        """The calibration of the wizard, or else the one that was made with the arena. Raises RobotsUnavailable."""
        from pigaming_app.hardware.calibration.ground_plane import CalibrationError
        from pigaming_app.hardware.session import store

        _, projection = self.arena, self.projection()
        assert self._made is not None
        if projection is None:
            return self._made
        try:
            return store.load(store.calibration_file("emulated"), projection)
        except CalibrationError:
            return self._made

    @property
    def newest(self) -> "CameraFrame | None":
        """The newest picture that the camera gave out."""
        return self._arena.camera.last if self._arena else None

    @property
    def site(self) -> "EmulatedCalibrationSite":
        from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite

        return EmulatedCalibrationSite(self.seed, self.live, self.arena)

    def open(self) -> "Rig":
        if self._rig is None:
            from pigaming_app.hardware.control.rig import UNMEASURED
            from pigaming_app.hardware.emulator.site import EmulatedCameraSource
            from pigaming_app.hardware.radio.link import Link
            from pigaming_app.sim.world import ROBOTS

            arena, ground = self.arena, self.ground
            arena.cleared = False
            self._now, self.mm = arena.clock(), ground.mm
            link = Link(arena.radio.open, arena.clock, name="EMU0")
            self._rig = new_rig(
                EmulatedCameraSource(arena), link, ground, arena.clock, [UNMEASURED] * ROBOTS, self._tracker
            )
            if self._time is not None:
                self._rig.start()
                self._time.watched, self._time.limit = True, self._now + AHEAD
        return self._rig

    def find(self) -> None:
        """Let the tracker find the robots on a dark floor, then show a busy one.

        Needs `lighting`. Raises RuntimeError if that takes more than SEARCH s.
        """
        assert self.lighting is not None
        rig = self.open()
        for _ in range(round(SEARCH * HZ)):
            self.tick()
            if all(seen.age < 0.2 for seen in rig.sense()):
                self.lighting.show(busy=True)
                return
        raise RuntimeError("the tracker does not find all robots")

    def listen(self) -> "Link | None":
        """None: where there is no arena, there is no radio."""
        return None

    def tick(self) -> None:
        self.advance(DT)

    def advance(self, seconds: float) -> float:
        """Let time pass in the arena; less passes than asked for where this computer is too slow."""
        if self._rig is None:
            return seconds
        if self._time is None:
            self._light(self._rig)
            for _ in range(max(1, round(seconds / SLICE))):
                self.arena.advance(SLICE)
                self._rig.pump()
            return seconds
        before, self._now = self._now, self.arena.clock()
        self._time.limit = self._now + seconds + AHEAD
        return self._now - before

    def show(self, pixels: Callable[[], Any]) -> None:
        """The window's picture falls on the mat, once there is one: (height, width, 4), blue first.

        `pixels` is called only when the projector is due.
        """
        if self._arena is not None and self._arena.clock() - self._lit > DIM:
            self._lit = self._arena.clock()
            from pigaming_app.hardware.emulator.projector import Projector

            Projector(self._arena).see(pixels())

    def close(self) -> None:
        """Stop the robots and let go of camera and radio; the arena's time goes on."""
        rig, self._rig = self._rig, None
        if rig is not None:
            rig.close()
        if self._time is not None:
            self._time.watched, self._time.limit = False, inf

    def end(self) -> None:
        self.close()
        passing, self._time = self._time, None
        if passing is not None:
            passing.close()

    def _new_arena(self) -> "EmulatedArena":
        import numpy as np

        from pigaming_app.hardware.emulator.arena import EmulatedArena
        from pigaming_app.hardware.emulator.camera import FrameTiming
        from pigaming_app.hardware.emulator.radio import MODERATE

        refresh = WHOLE if self.live else QUICK
        arena = EmulatedArena(self.seed, self._pace or FrameTiming(FPS), self._air or MODERATE, refresh, self._unrest)
        self._made = self._made or calibrated(arena)
        arena.project(np.zeros(DARK, np.uint8))  # until the window shows something
        return arena

    def _light(self, rig: "Rig") -> None:
        """Project the floor, and a disc where each robot will be when the light lands."""
        if self.lighting is not None:
            from pigaming_app.hardware.emulator.arena import SHOWS_AFTER

            self.arena.project(self.lighting.picture(rig.sense(SHOWS_AFTER)))


def calibrated(arena: "EmulatedArena") -> "GroundPlane":
    """The calibration of an arena, found and verified as the wizard does it. Raises CalibrationError."""
    from pigaming_app.hardware.calibration.boards import BOARD, HELD_OUT
    from pigaming_app.hardware.calibration.ground_plane import CalibrationError
    from pigaming_app.hardware.calibration.procedure import Calibration
    from pigaming_app.hardware.calibration.solver import verified
    from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite

    site = EmulatedCalibrationSite(arena=arena)
    work = Calibration(site, 0, site.measures, "emulated")
    pictures = {board: board.picture() for board in (BOARD, HELD_OUT)}
    while not work.over:
        if work.board is not None:
            arena.project(pictures[work.board])
            work.shown(work.board)
        site.advance(DT)
        work.pump()
    work.close()
    if work.ground is None or work.residuals is None:
        assert work.trouble is not None
        raise CalibrationError(work.trouble)
    return verified(work.ground, work.residuals)
