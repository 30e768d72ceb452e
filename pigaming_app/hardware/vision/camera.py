"""Camera capture in a thread that keeps only the newest frame.

Health is judged by the age of the newest frame, since drivers repeat frames, block and report wrong states. A camera
that fails is reported as `fault` and reopened. Exposure, white balance, gain and focus are locked after they settle,
because automatic corrections look to the tracker like changes of the arena; see `exposure`.
"""

import threading
import time
from collections.abc import Callable
from math import inf
from typing import Any, Self

from pigaming_app.hardware.signals import CameraFrame, Clock, ExposureKept, ExposureState, Image
from pigaming_app.hardware.vision import formats, stream
from pigaming_app.hardware.vision.discovery import CameraId, unavailable_reason
from pigaming_app.hardware.vision.exposure import ExposureControl
from pigaming_app.hardware.vision.markers import opencv
from pigaming_app.hardware.vision.phone import PhoneCapture
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.settings import PHONE

SETTLE = 2.0  # s after opening at which exposure, white balance, focus and gain are locked
STALE = 1.0  # s without a frame after which the camera is reopened
RETRY = 1.0  # s between two attempts to open
PLAUSIBLE = 0.3  # s, largest plausible age of a driver's timestamp
ASSUMED = 0.03  # s from exposure to delivery if the driver gives no plausible timestamp
PATIENCE = 0.8  # s for which `close` waits for a hanging driver


class Camera:
    """The camera with this device number, or at this address, or PHONE; a context manager. `fault`: the present one.

    `open_capture` returns a `cv2.VideoCapture` for a number. Raises OpenCVMissing.
    """

    def __init__(
        self,
        number: CameraId,
        clock: Clock = time.monotonic,
        open_capture: Callable[[int], Any] | None = None,
        settle: float = SETTLE,
        fresh: bool = False,
        kept: ExposureKept | None = None,
    ) -> None:
        self._cv = opencv()
        self.number, self.clock, self.settle = number, clock, settle
        self.fresh = fresh  # restart automatic exposure etc. and choose anew, else keep what a calibration locked
        self.kept = kept  # exposure of a calibration
        self.fault: OperatorMessage | None = OperatorMessage("yet", number=shown(number))
        self.exposure = ExposureState()
        self._open_capture = open_capture or self._cv.VideoCapture
        self._newest: CameraFrame | None = None
        self._count = 0
        self._lock = threading.Lock()
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._run, name=f"camera {shown(number)}", daemon=True)
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
            capture: Any
            if self.number == PHONE:
                capture = PhoneCapture(self._cv, stranger=self.settle == inf, trusts=self.fresh)
            elif isinstance(self.number, str):
                capture = stream.opened(self._cv, self.number)
            else:
                capture = self._open_capture(self.number)
            if capture.isOpened():
                if isinstance(self.number, int):
                    formats.ask(self._cv, capture)
                return capture
            capture.release()
        except (self._cv.error, OSError):
            pass
        self.fault = unavailable_reason(self.number)
        return None

    def _read(self, capture: Any) -> None:
        """Read until closed, or until no frame has come for STALE s."""
        last = time.monotonic()
        control = ExposureControl(self._cv, capture, last, self.settle, self.fresh, self.kept)
        while not self._closing.is_set():
            try:
                ok, picture = capture.read()
            except (self._cv.error, OSError):
                ok, picture = False, None
            now = time.monotonic()
            if ok and picture is not None and picture.size:
                last = now
                control.observe(self._store(capture, picture), now)
                self.exposure = control.state
            elif now - last > STALE:
                self.fault = self._silent()
                return
            else:
                self._closing.wait(0.005)

    def _silent(self) -> OperatorMessage:
        if isinstance(self.number, str):
            return unavailable_reason(self.number)
        return OperatorMessage("stopped", number=self.number)

    def _store(self, capture: Any, picture: Any) -> Image:
        """Store a picture as the newest frame; returns it in grey."""
        grey: Image = picture if picture.ndim == 2 else self._cv.cvtColor(picture, self._cv.COLOR_BGR2GRAY)
        now = self.clock()
        stamp = float(capture.get(self._cv.CAP_PROP_POS_MSEC)) / 1000.0  # V4L2: same clock as time.monotonic
        plausible = isinstance(self.number, int) and 0.0 < now - stamp < PLAUSIBLE  # streams have clocks of their own
        plausible = plausible or self.number == PHONE  # as it is measured
        captured = stamp if plausible else now - ASSUMED
        with self._lock:
            self._count += 1
            self._newest, self.fault = CameraFrame(grey, captured, self._count), None
        return grey


def shown(number: CameraId) -> CameraId:
    """A camera in messages: its number, or the host of its stream, or PHONE."""
    return stream.host_of(number) if isinstance(number, str) and number != PHONE else number
