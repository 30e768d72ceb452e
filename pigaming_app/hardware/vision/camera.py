"""Camera capture in a thread that keeps only the newest frame.

Health is judged by the age of the newest frame, since drivers repeat frames, block and report wrong states. A camera
that fails is reported as `fault` and reopened. Exposure, white balance, gain and focus are locked after they settle,
because automatic corrections look to the tracker like changes of the arena.
"""

import sys
import threading
import time
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, Self

from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.signals import CameraFrame, Clock
from pigaming_app.hardware.vision.discovery import unavailable_reason
from pigaming_app.hardware.vision.markers import opencv

SETTLE = 2.0  # s after opening at which exposure, white balance, focus and gain are locked
STALE = 1.0  # s without a frame after which the camera is reopened
RETRY = 1.0  # s between two attempts to open
PLAUSIBLE = 0.3  # s, largest plausible age of a driver's timestamp
ASSUMED = 0.03  # s from exposure to delivery if the driver gives no plausible timestamp
PATIENCE = 0.8  # s for which `close` waits for a hanging driver


class CaptureSettings(NamedTuple):
    """Requested format, px and frames/s; the camera may deliver another."""

    width: int = 1920
    height: int = 1080
    fps: int = 30


class Camera:
    """The camera with this device number; a context manager. `fault` is its present fault, or None.

    `open_capture` returns a `cv2.VideoCapture` for a number. Raises OpenCVMissing.
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
        self.fresh = fresh  # True: restart automatic exposure etc.; False: keep the values that a calibration locked
        self.fault: OperatorMessage | None = OperatorMessage("yet", number=number)
        self.unlocked: Sequence[str] = ()  # properties that could not be locked
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
        """The newest frame, once; None if there is none since the last call."""
        with self._lock:
            frame, self._newest = self._newest, None
            return frame

    def close(self) -> None:
        """Release the camera, within a second."""
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
                self._configure(capture)
                return capture
            capture.release()
        except (self._cv.error, OSError):
            pass
        self.fault = unavailable_reason(self.number)
        return None

    def _configure(self, capture: Any) -> None:
        cv, wanted = self._cv, self.wanted
        if self.fresh:
            restore_automatic(cv, capture)
        capture.set(cv.CAP_PROP_FOURCC, cv.VideoWriter_fourcc(*"MJPG"))  # raw 1080p does not fit through USB 2
        capture.set(cv.CAP_PROP_FRAME_WIDTH, wanted.width)
        capture.set(cv.CAP_PROP_FRAME_HEIGHT, wanted.height)
        capture.set(cv.CAP_PROP_FPS, wanted.fps)
        capture.set(cv.CAP_PROP_BUFFERSIZE, 1)

    def _read(self, capture: Any) -> None:
        """Read until closed, or until no frame has come for STALE s."""
        opened = last = time.monotonic()
        locked = False
        while not self._closing.is_set():
            try:
                ok, picture = capture.read()
            except (self._cv.error, OSError):
                ok, picture = False, None
            now = time.monotonic()
            if ok and picture is not None and picture.size:
                last = now
                self._store(capture, picture)
            elif now - last > STALE:
                self.fault = OperatorMessage("stopped", number=self.number)
                return
            else:
                self._closing.wait(0.005)
            if not locked and now - opened > self.settle:
                locked, self.unlocked = True, lock_exposure(self._cv, capture)

    def _store(self, capture: Any, picture: Any) -> None:
        grey = picture if picture.ndim == 2 else self._cv.cvtColor(picture, self._cv.COLOR_BGR2GRAY)
        now = self.clock()
        stamp = float(capture.get(self._cv.CAP_PROP_POS_MSEC)) / 1000.0  # V4L2: same clock as time.monotonic
        captured = stamp if 0.0 < now - stamp < PLAUSIBLE else now - ASSUMED
        with self._lock:
            self._count += 1
            self._newest, self.fault = CameraFrame(grey, captured, self._count), None


def restore_automatic(cv: Any, capture: Any) -> None:
    """Restart automatic exposure, white balance and focus: drivers keep a lock when the camera is closed."""
    automatic = 3.0 if sys.platform.startswith("linux") else 0.75  # V4L2 and DirectShow use different codes
    for name, on in ((cv.CAP_PROP_AUTO_EXPOSURE, automatic), (cv.CAP_PROP_AUTO_WB, 1.0), (cv.CAP_PROP_AUTOFOCUS, 1.0)):
        capture.set(name, on)


def lock_exposure(cv: Any, capture: Any) -> list[str]:
    """Lock exposure, white balance, focus and gain at their present values; returns those that stay automatic."""
    unlocked = []
    gain = capture.get(cv.CAP_PROP_GAIN)
    manual = 1.0 if sys.platform.startswith("linux") else 0.25  # V4L2 and DirectShow use different codes
    for name, automatic, off, value in (
        ("exposure", cv.CAP_PROP_AUTO_EXPOSURE, manual, cv.CAP_PROP_EXPOSURE),
        ("white balance", cv.CAP_PROP_AUTO_WB, 0.0, cv.CAP_PROP_WB_TEMPERATURE),
        ("focus", cv.CAP_PROP_AUTOFOCUS, 0.0, cv.CAP_PROP_FOCUS),
    ):
        now = capture.get(value)
        if not capture.set(automatic, off):
            unlocked.append(name)
        capture.set(value, now)
    capture.set(cv.CAP_PROP_GAIN, gain)
    return unlocked
