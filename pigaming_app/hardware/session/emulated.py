"""The robot session of the emulator: a calibrated emulated arena, in real time for play, in simulated time for jobs."""

from collections.abc import Callable
from functools import partial
from math import inf
from typing import Any, NamedTuple

import numpy as np

from pigaming_app.hardware.calibration.boards import BOARD, HELD_OUT
from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane
from pigaming_app.hardware.calibration.procedure import Calibration
from pigaming_app.hardware.calibration.solver import with_verification
from pigaming_app.hardware.control.rig import Rig, unmeasured
from pigaming_app.hardware.drivers.driver import LinkSite, RobotDriver
from pigaming_app.hardware.drivers.ours import OURS, UDP
from pigaming_app.hardware.emulator.arena import SHOWS_AFTER, STARTS, EmulatedArena
from pigaming_app.hardware.emulator.camera import FrameTiming
from pigaming_app.hardware.emulator.radio import MODERATE, EmulatedRadio, RadioChannel
from pigaming_app.hardware.emulator.realtime import PacedArena
from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite
from pigaming_app.hardware.emulator.things.prism import Prism
from pigaming_app.hardware.emulator.things.random_scene import some_things
from pigaming_app.hardware.emulator.wifi.air import LOOPBACK, WifiChannel
from pigaming_app.hardware.emulator.wifi.boards import NoMicroPython
from pigaming_app.hardware.emulator.wifi.radio import WifiRadio
from pigaming_app.hardware.emulator.xbee import EmulatedCarrier
from pigaming_app.hardware.radio.wifi import WifiNetwork
from pigaming_app.hardware.radio.xbee_setup import Carrier
from pigaming_app.hardware.robot_kinds import DEFAULT, RobotKind
from pigaming_app.hardware.session import store
from pigaming_app.hardware.session.lighting import Lighting
from pigaming_app.hardware.session.robot_session import RobotSession, RobotsUnavailable, new_rig
from pigaming_app.hardware.signals import CameraFrame
from pigaming_app.hardware.tracking.tracker import Tracker
from pigaming_app.hardware.vision.markers import OpenCVMissing, opencv
from pigaming_app.sim.world import DT, HZ, ROBOTS
from pigaming_app.storage.messages import OperatorMessage

AHEAD = 0.03  # s by which the arena's clock may lead the window's frames
DIM = 0.015  # s between two images projected on the emulated mat
SLICE = 0.5 * DT  # s of simulated time after which arena and rig alternate
DARK = (1080, 1920)  # px, size of a black image
FPS = 30.0  # frames/s of the emulated camera
WHOLE, QUICK = 3, 30  # interval of complete renders, frames: in real and in simulated time
EMULATED_KEY = bytes(range(16))  # of the emulated Wi-Fi robots
FURNITURE = 5  # things put on an empty mat, to be scanned
SEARCH = 10.0  # timeout for finding all robots, s


class EmulatedFleet(NamedTuple):
    """Four emulated robots of one driver and kind. `radio`: that of robots with programs of their own; None: XBees."""

    driver: RobotDriver = OURS["api2"]
    kind: RobotKind = DEFAULT
    radio: Callable[[EmulatedArena], EmulatedRadio] | None = None


XBEES = EmulatedFleet()


class EmulatedSession(RobotSession):
    """The emulated arena of a seed. `live`: it runs in real time; else its time passes only in `advance`.

    `projection` is `Canvas.projection` and selects the calibration saved by the wizard; if it returns None, the
    session uses `ground`, or else a calibration made with the arena. `lighting` lights the mat where no window calls
    `show`. `timing`, `channel` and `exposure_jitter` (size of exposure steps, as a share) set the quality of
    camera and radio. With `wifi` the robots are boards on such a network and run their own program, else they are
    the `fleet`. `things`: number of random real things on the mat, at most 8; the wizard takes them away.
    """

    emulated = True

    def __init__(
        self,
        seed: int = 1,
        live: bool = True,
        projection: Callable[[], str | None] = lambda: None,
        lighting: Lighting | None = None,
        timing: FrameTiming | None = None,
        channel: RadioChannel | None = None,
        exposure_jitter: float = 0.0,
        ground: GroundPlane | None = None,
        tracker: type[Tracker] | None = None,
        wifi: WifiChannel | None = None,
        things: int = 0,
        fleet: EmulatedFleet = XBEES,
    ) -> None:
        self.seed, self.live, self.projection, self.lighting = seed, live, projection, lighting
        self._wifi, self._fleet = wifi, EmulatedFleet(OURS[UDP], OURS[UDP].kind) if wifi else fleet
        self._timing, self._channel, self._exposure_jitter, self._tracker = timing, channel, exposure_jitter, tracker
        self._refresh: int | None = None  # usual interval of complete renders, while every one is complete
        self._count = things
        self._things: list[Prism] = []  # to stand on the mat
        self._arena: EmulatedArena | None = None
        self._made = ground
        self._time: PacedArena | None = None
        self._lit = self._now = -1.0  # s of the arena's clock: last projection, and last `advance`

    @property
    def arena(self) -> EmulatedArena:
        """The arena, created and calibrated on first use; a live one then runs. Raises RobotsUnavailable."""
        if self._arena is None:
            try:
                opencv()
            except OpenCVMissing as error:
                raise RobotsUnavailable(error.message) from error
            self._arena = self._new_arena()
        if self.live and self._time is None:
            self._time = PacedArena(self._arena).start()
        return self._arena

    @property
    def arena_id(self) -> int:
        return self.arena.arena_id

    @property
    def ground(self) -> GroundPlane:
        """The calibration saved by the wizard, or else the one made with the arena. Raises RobotsUnavailable."""
        _, projection = self.arena, self.projection()
        assert self._made is not None
        if projection is None:
            return self._made
        try:
            return store.load(store.calibration_file("emulated"), projection)
        except CalibrationError:
            return self._made

    @property
    def newest(self) -> CameraFrame | None:
        """The newest frame of the emulated camera."""
        return self._arena.camera.last if self._arena else None

    @property
    def site(self) -> EmulatedCalibrationSite:
        return EmulatedCalibrationSite(self.seed, self.live, self.arena)

    def open(self) -> Rig:
        if self._rig is None:
            arena, ground = self.arena, self.ground
            arena.cleared = False
            if self._things and not arena.things:
                arena.furnish(self._things)
            self._now, self.mm, self.quality, self.printed = arena.clock(), ground.mm, ground.quality, ground.printed
            driver, kind = self._fleet.driver, self._fleet.kind
            network = partial(self._wifi_network, self._wifi) if self._wifi else None
            site = LinkSite(arena.arena_id, arena.clock, "EMU0", open_port=lambda _: arena.radio.open, network=network)
            link = driver.connect(site)
            camera = EmulatedCalibrationSite(self.seed, self.live, arena).open(0, kept=ground.quality.kept)
            trains = [unmeasured(kind, ground.mm, driver.delay)] * ROBOTS
            self._rig = new_rig(camera, link, ground, arena.clock, trains, self._tracker, usual=kind)
            if self._time is not None:
                self._rig.start()
                self._time.watched, self._time.limit = True, self._now + AHEAD
        return self._rig

    def find(self) -> None:
        """Wait until the tracker has found all robots on a dark floor, then show a busy one.

        Needs `lighting`. Raises RuntimeError after SEARCH s.
        """
        assert self.lighting is not None
        rig = self.open()
        for _ in range(round(SEARCH * HZ)):
            self.tick()
            if all(seen.age < 0.2 for seen in rig.sense()):
                self.lighting.show(busy=True)
                return
        raise RuntimeError("the tracker does not find all robots")

    def carrier(self, number: int) -> Carrier:
        radio = self.arena.radio
        module = radio.modules[number - 1] if number else radio.module
        return Carrier(EmulatedCarrier(module, self.arena.clock).open, self.arena.clock, "EMU0")

    def tick(self) -> None:
        self.advance(DT)

    def advance(self, seconds: float) -> float:
        """Advance the arena by `seconds`; returns the time that passed, less if this computer is too slow."""
        if self._rig is None:
            return seconds
        self._render(self._rig)
        if self._time is None:
            self._light(self._rig)
            for _ in range(max(1, round(seconds / SLICE))):
                self.arena.advance(SLICE)
                self._rig.pump()
            return seconds
        before, self._now = self._now, self.arena.clock()
        self._time.limit = self._now + seconds + AHEAD
        return self._now - before

    @property
    def empty(self) -> bool:
        return not self.arena.things

    def furnish(self) -> None:
        if not self.arena.things:
            self._things = some_things(self.seed, FURNITURE, self.arena.optics, self.arena.poses())
            self.arena.furnish(self._things)

    def show(self, pixels: Callable[[], Any]) -> None:
        """Project the window on the mat, if there is one. `pixels` returns a BGRA image, (height, width, 4).

        It is called only when the projector is due.
        """
        if self._arena is not None and self._arena.clock() - self._lit > DIM:
            self._lit = self._arena.clock()
            self._arena.project_window(pixels())

    def close(self) -> None:
        """Stop the robots and release camera and radio; the arena keeps running."""
        super().close()
        if self._time is not None:
            self._time.watched, self._time.limit = False, inf

    def end(self) -> None:
        self.close()
        passing, self._time = self._time, None
        if passing is not None:
            passing.close()
        if self._arena is not None:
            self._arena.radio.end()

    def _bare_arena(self, **about: Any) -> EmulatedArena:
        """A new arena; `about`: see EmulatedArena."""
        return EmulatedArena(self.seed, **about)

    def _calibrated(self, arena: EmulatedArena) -> GroundPlane:
        return calibrated(arena)

    def _new_arena(self) -> EmulatedArena:
        arena = self._bare_arena(
            timing=self._timing or FrameTiming(FPS),
            channel=self._channel or MODERATE,
            refresh=WHOLE if self.live else QUICK,
            exposure_jitter=self._exposure_jitter,
            wheels=(self._fleet.kind.wheel_mm, self._fleet.kind.base_mm),
        )
        if self._fleet.radio is not None:
            arena.radio = self._fleet.radio(arena)
        self._made = self._made or self._calibrated(arena)
        if self._count:
            self._things = some_things(self.seed, self._count, arena.optics, STARTS)
            arena.furnish(self._things)
        arena.project(np.zeros(DARK, np.uint8))  # until the window renders
        return arena

    def _wifi_network(self, channel: WifiChannel) -> WifiNetwork:
        """The network of boards of their own. Raises RobotsUnavailable."""
        if self.network is None:
            network = WifiNetwork(self.arena.arena_id, EMULATED_KEY, self.arena.clock, 0, LOOPBACK).open()
            try:
                self.arena.radio = WifiRadio(self.arena, channel, network.bound, network.arena, network.key)
            except NoMicroPython as error:
                raise RobotsUnavailable(OperatorMessage("micropython", detail=error)) from error
            self.network = network
        return self.network

    def _render(self, rig: Rig) -> None:
        """Render complete pictures while somebody looks at more than the robots."""
        painter = self.arena.camera.painter
        if rig.viewers and self._refresh is None:
            self._refresh, painter.refresh = painter.refresh, 1
        elif not rig.viewers and self._refresh is not None:
            painter.refresh, self._refresh = self._refresh, None

    def _light(self, rig: Rig) -> None:
        """Project the floor, and a disc at each robot's predicted position when the light lands."""
        if self.lighting is not None:
            self.arena.project(self.lighting.picture(rig.sense(SHOWS_AFTER)))


def calibrated(arena: EmulatedArena, site: EmulatedCalibrationSite | None = None) -> GroundPlane:
    """Calibrate an arena and verify the result, by the wizard's procedure. Raises CalibrationError."""
    site = site or EmulatedCalibrationSite(arena=arena)
    work = Calibration(site, 0, site.measures, "emulated")
    pictures = {board: board.picture() for board in (BOARD, HELD_OUT)}
    while not work.finished:
        if work.board is not None:
            arena.project(pictures[work.board])
            work.mark_shown(work.board)
        site.advance(DT)
        work.pump()
    work.close()
    if work.ground is None or work.residuals is None:
        assert work.fault is not None
        raise CalibrationError(work.fault)
    return with_verification(work.ground, work.residuals)
