"""The whole robot loop on the emulated arena, to be measured against ground truth.

The arena has moderate noise, a calibration as an operator makes it, and the light of a game. `trials` and `emergencies`
measure on it.
"""

from time import thread_time

import numpy as np

from pigaming_app.hardware.calibration.ground_plane import GroundPlane
from pigaming_app.hardware.emulator.camera import FrameTiming
from pigaming_app.hardware.emulator.radio import MODERATE, RadioChannel
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.hardware.session.lighting import Lighting
from pigaming_app.hardware.signals import CameraFrame, Fix
from pigaming_app.hardware.tracking.tracker import Tracker
from pigaming_app.sim.world import ROBOTS

UNREST = 0.15  # size of the exposure steps
DELAY = 0.060  # s that pictures are late; with tick, line and air that is 80 ms of dead time


class TimedTracker(Tracker):
    """A tracker of which it is noted how long it takes and what it finds."""

    seconds = 0.0
    pictures = complete = 0

    def see(self, frame: CameraFrame) -> list[Fix]:
        """Correct the robots by a picture; the fixes that were believed."""
        began = thread_time()
        fixes = super().see(frame)
        self.seconds += thread_time() - began
        self.pictures += 1
        self.complete += len({fix.robot for fix in fixes}) == ROBOTS
        return fixes


class Testbed:
    """A calibrated arena with a rig on it; `tick` lets 1/50 s pass. A `ground` that is known need not be found."""

    def __init__(
        self, seed: int, fps: float, drops: float = 0.0, air: RadioChannel = MODERATE, ground: GroundPlane | None = None
    ) -> None:
        self.lighting = Lighting(seed)
        self.session = EmulatedSession(
            seed,
            False,
            lighting=self.lighting,
            pace=FrameTiming(fps, DELAY, drops=drops),
            air=air,
            unrest=UNREST,
            ground=ground,
            tracker=TimedTracker,
        )
        self.rig = self.session.open()
        self.arena, self.ground = self.session.arena, self.session.ground
        assert isinstance(self.rig.tracker, TimedTracker)
        self.tracker, self.link = self.rig.tracker, self.rig.link

    def count(self) -> None:
        """Count pictures anew."""
        self.tracker.seconds, self.tracker.pictures, self.tracker.complete = 0.0, 0, 0

    def tick(self) -> None:
        """Let 1/50 s pass: lit floor, arena and rig."""
        self.session.tick()

    def misses(self) -> list[tuple[float, float]]:
        """The error of each robot's predicted pose, in mm, and of its heading, in rad."""
        pairs = zip(self.rig.sense(), self.arena.poses(), strict=True)
        mm = self.ground.mm
        return [
            (mm * float(np.hypot(seen.x - x, seen.y - y)), abs(float(np.angle(np.exp(1j * (seen.heading - heading))))))
            for seen, (x, y, heading) in pairs
        ]


def one_core() -> None:
    """Let OpenCV use no more than one core, as is measured."""
    import cv2

    cv2.setNumThreads(1)
