"""A camera, read by a thread that keeps the newest picture and throws the rest away.

Health is the age of the newest picture: drivers repeat, block and lie. `trouble` is the fault as a message; a camera
that comes back is used again. Exposure, white balance, gain and focus are locked once they have settled, because what a
camera corrects by itself looks to the tracker as if the arena had changed.
"""

import sys
import threading
import time
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, Self

from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.signals import CameraFrame, Clock
from pigaming_app.hardware.vision.discovery import why_not
from pigaming_app.hardware.vision.markers import opencv

SETTLE = 2.0  # s until exposure and the like are locked
STALE = 1.0  # s without a picture after which the camera is opened anew
RETRY = 1.0  # s between two tries
PLAUSIBLE = 0.3  # s that a driver's time of a picture may lie in the past to be believed
ASSUMED = 0.03  # s from light to picture, where the driver does not tell
PATIENCE = 0.8  # s that `close` waits for a driver that hangs


class CaptureSettings(NamedTuple):
    """How the camera is asked to deliver; it may do otherwise."""

    width: int = 1920
    height: int = 1080
    fps: int = 30


class Camera:
    """The camera with this number. `trouble` is its fault, if there is one. Use it in a `with`, or close it.

    `open_capture` makes a `cv2.VideoCapture`. Raises OpenCVMissing.
    """

    def __init__(
        self,
        number: int,
        wanted: CaptureSettings | None = None,
        clock: Clock = time.monotonic,
        open_capture: Callable[[int], Any] | None = None,
        settle: float = SETTLE,
        fresh: bool = False,
    ) -> None:
        self._cv = opencv()
        self.number, self.wanted, self.clock, self.settle = number, wanted or CaptureSettings(), clock, settle
        self.fresh = fresh  # whether exposure and the like are found anew; else they stay as a calibration locked them
        self.trouble: OperatorMessage | None = OperatorMessage("yet", number=number)
        self.loose: Sequence[str] = ()  # what it goes on correcting by itself
        self._open_capture = open_capture or self._cv.VideoCapture
        self._newest: CameraFrame | None = None
        self._count = 0
        self._lock = threading.Lock()
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._run, name=f"camera {number}", daemon=True)
        self._thread.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def newest(self) -> CameraFrame | None:
        """The newest frame that was not given out before, or None."""
        with self._lock:
            frame, self._newest = self._newest, None
            return frame

    def close(self) -> None:
        """Let go of the camera, within a second."""
        self._closing.set()
        self._thread.join(PATIENCE)

    def _run(self) -> None:
        while not self._closing.is_set():
            capture = self._opened()
            if capture is not None:
                try:
                    self._read(capture)
                finally:
                    capture.release()
            self._closing.wait(RETRY)

    def _opened(self) -> Any:
        try:
            capture = self._open_capture(self.number)
            if capture.isOpened():
                self._ask(capture)
                return capture
            capture.release()
        except (self._cv.error, OSError):
            pass
        self.trouble = why_not(self.number)
        return None

    def _ask(self, capture: Any) -> None:
        cv, wanted = self._cv, self.wanted
        if self.fresh:
            free(cv, capture)
        capture.set(cv.CAP_PROP_FOURCC, cv.VideoWriter_fourcc(*"MJPG"))  # raw 1080p does not fit through USB 2
        capture.set(cv.CAP_PROP_FRAME_WIDTH, wanted.width)
        capture.set(cv.CAP_PROP_FRAME_HEIGHT, wanted.height)
        capture.set(cv.CAP_PROP_FPS, wanted.fps)
        capture.set(cv.CAP_PROP_BUFFERSIZE, 1)

    def _read(self, capture: Any) -> None:
        """Read until it is closed or falls silent."""
        opened = last = time.monotonic()
        locked = False
        while not self._closing.is_set():
            try:
                well, picture = capture.read()
            except (self._cv.error, OSError):
                well, picture = False, None
            now = time.monotonic()
            if well and picture is not None and picture.size:
                last = now
                self._keep(capture, picture)
            elif now - last > STALE:
                self.trouble = OperatorMessage("stopped", number=self.number)
                return
            else:
                self._closing.wait(0.005)
            if not locked and now - opened > self.settle:
                locked, self.loose = True, lock(self._cv, capture)

    def _keep(self, capture: Any, picture: Any) -> None:
        grey = picture if picture.ndim == 2 else self._cv.cvtColor(picture, self._cv.COLOR_BGR2GRAY)
        now = self.clock()
        told = float(capture.get(self._cv.CAP_PROP_POS_MSEC)) / 1000.0  # V4L2: of the same clock as time.monotonic
        captured = told if 0.0 < now - told < PLAUSIBLE else now - ASSUMED
        with self._lock:
            self._count += 1
            self._newest, self.trouble = CameraFrame(grey, captured, self._count), None


def free(cv: Any, capture: Any) -> None:
    """Let the camera find its exposure and the like anew: drivers keep a lock when the camera is closed."""
    automatic = 3.0 if sys.platform.startswith("linux") else 0.75  # two drivers, two words for it
    for name, on in ((cv.CAP_PROP_AUTO_EXPOSURE, automatic), (cv.CAP_PROP_AUTO_WB, 1.0), (cv.CAP_PROP_AUTOFOCUS, 1.0)):
        capture.set(name, on)


def lock(cv: Any, capture: Any) -> list[str]:
    """Keep exposure, white balance, focus and gain as they are now; which of them the camera goes on changing."""
    loose = []
    gain = capture.get(cv.CAP_PROP_GAIN)
    manual = 1.0 if sys.platform.startswith("linux") else 0.25  # two drivers, two words for it
    for name, automatic, off, value in (
        ("exposure", cv.CAP_PROP_AUTO_EXPOSURE, manual, cv.CAP_PROP_EXPOSURE),
        ("white balance", cv.CAP_PROP_AUTO_WB, 0.0, cv.CAP_PROP_WB_TEMPERATURE),
        ("focus", cv.CAP_PROP_AUTOFOCUS, 0.0, cv.CAP_PROP_FOCUS),
    ):
        now = capture.get(value)
        if not capture.set(automatic, off):
            loose.append(name)
        capture.set(value, now)
    capture.set(cv.CAP_PROP_GAIN, gain)
    return loose
