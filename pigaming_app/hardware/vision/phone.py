"""A phone as the camera: its page sends JPEG pictures, stamped by its own clock; here they become a `VideoCapture`.

Messages of the page are binary: a kind, then numbers in big-endian order, then what is left. It gets texts in JSON:
{"ack": time} for each picture, which asks for the next one, and which it returns at once with its own time;
{"set": {...}}, settings of its camera by their names in W3C's "MediaStream Image Capture".
"""

import json
import threading
import time
from collections import deque
from collections.abc import Callable
from math import isfinite
from struct import Struct
from typing import Any, NamedTuple

import numpy as np

from pigaming_app.hardware.signals import Image
from pigaming_app.storage.messages import OperatorMessage

PICTURE = 1  # kinds of messages: time and JPEG;
ECHO = 2  # time of an acknowledgement, and of the phone;
TRACK = 3  # exposure (100 us) and gain (ISO), 0: unknown
TIME, TWO = Struct(">d"), Struct(">dd")
LARGEST = 3840  # px, of a side; a small file may claim to be a giant picture
OLD = 1.0  # s from capture to arrival, from which a picture is dropped
ECHOES = 120  # of which the quickest is used: some 4 s, in which two quartz clocks part by 0.4 ms at most
RATED, SHARE = 30, 0.1  # pictures of which the rate is that; share of a new delay in the mean
WAIT = 0.05  # s for which a reader waits for a picture
LIVE = 1.0  # s since the last picture, after which a phone counts as gone
MALFORMED, REPLACED = 4000, 4003  # reasons for which a phone is refused
SETTINGS: dict[str, Callable[[float], dict[str, object]]] = {  # OpenCV's names, and the page's with their values
    "CAP_PROP_AUTO_EXPOSURE": lambda value: {"exposureMode": "manual" if value == 1.0 else "continuous"},
    "CAP_PROP_AUTO_WB": lambda value: {"whiteBalanceMode": "continuous" if value else "manual"},
    "CAP_PROP_AUTOFOCUS": lambda value: {"focusMode": "continuous" if value else "manual"},
    "CAP_PROP_EXPOSURE": lambda value: {"exposureTime": value} if value > 0.0 else {},
    "CAP_PROP_GAIN": lambda value: {"iso": value} if value > 0.0 else {},
}


class PhonePicture(NamedTuple):
    """A picture of a phone, not yet decoded."""

    phone: str
    jpeg: bytes
    captured: float  # s of this computer's clock


class PhoneClock:
    """What a phone's clock shows, in time of this computer: by the quickest of the last echoes.

    Source: RFC 5905, section 10, "Clock Filter Algorithm". Its error is at most half the way of that echo.
    """

    def __init__(self) -> None:
        self._echoes: deque[tuple[float, float]] = deque(maxlen=ECHOES)  # s: way there and back, offset

    @property
    def way(self) -> float:
        """The way of the quickest echo, there and back, s; infinite without any."""
        return min(self._echoes)[0] if self._echoes else float("inf")

    def learn(self, sent: float, there: float, received: float) -> None:
        """Use an echo: sent, returned at `there` by the phone's clock, received; s."""
        if 0.0 <= received - sent < OLD:
            self._echoes.append((received - sent, there - 0.5 * (sent + received)))

    def here(self, there: float) -> float | None:
        """A time of the phone's clock by that of this computer, s; None before the first echo."""
        return there - min(self._echoes)[1] if self._echoes else None


class PhoneFeed:
    """The phone that is the camera now, and its newest picture. `trusted`: the calibrated phone; empty: any."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self.clock = clock
        self.trusted = ""
        self.link: PictureLink | None = None
        self.seen: PhonePicture | None = None  # the newest, whether or not it was read
        self.dropped = 0  # pictures that were none, or too old
        self.delay = 0.0  # s from capture to arrival, mean of the last pictures
        self._arrivals: deque[float] = deque(maxlen=RATED)
        self._waiting: PhonePicture | None = None
        self._arrived = threading.Condition()

    def join(self, phone: str, send: Callable[[str], None], close: Callable[[int], None]) -> "PictureLink":
        """A phone connects and becomes the camera; the former one is closed. May be called by any thread."""
        before, self.link = self.link, PictureLink(self, phone, send, close)
        if before is not None:
            before.close(REPLACED)
        return self.link

    def put(self, picture: PhonePicture) -> None:
        """Replace the newest picture."""
        now = self.clock()
        with self._arrived:
            self.delay += (now - picture.captured - self.delay) * (SHARE if self.live else 1.0)
            self._arrivals.append(now)
            self.seen = self._waiting = picture
            self._arrived.notify_all()

    def take(self) -> PhonePicture | None:
        """The newest picture, once; None if there is none for WAIT s."""
        with self._arrived:
            if self._waiting is None:
                self._arrived.wait(WAIT)
            picture, self._waiting = self._waiting, None
            return picture

    @property
    def rate(self) -> float:
        """Pictures per second, of the last ones."""
        span = self._arrivals[-1] - self._arrivals[0] if self._arrivals else 0.0
        return (len(self._arrivals) - 1) / span if span > 0.0 else 0.0

    @property
    def live(self) -> bool:
        """True if pictures come."""
        return self.seen is not None and self.clock() - self.seen.captured < LIVE

    @property
    def fault(self) -> OperatorMessage:
        """Why there are no usable pictures."""
        stranger = self.live and self.seen is not None and self.trusted not in ("", self.seen.phone)
        return OperatorMessage("other_phone" if stranger else "no_phone")


FEED = PhoneFeed()  # of this computer


class PictureLink:
    """The connection of a phone; `phone` is its name for itself. The server calls `receive` and `gone`."""

    def __init__(self, feed: PhoneFeed, phone: str, send: Callable[[str], None], close: Callable[[int], None]) -> None:
        self.feed, self.phone, self.send, self.close = feed, phone, send, close
        self.clock = PhoneClock()
        self.exposure = self.gain = 0.0  # in 100 us, and ISO; 0: the browser does not tell
        self._acknowledge()

    def receive(self, message: bytes) -> int:
        """Use a message; the code with which to close the connection, or 0."""
        now, kind, content = self.feed.clock(), message[:1], message[1:]
        if kind == bytes([PICTURE]) and len(content) > TIME.size:
            self._receive_picture(content, now)
        elif kind in (bytes([ECHO]), bytes([TRACK])) and len(content) == TWO.size:
            first, second = TWO.unpack(content)
            if not (isfinite(first) and isfinite(second)):
                return MALFORMED
            if kind == bytes([ECHO]):
                self.clock.learn(first, second, now)
            else:
                self.exposure, self.gain = first, second
        else:
            return MALFORMED
        return 0

    def gone(self) -> None:
        """The connection has ended."""
        if self.feed.link is self:
            self.feed.link = None

    def _receive_picture(self, content: bytes, now: float) -> None:
        captured, jpeg = self.clock.here(TIME.unpack_from(content)[0]), content[TIME.size :]
        if self.feed.link is self and captured is not None and now - OLD < captured <= now + self.clock.way and jpeg:
            self.feed.put(PhonePicture(self.phone, jpeg, min(captured, now)))
        else:
            self.feed.dropped += 1
        self._acknowledge()

    def _acknowledge(self) -> None:
        self.send(json.dumps({"ack": self.feed.clock()}))


class PhoneCapture:
    """The part of a `cv2.VideoCapture` that a camera needs. `stranger`: also pictures of a phone that is not trusted.

    `trusts`: each phone whose pictures are read is trusted from now on, as when its place is being calibrated.
    """

    def __init__(self, cv: Any, stranger: bool = False, trusts: bool = False, feed: PhoneFeed = FEED) -> None:
        self._cv, self._stranger, self._trusts, self._feed = cv, stranger or trusts, trusts, feed
        self._captured = 0.0

    def isOpened(self) -> bool:  # noqa: N802
        seen = self._feed.seen
        return self._feed.live and seen is not None and self._admits(seen)

    def read(self) -> tuple[bool, Image | None]:
        """The next picture, grey; False if none comes for a while."""
        picture = self._feed.take()
        if picture is None or not self._admits(picture):
            return False, None
        image = decoded(self._cv, picture.jpeg)
        if image is None:
            self._feed.dropped += 1
            return False, None
        if self._trusts:
            self._feed.trusted = picture.phone
        self._captured = picture.captured
        return True, image

    def get(self, what: int) -> float:
        """The time of the last picture, ms; exposure and gain as the phone reports them; 0 for others."""
        link, cv = self._feed.link, self._cv
        if what == cv.CAP_PROP_POS_MSEC:
            return 1000.0 * self._captured
        if link is None:
            return 0.0
        return {cv.CAP_PROP_EXPOSURE: link.exposure, cv.CAP_PROP_GAIN: link.gain}.get(what, 0.0)

    def set(self, what: int, value: float) -> bool:
        """Ask the phone for a setting of its camera. An exposure or gain counts as set until it reports another one."""
        link = self._feed.link
        wanted = next((make(value) for name, make in SETTINGS.items() if getattr(self._cv, name) == what), {})
        if link is not None and wanted:
            link.send(json.dumps({"set": wanted}))
            link.exposure = value if what == self._cv.CAP_PROP_EXPOSURE and link.exposure else link.exposure
            link.gain = value if what == self._cv.CAP_PROP_GAIN and link.gain else link.gain
        return bool(wanted)

    def getBackendName(self) -> str:  # noqa: N802
        """V4L counts exposures in 100 us as W3C does."""
        return "V4L of a phone"

    def release(self) -> None:
        """The phone goes on sending to whoever reads next."""

    def _admits(self, picture: PhonePicture) -> bool:
        return self._stranger or self._feed.trusted in ("", picture.phone)


def decoded(cv: Any, jpeg: bytes) -> Image | None:
    """A JPEG picture, grey; None if it is none, not whole, or larger than LARGEST."""
    size = size_of(jpeg)
    if size is None or not jpeg.rstrip(b"\0").endswith(b"\xff\xd9") or not 0 < min(size) <= max(size) <= LARGEST:
        return None
    how = cv.IMREAD_GRAYSCALE | cv.IMREAD_IGNORE_ORIENTATION
    try:
        image: Image | None = cv.imdecode(np.frombuffer(jpeg, np.uint8), how)
    except cv.error:
        return None
    return image


def size_of(jpeg: bytes) -> tuple[int, int] | None:
    """Width and height in the frame header of a JPEG, px; None without. Source: ITU T.81, annex B."""
    at = 2
    while jpeg[:2] == b"\xff\xd8" and at + 9 <= len(jpeg) and jpeg[at] == 0xFF:
        marker, length = jpeg[at + 1], int.from_bytes(jpeg[at + 2 : at + 4], "big")
        if 0xC0 <= marker <= 0xCF and marker not in (0xC4, 0xC8, 0xCC):
            return int.from_bytes(jpeg[at + 7 : at + 9], "big"), int.from_bytes(jpeg[at + 5 : at + 7], "big")
        at += 2 + max(2, length)
    return None
