"""The phone as a camera, without a network: its clock, its pictures, made by Pillow, and its faults."""

import io
import json
import math
import struct
import time
from collections.abc import Callable
from random import Random
from typing import Any

import numpy as np
import pytest
from PIL import Image

pytest.importorskip("cv2")

import cv2

from pigaming_app.hardware.vision import discovery
from pigaming_app.hardware.vision import phone as phones
from pigaming_app.hardware.vision.camera import Camera
from pigaming_app.hardware.vision.exposure import LONGEST
from pigaming_app.hardware.vision.phone import PhoneCapture, PhoneClock, PhoneFeed, PictureLink, decoded, size_of
from pigaming_app.storage.settings import PHONE

ONE, OTHER = "1" * 32, "2" * 32  # phones
LEAD = 5000.0  # s by which a phone's clock is ahead
WAIT = 20.0  # s


def jpeg(value: int = 90, size: tuple[int, int] = (1280, 720), **more: Any) -> bytes:
    file = io.BytesIO()
    Image.new("RGB", size, (value,) * 3).save(file, "JPEG", **more)
    return file.getvalue()


class Phone:
    """A phone on a quick cable, whose clock is LEAD ahead. `told`: what it was sent; `code`: why it was closed."""

    def __init__(self, feed: PhoneFeed, name: str = ONE) -> None:
        self.feed, self.told, self.code = feed, list[dict[str, Any]](), 0
        self.link: PictureLink = feed.join(name, lambda text: self.told.append(json.loads(text)), self._close)
        self.echo()

    def _close(self, code: int) -> None:
        self.code = code

    def echo(self) -> int:
        return self.link.receive(struct.pack(">Bdd", 2, self.told[0]["ack"], self.feed.clock() + LEAD))

    def send(self, picture: bytes, age: float = 0.04) -> int:
        return self.link.receive(struct.pack(">Bd", 1, self.feed.clock() + LEAD - age) + picture)


@pytest.fixture
def feed(monkeypatch: pytest.MonkeyPatch) -> PhoneFeed:
    feed = PhoneFeed()
    monkeypatch.setattr(discovery, "FEED", feed)
    monkeypatch.setattr(PhoneCapture.__init__, "__defaults__", (False, False, feed))
    return feed


def until(holds: Callable[[], Any]) -> Any:
    end = time.monotonic() + WAIT
    while not (found := holds()):
        assert time.monotonic() < end
        time.sleep(0.002)
    return found


def test_a_clock_that_runs_elsewhere_is_known_to_half_the_quickest_way() -> None:
    """By random ways there and back, most of them lopsided, and a quartz that is 50 ppm fast."""
    random = Random(7)
    for _ in range(200):
        clock, lead, now, quickest = PhoneClock(), random.uniform(-1e6, 1e6), 0.0, []
        assert clock.here(1.0) is None
        for _ in range(100):
            now += 1 / 30
            there, back = random.expovariate(100.0), random.expovariate(20.0)
            clock.learn(now, (now + there) * (1.0 + 5e-5) + lead, now + there + back)
            quickest.append(there + back)
        drift = 5e-5 * 100 / 30
        true = now + 0.01
        known = clock.here(true * (1.0 + 5e-5) + lead)
        assert known is not None
        assert abs(known - true) <= 0.5 * min(quickest) + drift + 1e-6
        assert clock.way == pytest.approx(min(quickest), abs=1e-9)


def test_echoes_of_the_future_or_of_long_ago_are_none() -> None:
    clock = PhoneClock()
    clock.learn(10.0, 0.0, 9.0)
    clock.learn(10.0, 0.0, 12.0)
    assert math.isinf(clock.way)


def test_a_picture_has_the_time_of_its_capture(feed: PhoneFeed) -> None:
    one = Phone(feed)
    capture = PhoneCapture(cv2)
    assert not capture.isOpened()
    before = feed.clock()
    one.send(jpeg(77), age=0.2)
    assert capture.isOpened()
    ok, image = capture.read()
    assert ok
    assert image is not None
    assert image.shape == (720, 1280)
    assert abs(int(image.mean()) - 77) <= 1
    stamp = capture.get(cv2.CAP_PROP_POS_MSEC) / 1000.0
    assert before - 0.2 - 0.01 < stamp < feed.clock() - 0.19
    assert capture.read() == (False, None), "each picture once"
    assert [*one.told[-1]] == ["ack"], "which asks for the next one"


def test_only_the_newest_picture_waits(feed: PhoneFeed) -> None:
    one, capture = Phone(feed), PhoneCapture(cv2)
    for value in (10, 20, 200):
        one.send(jpeg(value))
    image = capture.read()[1]
    assert image is not None
    assert image.mean() > 190
    assert capture.read() == (False, None)


@pytest.mark.parametrize("age", [1.5, -0.5, math.nan, math.inf, -math.inf])
def test_pictures_with_impossible_times_are_dropped(feed: PhoneFeed, age: float) -> None:
    one, capture = Phone(feed), PhoneCapture(cv2)
    one.send(jpeg(), age)
    assert capture.read() == (False, None)
    assert feed.dropped == 1


def test_a_picture_before_the_first_echo_is_dropped(feed: PhoneFeed) -> None:
    link = feed.join(ONE, lambda text: None, lambda code: None)
    assert link.receive(struct.pack(">Bd", 1, feed.clock()) + jpeg()) == 0
    assert feed.seen is None


def claiming(picture: bytes, width: int, height: int) -> bytes:
    """The picture with another size in its frame header."""
    at = next(i for i in range(len(picture)) if picture[i] == 0xFF and picture[i + 1] in (0xC0, 0xC2))
    return picture[: at + 5] + struct.pack(">HH", height, width) + picture[at + 9 :]


@pytest.mark.parametrize(
    "broken",
    [
        b"no picture at all",
        b"\xff\xd8\xff\xd9",
        b"\xff\xd8" + b"\xff\xc0" + bytes(40),
        jpeg()[:-2],
        jpeg()[: len(jpeg()) // 2],
        claiming(jpeg(), 60000, 60000),
        claiming(jpeg(), 3841, 100),
        claiming(jpeg(), 0, 720),
        b"\x89PNG\r\n\x1a\n" + bytes(100) + b"\xff\xd9",
    ],
    ids=["text", "empty", "header", "no end", "half", "giant", "wide", "flat", "other"],
)
def test_malformed_pictures_are_dropped_and_the_next_one_counts(feed: PhoneFeed, broken: bytes) -> None:
    one, capture = Phone(feed), PhoneCapture(cv2)
    assert one.send(broken) == 0
    assert capture.read() == (False, None)
    assert feed.dropped == 1
    one.send(jpeg())
    assert capture.read()[0]


def test_half_a_picture_is_none_for_an_opencv_that_fills_it_with_grey() -> None:
    """As OpenCV 4 does."""

    class Lenient:
        IMREAD_GRAYSCALE = IMREAD_IGNORE_ORIENTATION = 0
        error = cv2.error

        def imdecode(self, raw: Any, how: int) -> Any:
            return np.zeros((720, 1280), np.uint8)

    assert decoded(Lenient(), jpeg()) is not None
    assert decoded(Lenient(), jpeg()[:-2]) is None


def test_random_bytes_never_raise(feed: PhoneFeed) -> None:
    random, whole = Random(3), jpeg(size=(64, 48), quality=60)
    for _ in range(1500):
        spoilt = bytearray(whole)
        for _ in range(random.randrange(1, 12)):
            spoilt[random.randrange(len(spoilt))] = random.randrange(256)
        image = decoded(cv2, bytes(spoilt[: random.randrange(2, len(spoilt) + 1)] + b"\xff\xd9"))
        assert image is None or max(image.shape) <= phones.LARGEST
        size_of(random.randbytes(random.randrange(60)))


@pytest.mark.parametrize("size", [(1280, 720), (1920, 1080), (720, 1280), (17, 9)])
@pytest.mark.parametrize(
    "more", [{}, {"progressive": True}, {"quality": 30, "comment": b"\xff\xc0\x00\x00\x01\x00\x01"}]
)
def test_the_size_is_the_one_that_pillow_wrote(size: tuple[int, int], more: dict[str, Any]) -> None:
    assert size_of(jpeg(size=size, **more)) == size


@pytest.mark.parametrize(
    "message",
    [b"", b"\x01", b"\x01" + bytes(8), b"\x02" + bytes(15), b"\x03" + bytes(17), b"\x09abc", b"\x02" + b"\xff" * 16],
)
def test_nonsense_closes_the_connection(feed: PhoneFeed, message: bytes) -> None:
    assert Phone(feed).link.receive(message) == phones.MALFORMED


def test_a_second_phone_takes_over_but_is_not_used_in_place_of_the_calibrated_one(feed: PhoneFeed) -> None:
    """As it stands elsewhere; a preview shows it, and a calibration makes it the one that counts."""
    one, match = Phone(feed), PhoneCapture(cv2)
    one.send(jpeg())
    assert PhoneCapture(cv2, trusts=True).read()[0]
    one.send(jpeg())
    assert match.read()[0]
    other = Phone(feed, OTHER)
    assert one.code == phones.REPLACED
    one.send(jpeg())
    assert match.read() == (False, None), "nor are pictures that the first one still sends"
    other.send(jpeg())
    assert not match.isOpened()
    assert match.read() == (False, None)
    assert feed.fault.key == "other_phone"
    other.send(jpeg())
    assert PhoneCapture(cv2, stranger=True).read()[0]
    other.send(jpeg())
    assert match.read() == (False, None), "a preview changes nothing"
    back = Phone(feed, ONE)
    back.send(jpeg())
    assert match.isOpened()
    assert match.read()[0]


def test_a_connection_that_ends_late_does_not_end_its_successor(feed: PhoneFeed) -> None:
    one, again = Phone(feed), Phone(feed)
    one.link.gone()
    assert feed.link is again.link
    again.link.gone()
    assert feed.link is None


def test_the_camera_reports_a_silent_phone_and_heals(feed: PhoneFeed) -> None:
    with Camera(PHONE) as camera:
        fault = until(lambda: camera.fault and camera.fault.key == "no_phone" and camera.fault)
        assert fault.values == {}
        one = Phone(feed)
        until(lambda: one.send(jpeg()) or camera.newest())
        until(lambda: camera.fault)  # it is silent from here
        assert camera.fault == fault
        frame = until(lambda: one.send(jpeg(), age=0.4) or (camera.fault is None and camera.newest()))
        assert camera.clock() - frame.captured >= 0.4


def test_a_camera_of_another_phone_is_a_fault_with_its_own_words(feed: PhoneFeed) -> None:
    feed.trusted = ONE
    other = Phone(feed, OTHER)
    with Camera(PHONE) as camera:
        until(lambda: other.send(jpeg()) or (camera.fault and camera.fault.key == "other_phone"))
        assert camera.newest() is None
        one = Phone(feed)
        until(lambda: one.send(jpeg()) or (camera.fault is None and camera.newest()))


def test_a_calibration_locks_exposure_white_balance_and_focus(feed: PhoneFeed) -> None:
    """The phone obeys as Chrome on Android does: settings in units of 100 us and ISO."""
    one = Phone(feed)
    track = {"exposureTime": 400.0, "iso": 100.0, "exposureMode": "continuous"}

    def obey() -> bool:
        for told in one.told:
            track.update(told.get("set", {}))
        one.link.receive(struct.pack(">Bdd", 3, track["exposureTime"], track["iso"]))
        one.send(jpeg(150))
        return False

    with Camera(PHONE, settle=0.2, fresh=True) as camera:
        until(lambda: obey() or camera.exposure.settled)
        assert camera.exposure.seconds == pytest.approx(LONGEST, rel=0.01)
    assert track["exposureMode"] == track["whiteBalanceMode"] == track["focusMode"] == "manual"
    assert track["exposureTime"] == math.floor(LONGEST * 1e4)
    assert feed.trusted == ONE, "it is the phone that was calibrated"


def test_without_a_figure_of_the_phone_the_interval_is_the_bound(feed: PhoneFeed) -> None:
    one = Phone(feed)
    with Camera(PHONE, settle=0.0) as camera:
        until(lambda: one.send(jpeg(150)) or camera.exposure.bound)
        assert camera.exposure.seconds is None


def test_rate_and_delay_are_those_of_the_pictures() -> None:
    now = [100.0]
    feed = PhoneFeed(lambda: now[0])
    one = Phone(feed)
    for _ in range(200):
        now[0] += 1 / 25
        one.send(jpeg(size=(16, 16)), age=0.07)
    assert feed.rate == pytest.approx(25.0)
    assert feed.delay == pytest.approx(0.07)
    assert np.isclose(feed.seen.captured if feed.seen else 0.0, now[0] - 0.07)
