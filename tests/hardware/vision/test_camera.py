"""Camera capture with a fake driver: delivered frames, recovery from faults, and messages."""

import os
import sys
import threading
import time

import cv2
import numpy as np
import pytest

from pigaming_app.hardware.vision import camera as reader
from pigaming_app.hardware.vision import discovery as cameras
from pigaming_app.hardware.vision.camera import Camera
from pigaming_app.hardware.vision.exposure import lock_exposure
from pigaming_app.hardware.vision.markers import OpenCVMissing
from tests.hardware.sentences import key_of, refused, sentence

LONG = 60.0  # s after which a test gives up waiting: the machine may be busy


class Driver:
    """A fake capture that delivers a frame for each `go`; `opens`: success of each attempt to open it."""

    def __init__(self, opens=(True,)):
        self.opens, self.tries = list(opens), 0
        self.go = threading.Semaphore(0)
        self.alive, self.raises, self.colour = True, False, True
        self.settings, self.refuses = {}, set()
        self.level, self.stamp = 0, 0.0

    def __call__(self, number):
        self.tries += 1
        self.open = self.opens.pop(0) if len(self.opens) > 1 else self.opens[0]
        return self

    def isOpened(self):  # noqa: N802
        return self.open

    def release(self):
        self.open = False

    def get(self, what):
        return self.stamp * 1000.0 if what == cv2.CAP_PROP_POS_MSEC else self.settings.get(what, 0.0)

    def set(self, what, value):
        self.settings[what] = value
        return what not in self.refuses

    def read(self):
        if self.raises:
            raise cv2.error("the driver fell over")
        if not self.alive or not self.go.acquire(timeout=0.02):
            return False, None
        self.level += 1
        shape = (48, 64, 3) if self.colour else (48, 64)
        return True, np.full(shape, self.level % 256, np.uint8)


def wait_for(what):
    begun = time.monotonic()
    while not what():
        assert time.monotonic() - begun < LONG, "it did not happen"
        time.sleep(0.005)


def wait_for_pictures(driver, camera):
    """Send pictures until the camera is all right, for one alone may count as old before this thread looks again."""
    wait_for(lambda: driver.go.release() or camera.fault is None)


def quick(monkeypatch):
    monkeypatch.setattr(reader, "STALE", 0.1)
    monkeypatch.setattr(reader, "RETRY", 0.02)


def test_the_newest_picture_comes_once_and_older_ones_never(monkeypatch):
    monkeypatch.setattr(reader, "STALE", LONG)
    driver = Driver()
    with Camera(0, open_capture=driver) as camera:
        for _ in range(3):
            driver.go.release()
        wait_for(lambda: driver.level == 3)
        wait_for(lambda: camera._count == 3)
        frame = camera.newest()
        assert frame is not None
        assert frame.number == 3
        assert frame.image.shape == (48, 64)
        assert int(frame.image[0, 0]) == 3
        assert camera.newest() is None
        assert camera.fault is None


def test_the_driver_knows_when_a_picture_was_taken_and_is_believed_if_that_can_be():
    now = 100.0
    driver = Driver()
    driver.stamp, driver.colour = 99.95, False
    with Camera(0, clock=lambda: now, open_capture=driver) as camera:
        driver.go.release()
        wait_for(lambda: camera._count == 1)
        first = camera.newest()
        driver.stamp = 12.0  # a driver whose timestamps start at its own start
        driver.go.release()
        wait_for(lambda: camera._count == 2)
        second = camera.newest()
    assert first is not None
    assert second is not None
    assert first.captured == 99.95
    assert second.captured == now - reader.ASSUMED


def test_a_camera_that_is_unplugged_is_said_and_used_again_when_it_is_back(monkeypatch):
    quick(monkeypatch)
    driver = Driver()
    with Camera(0, open_capture=driver) as camera:
        wait_for_pictures(driver, camera)
        driver.alive = False
        wait_for(lambda: camera.fault is not None)
        assert key_of(camera.fault) in ("stopped", "no_camera", "other_cameras")
        driver.alive = True
        wait_for_pictures(driver, camera)
        assert driver.tries > 1


def test_a_driver_that_raises_is_a_camera_that_sends_nothing(monkeypatch):
    quick(monkeypatch)
    driver = Driver()
    driver.raises = True
    with Camera(3, open_capture=driver) as camera:
        wait_for(lambda: driver.tries > 1)
        assert "\n" not in sentence(camera.fault)


def test_a_busy_camera_is_tried_again(monkeypatch):
    quick(monkeypatch)
    driver = Driver(opens=(False, False, True))
    with Camera(0, open_capture=driver) as camera:
        wait_for(lambda: driver.tries >= 3)
        wait_for_pictures(driver, camera)


def test_closing_takes_less_than_a_second_and_leaves_no_thread():
    durations = []
    for _ in range(3):
        camera = Camera(9, open_capture=Driver(opens=(False,)))
        begun = time.monotonic()
        camera.close()
        durations.append(time.monotonic() - begun)
    assert min(durations) < 1.0
    assert not [thread for thread in threading.enumerate() if thread.name == "camera 9"]


def test_exposure_and_the_rest_are_locked_once_they_have_settled():
    driver = Driver()
    driver.settings = {cv2.CAP_PROP_EXPOSURE: 156.0, cv2.CAP_PROP_GAIN: 7.0}
    with Camera(0, open_capture=driver, settle=0.0):
        driver.go.release()
        wait_for(lambda: driver.settings.get(cv2.CAP_PROP_AUTOFOCUS) == 0.0)
    assert driver.settings[cv2.CAP_PROP_AUTO_WB] == 0
    assert driver.settings[cv2.CAP_PROP_EXPOSURE] == 156.0
    assert driver.settings[cv2.CAP_PROP_GAIN] == 7.0


def test_what_a_camera_lets_be_locked_is_locked():
    driver = Driver()
    driver.refuses = {cv2.CAP_PROP_AUTOFOCUS, cv2.CAP_PROP_AUTO_EXPOSURE}
    lock_exposure(cv2, driver)
    assert driver.settings[cv2.CAP_PROP_AUTO_WB] == 0


@pytest.fixture
def system(tmp_path, monkeypatch):
    """A Linux system with temporary device folders."""
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(cameras, "DEVICES", tmp_path / "class")
    monkeypatch.setattr(cameras, "NODES", tmp_path / "dev")
    (tmp_path / "dev").mkdir()
    for folder, index, name in (
        ("video0", "0", "HD Webcam"),
        ("video1", "1", "HD Webcam"),
        ("video10", "0", "Overhead"),
    ):
        place = tmp_path / "class" / folder
        place.mkdir(parents=True)
        (place / "index").write_text(index + "\n")
        (place / "name").write_text(name + "\n")
    return tmp_path


def test_cameras_are_listed_by_number_without_their_data_nodes(system):
    assert cameras.cameras() == [(0, "HD Webcam"), (10, "Overhead")]


def test_no_such_camera_names_those_that_are_there(system):
    assert (
        sentence(cameras.unavailable_reason(5)) == "There is no camera 5: choose one of 0 (HD Webcam), 10 (Overhead)."
    )


def test_no_camera_at_all(tmp_path, system, monkeypatch):
    monkeypatch.setattr(cameras, "DEVICES", tmp_path / "nothing")
    assert sentence(cameras.unavailable_reason(0)) == "There is no camera 0: plug one in."


def test_no_permission_says_what_to_do(system, monkeypatch):
    (system / "dev" / "video0").write_text("")
    monkeypatch.setattr(os, "access", lambda *_: False)
    assert "group video" in sentence(cameras.unavailable_reason(0))


def test_a_busy_camera_is_said_to_be_busy(system):
    (system / "dev" / "video0").write_text("")
    assert "close other camera programs" in sentence(cameras.unavailable_reason(0))


def test_other_systems_get_one_sentence_too(monkeypatch):
    monkeypatch.setattr(sys, "platform", "win32")
    assert [known.number for known in cameras.cameras()] == [0, 1, 2]
    assert sentence(cameras.unavailable_reason(1)).endswith(".")


def test_without_opencv_there_is_one_sentence(monkeypatch):
    monkeypatch.setitem(sys.modules, "cv2", None)
    with refused(OpenCVMissing, "install opencv-python-headless"):
        Camera(0)


@pytest.mark.parametrize(("fresh", "modes"), [(True, (3.0, 1.0)), (False, (1.0,))])
def test_a_calibration_finds_the_exposure_anew_and_a_match_leaves_it_as_it_was_locked(monkeypatch, fresh, modes):
    quick(monkeypatch)
    driver = Driver()
    driver.settings[cv2.CAP_PROP_AUTO_EXPOSURE] = 1.0  # as left locked by the previous user
    with Camera(0, open_capture=driver, settle=1e9, fresh=fresh):
        wait_for(lambda: driver.tries and cv2.CAP_PROP_BUFFERSIZE in driver.settings)
        assert driver.settings[cv2.CAP_PROP_AUTO_EXPOSURE] in modes
