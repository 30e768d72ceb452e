"""A scan with the pictures of a running rig, while its robots stand.

The scene projects `scan.pattern` and confirms it; the rig's thread uses the camera frames; another thread computes.
"""

import logging
import threading

from pigaming_app.hardware.calibration.camera_task import BROKEN, NO_PICTURE
from pigaming_app.hardware.calibration.ground_plane import GroundPlane
from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.scan.patterns import Pattern
from pigaming_app.hardware.scan.procedure import Scan
from pigaming_app.hardware.scan.things import ThingLayout

KNOWN = 1.0  # s without sight, up to which a robot counts as standing where it was seen
BLIND = 6.0  # s without any frame
REST = 0.002  # s between two slices of the computation, for the thread that draws

log = logging.getLogger("pigaming")


class RigScan:
    """One scan, from its creation to `close`. Call `step` with every frame of the screen."""

    def __init__(self, rig: Rig, ground: GroundPlane, before: ThingLayout) -> None:
        known = [(seen.x, seen.y) for seen in rig.sense() if seen.age < KNOWN]
        self.rig, self.scan = rig, Scan(ground, rig.clock, before, known)
        self._pattern: Pattern | None = None
        self._since = rig.clock()
        self._ended = threading.Event()
        self._thread: threading.Thread | None = None
        rig.viewers.append(self.scan.process)

    def step(self) -> None:
        """Begin the computation when all pictures were taken; end the scan if the camera sends none."""
        if self.scan.pattern is not self._pattern:
            self._pattern, self._since = self.scan.pattern, self.rig.clock()
        elif self._pattern is not None and self.rig.clock() - self._since > BLIND:
            self.scan.fault = self.rig.camera.fault or NO_PICTURE
        if self.scan.computing and self._thread is None:
            self._thread = threading.Thread(target=self._compute, name="scan", daemon=True)
            self._thread.start()

    def close(self) -> None:
        """End the scan, finished or not. Idempotent."""
        self._ended.set()
        if self.scan.process in self.rig.viewers:
            self.rig.viewers.remove(self.scan.process)

    def _compute(self) -> None:
        try:
            while self.scan.computing and not self._ended.wait(REST):
                self.scan.compute()
        except Exception:
            log.exception("the pictures of a scan could not be used")
            self.scan.fault = BROKEN
