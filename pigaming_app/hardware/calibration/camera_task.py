"""Looking through a camera beside the pictures of the arcade: what it sees, and whether its calibration still holds.

Each is a BackgroundWorker: it opens the camera, works bit by bit, and lets go of it.
"""

from collections.abc import Callable
from math import inf
from typing import ClassVar

import numpy as np

from pigaming_app.hardware.calibration.drift import DriftMonitor
from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane
from pigaming_app.hardware.calibration.site import CalibrationSite
from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.signals import CameraFrame, CameraSource, Image
from pigaming_app.hardware.vision.markers import ROBOT_IDS, MarkerDetector, OpenCVMissing, opencv
from pigaming_app.hardware.worker import BackgroundWorker, log

BLIND = 6.0  # s without a picture after which it is given up
SMALL = (520, 292)  # px of the picture that shows what the camera sees
SPOT, NEAR = (140.0, 400.0), 90.0  # arena px: where a robot is asked to stand, and how near that is
SEARCH = 0.5  # s between two looks for it
RATE = 1.0  # s over which pictures are counted

NO_PICTURE = OperatorMessage("no_picture")
BROKEN = OperatorMessage("broken")


class CameraTask(BackgroundWorker):
    """Opens a camera and hands on its pictures. A camera has one user at a time: the next one waits for it."""

    users: ClassVar[
        dict[tuple[str, int], BackgroundWorker]
    ] = {}  # the last user of each camera, by the site's name and number

    locks = True  # whether the camera locks its exposure: to measure, but not just to look
    fresh = False  # whether it finds it anew; else it stays as the calibration has left it, which is what matches need

    def __init__(self, site: CalibrationSite, number: int) -> None:
        super().__init__()
        self.site, self.number = site, number
        self.trouble: OperatorMessage | None = None
        self.small: Image | None = None  # the newest picture, as small as it is shown
        self._eye: CameraSource | None = None
        self._since = self._newest = inf  # s: when it was opened, when the newest picture came

    def begin(self) -> None:
        """Work in a thread, or be pumped where time is made up."""
        if not self.site.stepped:
            before, self.users[self.site.name, self.number] = self.users.get((self.site.name, self.number)), self
            self.start(before)

    def step(self) -> None:
        """Look at the newest picture, if there is a new one."""
        now = self.site.clock()
        if self._eye is None:
            self._since = self._newest = now
            try:
                self._eye = self.site.open(self.number, self.locks, self.fresh)
            except OpenCVMissing as missing:
                self.give_up(missing.message)
                return
        frame = self._eye.newest()
        if frame is not None:
            self._newest = now
            self.small = shrunk(frame.image)
            self.look(frame)
        else:
            self.idle(now - self._newest, self._eye.trouble)

    def look(self, frame: CameraFrame) -> None:
        """A new picture."""

    def idle(self, seconds: float, trouble: OperatorMessage | None) -> None:
        """No new picture for so long."""

    def give_up(self, trouble: OperatorMessage) -> None:
        """Show this message, and write it into the log once."""
        if trouble != self.trouble and trouble.key != "yet":
            log.warning("camera %d: %s", self.number, trouble)
        self.trouble = trouble

    def failed(self, error: Exception) -> None:
        self.give_up(BROKEN)

    def end(self) -> None:
        if self._eye is not None:
            self._eye.close()


class CameraPreview(CameraTask):
    """What a camera sees: `small`, its `size` in px and how many pictures a second; or what is wrong with it."""

    locks = False

    def __init__(self, site: CalibrationSite, number: int) -> None:
        super().__init__(site, number)
        self.size = (0, 0)
        self.rate = 0.0
        self.count = 0
        self._counted = (inf, 0)

    def look(self, frame: CameraFrame) -> None:
        self.size, self.trouble = (frame.image.shape[1], frame.image.shape[0]), None
        self.count += 1
        now, (since, before) = self.site.clock(), self._counted
        if now - since > RATE:
            self.rate = (self.count - before) / (now - since)
        if not 0.0 <= now - since <= RATE:
            self._counted = (now, self.count)

    def idle(self, seconds: float, trouble: OperatorMessage | None) -> None:
        if seconds > 1.0:
            self.give_up(trouble or NO_PICTURE)


class DriftCheck(CameraTask):
    """Whether a calibration still holds: how far the four corner markers are from where it says that they are seen.

    `load` reads the calibration for a camera with pictures of so many px, or raises CalibrationError. `marker_mm` is
    the apparent size of the marker of a robot at `SPOT`: far from its true size, the mat's width was measured wrongly.
    """

    def __init__(self, site: CalibrationSite, number: int, load: Callable[[tuple[int, int]], GroundPlane]) -> None:
        super().__init__(site, number)
        self.drift: DriftMonitor | None = None
        self.mm: float | None = None  # None: not yet known
        self.marker_mm: float | None = None
        self._load = load
        self._robots: MarkerDetector | None = None
        self._searched = -inf

    def look(self, frame: CameraFrame) -> None:
        if self.trouble is not None:
            return
        try:
            if self.drift is None:
                self.drift = DriftMonitor(self._load((frame.image.shape[1], frame.image.shape[0])))
        except CalibrationError as trouble:
            self.give_up(trouble.message)
            return
        self.drift.see(frame)
        self.mm = self.drift.mm or None  # exactly 0: none has been seen often enough
        if frame.captured - self._searched > SEARCH:
            self._searched = frame.captured
            self._measure(frame, self.drift.ground)

    def _measure(self, frame: CameraFrame, ground: GroundPlane) -> None:
        """How large the marker of a robot on the spot seems."""
        self._robots = self._robots or MarkerDetector(ROBOT_IDS)
        self.marker_mm = None
        for mark in self._robots.everywhere(frame.image):
            away = ground.on_mat(mark.corners).mean(axis=0) - np.array(SPOT)
            if float(away @ away) < NEAR * NEAR:
                self.marker_mm = ground.edge_mm(mark)

    def idle(self, seconds: float, trouble: OperatorMessage | None) -> None:
        if seconds > BLIND:
            self.give_up(trouble or NO_PICTURE)


def shrunk(image: Image) -> Image:
    """A picture as small as it is shown, whatever its shape."""
    cv = opencv()
    h, w = image.shape
    scale = min(SMALL[0] / w, SMALL[1] / h)
    size = (max(1, round(w * scale)), max(1, round(h * scale)))
    return np.asarray(cv.resize(image, size, interpolation=cv.INTER_AREA), dtype=np.uint8)
