"""Testbed: the whole robot loop on the emulated arena, for measurements against ground truth.

The arena has moderate noise, an operator-grade calibration and the light of a game. `trials` and `emergencies` use it.
"""

from time import thread_time

import numpy as np

from pigaming_app.hardware.calibration.ground_plane import GroundPlane
from pigaming_app.hardware.emulator.camera import FrameTiming
from pigaming_app.hardware.emulator.radio import MODERATE, RadioChannel
from pigaming_app.hardware.emulator.wifi.air import WifiChannel
from pigaming_app.hardware.proof.showings import SHOWINGS, NoLight, Showing, ShowingSession
from pigaming_app.hardware.session.emulated import XBEES, EmulatedFleet
from pigaming_app.hardware.session.lighting import Lighting
from pigaming_app.hardware.signals import CameraFrame, Fix
from pigaming_app.hardware.tracking.tracker import Tracker
from pigaming_app.sim.world import ROBOTS

EXPOSURE_JITTER = 0.15  # size of the exposure steps, as a share
DELAY = 0.060  # latency of frames, s; with tick, serial line and radio the dead time is 80 ms


class TimedTracker(Tracker):
    """A tracker that measures its CPU time and its share of complete frames."""

    seconds = 0.0
    pictures = complete = 0

    def process(self, frame: CameraFrame) -> list[Fix]:
        """Process a frame; returns the accepted fixes."""
        began = thread_time()
        fixes = super().process(frame)
        self.seconds += thread_time() - began
        self.pictures += 1
        self.complete += len({fix.robot for fix in fixes}) == ROBOTS
        return fixes


class Testbed:
    """A calibrated arena with a rig. `drops`: share of lost frames; `ground`: skips the calibration if given.

    `wifi`, `fleet`: see EmulatedSession.
    """

    def __init__(
        self,
        seed: int,
        fps: float,
        drops: float = 0.0,
        channel: RadioChannel = MODERATE,
        ground: GroundPlane | None = None,
        wifi: WifiChannel | None = None,
        fleet: EmulatedFleet = XBEES,
        showing: Showing = SHOWINGS["projector"],
    ) -> None:
        self.showing, self.body_mm = showing, fleet.kind.radius_mm
        self.lighting = NoLight(seed) if showing.paper else Lighting(seed)
        self.session = ShowingSession(
            showing,
            seed,
            False,
            lighting=self.lighting,
            timing=FrameTiming(fps, DELAY, drops=drops),
            channel=channel,
            exposure_jitter=EXPOSURE_JITTER,
            ground=ground,
            tracker=TimedTracker,
            wifi=wifi,
            fleet=fleet,
        )
        self.rig = self.session.open()
        self.arena, self.ground = self.session.arena, self.session.ground
        assert isinstance(self.rig.tracker, TimedTracker)
        self.tracker, self.link = self.rig.tracker, self.rig.link

    def count(self) -> None:
        """Reset the tracker's counters."""
        self.tracker.seconds, self.tracker.pictures, self.tracker.complete = 0.0, 0, 0

    def tick(self) -> None:
        """Advance lighting, arena and rig by 1/50 s."""
        self.session.tick()

    def misses(self) -> list[tuple[float, float]]:
        """Errors of each robot's predicted position, mm, and heading, rad."""
        pairs = zip(self.rig.sense(), self.arena.poses(), strict=True)
        mm = self.ground.mm
        return [
            (mm * float(np.hypot(seen.x - x, seen.y - y)), abs(float(np.angle(np.exp(1j * (seen.heading - heading))))))
            for seen, (x, y, heading) in pairs
        ]


def one_core() -> None:
    """Restrict OpenCV to one core, for comparable timings."""
    import cv2

    cv2.setNumThreads(1)
