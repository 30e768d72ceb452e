"""Exposure control of a camera: at most LONGEST while calibrating, kept for matches, read back from the driver.

Drivers count exposure in units of their own: V4L2 in 100 us, DirectShow and Media Foundation in powers of two (s);
others have no such property. Without a figure of the driver, the interval of the pictures is an upper bound.
"""

import sys
from collections import deque
from math import floor, log2
from typing import Any

import numpy as np

from pigaming_app.hardware.signals import ExposureKept, ExposureState, Image
from pigaming_app.storage.messages import OperatorMessage

LONGEST = 1 / 60  # s; at 1/30 s, moving markers smear: 52-61 % of them are found
TOLERANCE = 1.03  # drivers round
IMPLAUSIBLE = 1 / 8  # s, from which a driver's figure is no exposure: such a camera sends few pictures a second
HIGHEST_GAIN = 1e6  # units of the driver, beyond which its figure is no gain
BRIGHT = 70.0  # grey level of the brightest 5 % of a picture, below which the calibration raises the gain
DELAYED = 7  # pictures until a change of exposure or gain shows
GAIN_FACTOR, GAIN_STEP = 1.5, 8.0  # of one increase of the gain: the larger one
PICTURES = 30  # of which the interval is measured
CHECK = 1.0  # s between two readings of a settled exposure, which drivers and other programs change


def warning_of(state: ExposureState) -> OperatorMessage | None:
    """The message for an operator, or None if the exposure is short and the picture bright."""
    if state.dark:
        return OperatorMessage("exposure_dark")
    if not state.bound or state.bound <= LONGEST * TOLERANCE:
        return None
    key = "exposure_unknown" if state.seconds is None else "exposure_long"
    return OperatorMessage(key, time=fraction(state.bound), limit=fraction(LONGEST))


def fraction(seconds: float) -> str:
    """An exposure as photographers write it: 1/60."""
    return f"1/{round(1.0 / seconds)}" if seconds < 0.5 else f"{seconds:.1f}"


class ExposureControl:
    """Sets exposure and gain of an opened capture. `observe` every picture; `state` is the present state.

    After `settle` s all automatics are locked. `fresh`: restart them first, then
    limit the exposure to LONGEST and raise the gain if that is too dark. `kept` is set at once and again when locking.
    A locked exposure is read every CHECK s, and set again if it has become longer.
    """

    def __init__(
        self, cv: Any, capture: Any, now: float, settle: float, fresh: bool = False, kept: ExposureKept | None = None
    ) -> None:
        self._cv, self._capture, self._lock_at, self._fresh = cv, capture, now + settle, fresh
        self._kept = None if fresh else kept
        self._power, self._counts = _units(capture)
        self.state = ExposureState()
        self._times: deque[float] = deque(maxlen=PICTURES)
        self._waiting: int | None = None  # pictures until the brightness is judged; None: not locked yet
        self._locked: float | None = None  # s, exposure when it was locked; None: no figure
        self._check_at = 0.0  # s, time of the next reading
        if fresh:  # drivers keep a lock when the camera is closed
            capture.set(cv.CAP_PROP_AUTO_EXPOSURE, _automatic(capture)[1])
            capture.set(cv.CAP_PROP_AUTO_WB, 1.0)
            capture.set(cv.CAP_PROP_AUTOFOCUS, 1.0)
        elif kept is not None:
            self._restore(kept)
        self._read()

    def observe(self, image: Image, now: float) -> None:
        """Note a picture that arrived at a time; change exposure or gain where due."""
        self._times.append(now)
        if len(self._times) == PICTURES:
            between = np.diff(np.array(self._times))
            self.state = self.state._replace(interval=float(np.median(between)))
        if self._waiting is None:
            if now >= self._lock_at:
                self._lock()
        elif not self.state.settled:
            self._waiting -= 1
            if self._waiting <= 0:
                self._brighten(image)
        if now >= self._check_at:
            self._check_at = now + CHECK
            self._check()

    def _lock(self) -> None:
        lock_exposure(self._cv, self._capture)
        self._waiting = DELAYED
        if self._kept is not None:
            self._restore(self._kept)
        self._read()
        if self._fresh and not (self.state.seconds or 1.0) <= LONGEST * TOLERANCE:
            self._set_exposure(LONGEST)
            self._read()
        self._locked = self.state.seconds
        self.state = self.state._replace(settled=not self._fresh)

    def _check(self) -> None:
        """Read the exposure; shorten it again if it is longer than it was locked."""
        self._read()
        if self._locked is not None and (self.state.seconds or 0.0) > self._locked * TOLERANCE:
            self._capture.set(self._cv.CAP_PROP_AUTO_EXPOSURE, _automatic(self._capture)[0])
            self._set_exposure(self._locked)
            self._read()

    def _brighten(self, image: Image) -> None:
        """Raise the gain by one step if the picture is too dark; settled if it is not, or cannot be raised."""
        if brightness(image) >= BRIGHT:
            self.state = self.state._replace(settled=True)
            return
        before = self.state.gain
        self._capture.set(self._cv.CAP_PROP_GAIN, max(GAIN_FACTOR * before, before + GAIN_STEP))
        self._read()
        stuck = self.state.gain <= before
        self._waiting = DELAYED
        self.state = self.state._replace(settled=stuck, dark=stuck)

    def _restore(self, kept: ExposureKept) -> None:
        self._capture.set(self._cv.CAP_PROP_AUTO_EXPOSURE, _automatic(self._capture)[0])
        self._set_exposure(kept.seconds)
        self._capture.set(self._cv.CAP_PROP_GAIN, kept.gain)

    def _set_exposure(self, seconds: float) -> None:
        """Set the longest exposure of the driver's units that does not exceed `seconds` (by more than rounding)."""
        if self._power:
            self._capture.set(self._cv.CAP_PROP_EXPOSURE, float(floor(log2(seconds) + 0.05)))
        elif self._counts:
            self._capture.set(self._cv.CAP_PROP_EXPOSURE, float(max(1, floor(seconds * 1e4 + 0.05))))

    def _read(self) -> None:
        gain = float(self._capture.get(self._cv.CAP_PROP_GAIN))
        self.state = self.state._replace(
            seconds=told_exposure(self._cv, self._capture), gain=gain if 0.0 < gain <= HIGHEST_GAIN else 0.0
        )


def told_exposure(cv: Any, capture: Any) -> float | None:
    """The exposure by the driver's figure, s; None without one."""
    power, counts = _units(capture)
    raw = float(capture.get(cv.CAP_PROP_EXPOSURE))
    if power and -20.0 < raw < log2(IMPLAUSIBLE):
        return float(2.0**raw)
    return raw * 1e-4 if counts and 1.0 <= raw < IMPLAUSIBLE * 1e4 else None


def locks_exposure(cv: Any, capture: Any) -> bool:
    """True if the driver takes a fixed exposure; the present mode is restored, or automatic if it is not told."""
    codes, before = _automatic(capture), float(capture.get(cv.CAP_PROP_AUTO_EXPOSURE))
    locks = bool(capture.set(cv.CAP_PROP_AUTO_EXPOSURE, codes[0]))
    if locks:
        capture.set(cv.CAP_PROP_AUTO_EXPOSURE, before if before in codes else codes[1])
    return locks


def brightness(image: Image) -> float:
    """Grey level of the brightest 5 %: on a calibration board, the light around its markers."""
    return float(np.percentile(image[::8, ::8], 95.0))


def lock_exposure(cv: Any, capture: Any) -> None:
    """Lock exposure, white balance, focus and gain at their present values, as far as the driver can."""
    gain = capture.get(cv.CAP_PROP_GAIN)
    for automatic, off, value in (
        (cv.CAP_PROP_AUTO_EXPOSURE, _automatic(capture)[0], cv.CAP_PROP_EXPOSURE),
        (cv.CAP_PROP_AUTO_WB, 0.0, cv.CAP_PROP_WB_TEMPERATURE),
        (cv.CAP_PROP_AUTOFOCUS, 0.0, cv.CAP_PROP_FOCUS),
    ):
        now = capture.get(value)
        capture.set(automatic, off)
        capture.set(value, now)
    capture.set(cv.CAP_PROP_GAIN, gain)


def _automatic(capture: Any) -> tuple[float, float]:
    """Codes of manual and automatic exposure: V4L2 has an enumeration, other drivers a switch."""
    return (1.0, 3.0) if backend(capture).startswith("V4L") else (0.0, 1.0)


def _units(capture: Any) -> tuple[bool, bool]:
    """True for exposures in powers of two, and for those counted in 100 us."""
    name = backend(capture)
    return name in ("DSHOW", "MSMF"), name.startswith("V4L")


def backend(capture: Any) -> str:
    """The part of OpenCV that reads a capture, e.g. V4L2."""
    try:
        return str(capture.getBackendName())
    except AttributeError:
        return "V4L2" if sys.platform.startswith("linux") else "DSHOW" if sys.platform == "win32" else ""
