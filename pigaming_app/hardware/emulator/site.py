"""The emulated arena as a calibration site, with or without a window.

Live, its time is real time; stepped, it passes only in `advance`, and runs are reproducible.
"""

import time
from math import inf

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.site import CalibrationSite, Measurements
from pigaming_app.hardware.emulator.arena import ARENA_AT, EmulatedArena
from pigaming_app.hardware.emulator.camera import CameraDriver, CameraTraits, FrameTiming
from pigaming_app.hardware.emulator.realtime import RealtimeArena
from pigaming_app.hardware.signals import CameraFrame, ExposureKept, ExposureState
from pigaming_app.hardware.vision.discovery import CameraId, CameraInfo
from pigaming_app.hardware.vision.exposure import ExposureControl
from pigaming_app.hardware.vision.markers import opencv

RULER = (1.5, 8.0)  # mm, errors of the measured width of the mat and height of the camera
ASIDE = ((60.0, 60.0), (1540.0, 60.0), (1540.0, 840.0), (60.0, 840.0))  # arena px, parking positions
LOCKED, SETTLED = 0.2, 0.3  # s after opening: the exposure is locked, pictures are usable
HEADING = -1.2  # rad, of a robot put down by hand


class EmulatedCameraSource:
    """The camera over the emulated mat, its exposure controlled by the reader's own thread.

    It can be closed and opened repeatedly. Real cameras do the same in their capture thread. Raises OpenCVMissing.
    """

    fault: None = None

    def __init__(self, arena: EmulatedArena, settle: float, fresh: bool, kept: ExposureKept | None) -> None:
        self.camera = arena.camera
        driver = CameraDriver(arena.camera)
        self._control = ExposureControl(opencv(), driver, arena.clock(), settle, fresh, kept)

    @property
    def exposure(self) -> ExposureState:
        return self._control.state

    def newest(self) -> CameraFrame | None:
        frame = self.camera.newest()
        if frame is not None:
            self._control.observe(frame.image, frame.captured)
        return frame

    def close(self) -> None:
        """No effect: the emulated camera stays."""


class EmulatedCalibrationSite(CalibrationSite):
    """An emulated arena whose robots move to the requested places by themselves."""

    name = "emulated"
    settle = SETTLED

    def __init__(
        self,
        seed: int = 1,
        live: bool = False,
        arena: EmulatedArena | None = None,
        traits: CameraTraits | None = None,
    ) -> None:
        """`arena`: an existing one; if `live`, its owner advances its time. `traits`: of the camera of a new one."""
        self.stepped = not live
        begin = time.monotonic() if live else 0.0
        self.arena = arena or EmulatedArena(seed, FrameTiming(30.0), begin=begin, traits=traits)
        self.clock = self.arena.clock
        self._live = RealtimeArena(self.arena).start() if live and arena is None else None
        self._refresh = self.arena.camera.painter.refresh
        self.measures = _by_ruler(self.arena)

    def cameras(self) -> list[CameraInfo]:
        return [CameraInfo(0, "emulated")]

    def open(
        self, number: CameraId, locks: bool = True, fresh: bool = False, kept: ExposureKept | None = None
    ) -> EmulatedCameraSource:
        return EmulatedCameraSource(self.arena, LOCKED if locks else inf, fresh, kept)

    def advance(self, seconds: float) -> None:
        if self.stepped:
            self.arena.advance(seconds)

    def project(self, pixels: NDArray[np.uint8]) -> None:
        """Project the pixels of the window."""
        self.arena.project_window(pixels)

    def clear(self, off: bool) -> None:
        """Take robots and things off the mat, or put the robots back. A cleared mat is rendered completely in every
        picture.
        """
        self._remove_things()
        self.arena.cleared = off
        self.arena.camera.painter.refresh = 1 if off else self._refresh

    def stand(self, x: float, y: float) -> None:
        """Place the first robot there; the others are parked, things are taken away."""
        self._remove_things()
        for robot, (left, top) in enumerate(ASIDE):
            self.arena.place(robot, (x, y, HEADING) if robot == 0 else (left, top, 0.0))

    def _remove_things(self) -> None:
        if self.arena.things:
            self.arena.furnish(())

    def close(self) -> None:
        if self._live is not None:
            self._live.close()


def _by_ruler(arena: EmulatedArena) -> Measurements:
    """Ruler measurements with typical errors."""
    rim = arena.optics.mat(np.array([[0.0, 450.0], [1600.0, 450.0]]) + ARENA_AT)
    width, height = float(np.hypot(*(rim[1] - rim[0]))), arena.optics.lens.eye[2]
    return Measurements(round(width + RULER[0]), round(height + RULER[1]))
