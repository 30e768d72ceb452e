"""Background camera tasks: live preview, and a drift check of the calibration.

Each opens the camera, works in small steps and releases it, so that no frame of the arcade waits for a camera.
"""

import logging
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from math import inf
from typing import ClassVar

import numpy as np

from pigaming_app.hardware.calibration.camera_position import TwoHeights
from pigaming_app.hardware.calibration.drift import DriftMonitor
from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane
from pigaming_app.hardware.calibration.quality import CameraQuality, assessed
from pigaming_app.hardware.calibration.site import CalibrationSite
from pigaming_app.hardware.signals import CameraFrame, CameraSource, ExposureKept, ExposureState, Image
from pigaming_app.hardware.vision.camera import shown
from pigaming_app.hardware.vision.discovery import CameraId
from pigaming_app.hardware.vision.markers import WEARERS, MarkerDetector, OpenCVMissing, opencv
from pigaming_app.hardware.vision.sharpness import LightField, blur_of, overexposed
from pigaming_app.storage.messages import OperatorMessage

BLIND = 6.0  # s, timeout without a picture
SMALL = (520, 292)  # px, maximum size of the preview
SPOT, NEAR = (140.0, 400.0), 90.0  # arena px: the spot for a robot, and the tolerance
SEARCH = 0.5  # s between two searches for it
RATE = 1.0  # s over which pictures are counted

PERIOD = 0.005  # s between two steps

NO_PICTURE = OperatorMessage("no_picture")
BROKEN = OperatorMessage("broken")

log = logging.getLogger("pigaming")


class CameraTask:
    """Opens a camera and passes its pictures to `process`. A camera has one user at a time; the next one waits.

    A thread carries out the steps until shortly after `close`; in simulated time the owner of the clock calls `pump`.
    """

    users: ClassVar[dict[tuple[str, CameraId], "CameraTask"]] = {}  # the last one of each camera of each site

    locks = True  # lock the exposure: for measurements, not for a preview
    fresh = False  # settle the exposure again; else it stays as set by the calibration, which matches need
    patience = BLIND  # s without a picture, after which it gives up

    def __init__(self, site: CalibrationSite, number: CameraId) -> None:
        self.site, self.number = site, number
        self.fault: OperatorMessage | None = None
        self.small: Image | None = None  # the newest picture, scaled for the preview
        self.kept: ExposureKept | None = None  # exposure of the calibration, to be set when the camera opens
        self._camera: CameraSource | None = None
        self._since = self._newest = inf  # s: when it was opened, when the newest picture came
        self._closing = threading.Event()
        self._thread: threading.Thread | None = None

    @property
    def exposure(self) -> ExposureState:
        """Exposure and gain of the camera."""
        return self._camera.exposure if self._camera else ExposureState()

    @property
    def finished(self) -> bool:
        """True if no picture is needed any more."""
        return False

    def begin(self) -> None:
        """Start a thread; in simulated time the owner of the clock calls `pump`."""
        if not self.site.stepped:
            before, self.users[self.site.name, self.number] = self.users.get((self.site.name, self.number)), self
            self._thread = threading.Thread(
                target=self._run, args=(before,), name=type(self).__name__.lower(), daemon=True
            )
            self._thread.start()

    def pump(self) -> None:
        """Carry out one step, unless a thread does."""
        if self._thread is None and not self._closing.is_set():
            self.step()

    def close(self) -> None:
        """Request the end; a thread releases its resources within a second. Idempotent."""
        if self._thread is None and not self._closing.is_set():
            self.end()
        self._closing.set()

    def wait(self, seconds: float) -> None:
        """Wait for the end of the thread, at most `seconds`."""
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join(seconds)

    def step(self) -> None:
        """Process the newest picture if there is a new one."""
        now = self.site.clock()
        if self._camera is None:
            self._since = self._newest = now
            try:
                self._camera = self.site.open(self.number, self.locks, self.fresh, self.kept)
            except OpenCVMissing as missing:
                self.give_up(missing.message)
                return
        frame = self._camera.newest()
        if frame is not None:
            self._newest = now
            self.small = scaled_preview(frame.image)
            self.process(frame)
        elif now - self._newest > self.patience and not self.finished:
            self.give_up(self._camera.fault or NO_PICTURE)

    def process(self, frame: CameraFrame) -> None:
        """Process a new picture."""

    def give_up(self, fault: OperatorMessage) -> None:
        """Set `fault`; it is logged once."""
        if fault != self.fault and fault.key != "yet":
            log.warning("camera %s: %s", shown(self.number), fault)
        self.fault = fault

    def end(self) -> None:
        """Release the camera."""
        if self._camera is not None:
            self._camera.close()

    def _run(self, before: "CameraTask | None") -> None:
        """Work until `close`, once `before`, which may hold the same camera, has ended."""
        if before is not None:
            before.wait(2.0)
        try:
            while not self._closing.wait(PERIOD):
                self.step()
        except Exception:
            log.exception("%s failed", type(self).__name__)
            self.give_up(BROKEN)
        finally:
            self.end()


class CameraPreview(CameraTask):
    """Live preview: `small`, `size` in px, `rate` in pictures/s; or the camera's `fault`."""

    locks = False
    patience = 1.0

    def __init__(self, site: CalibrationSite, number: CameraId) -> None:
        super().__init__(site, number)
        self.size = (0, 0)
        self.rate = 0.0
        self.count = 0
        self._counted = (inf, 0)

    def process(self, frame: CameraFrame) -> None:
        self.size, self.fault = (frame.image.shape[1], frame.image.shape[0]), None
        self.count += 1
        now, (since, before) = self.site.clock(), self._counted
        if now - since > RATE:
            self.rate = (self.count - before) / (now - since)
        if not 0.0 <= now - since <= RATE:
            self._counted = (now, self.count)


class DriftCheck(CameraTask):
    """Drift of a calibration: distance of the four corner markers from their calibrated positions, mm.

    `load` reads the calibration for pictures of a size in px (None: any), or raises CalibrationError. `marker_mm` is
    the apparent size of the marker of a robot at SPOT: far from the true size, the mat's width was measured wrongly.
    `heights` finds a wrong height of the camera, once the lid was laid there, too.
    """

    def __init__(
        self, site: CalibrationSite, number: CameraId, load: Callable[[tuple[int, int] | None], GroundPlane]
    ) -> None:
        super().__init__(site, number)
        self.drift: DriftMonitor | None = None
        self.mm: float | None = None  # None: not yet measured
        self.marker_mm: float | None = None
        self.heights: TwoHeights | None = None  # of that marker
        self.quality: CameraQuality | None = None  # of the present picture
        self._load = load
        with suppress(CalibrationError):
            self.kept = load(None).quality.kept
        self._robots: MarkerDetector | None = None
        self._searched = -inf

    def process(self, frame: CameraFrame) -> None:
        if self.fault is not None:
            return
        try:
            if self.drift is None:
                self.drift = DriftMonitor(self._load((frame.image.shape[1], frame.image.shape[0])))
        except CalibrationError as error:
            self.give_up(error.message)
            return
        self.drift.process(frame)
        self.mm = self.drift.mm or None  # exactly 0: no marker has enough samples
        if frame.captured - self._searched > SEARCH:
            self._searched = frame.captured
            self._measure(frame, self.drift.ground)
            self._assess(frame, self.drift)

    def _measure(self, frame: CameraFrame, ground: GroundPlane) -> None:
        """Measure the apparent marker size of a robot on the spot."""
        self._robots = self._robots or MarkerDetector(WEARERS)
        self.heights = self.heights or TwoHeights(ground)
        marks = self._robots.refine(frame.image, self._robots.detect(frame.image))
        away = [ground.on_mat(mark.corners).mean(axis=0) - np.array(SPOT) for mark in marks]
        mark = next((mark for mark, way in zip(marks, away, strict=True) if float(way @ way) < NEAR * NEAR), None)
        self.marker_mm = ground.edge_mm(mark) if mark else None
        self.heights.add(mark)

    def _assess(self, frame: CameraFrame, drift: DriftMonitor) -> None:
        """Assess exposure and blur of the picture, by the corner markers."""
        before = drift.ground.quality
        blurs = blur_of(opencv(), frame.image, drift.seen)
        if before.measured and blurs and self.mm is not None:
            blur = float(np.median(blurs))
            if overexposed(frame.image, drift.seen):
                blur = max(blur, before.blur_px)
            self.quality = replace(
                assessed(before.marker_px, blur, self.exposure, LightField(before.light)), anyway=before.anyway
            )


def scaled_preview(image: Image) -> Image:
    """A picture scaled to fit SMALL, with its aspect ratio kept."""
    cv = opencv()
    h, w = image.shape
    scale = min(SMALL[0] / w, SMALL[1] / h)
    size = (max(1, round(w * scale)), max(1, round(h * scale)))
    return np.asarray(cv.resize(image, size, interpolation=cv.INTER_AREA), dtype=np.uint8)
