"""Formats of cameras as OpenCV tells them: of a film and a stream that it reads itself, and of the emulated driver."""

import json
import subprocess
import sys

import cv2
import numpy as np
import pytest

from pigaming_app.hardware.emulator.camera import CameraDriver, CameraTraits, EmulatedCamera, FrameTiming
from pigaming_app.hardware.vision import formats
from tests.hardware.vision.test_stream import CameraServer

RATE = 24.0
SIZE = 320, 240


@pytest.fixture
def film(tmp_path):
    """OpenCV's own film."""

    def write(code):
        path = str(tmp_path / "film.avi")
        writer = cv2.VideoWriter(path, cv2.VideoWriter.fourcc(*code.upper()), RATE, SIZE)
        for level in range(5):
            writer.write(np.full((*SIZE[::-1], 3), 40 * level, np.uint8))
        writer.release()
        return cv2.VideoCapture(path)

    return write


@pytest.mark.parametrize("code", ["MJPG", "ffv1"])
def test_size_rate_and_format_of_a_film_are_those_it_was_written_with(film, code):
    """A film has no exposure."""
    capture = film(code)
    told = formats.told(cv2, capture)
    assert told == (*SIZE, RATE, code, "FFMPEG", None, False)
    assert str(told) == f"320 × 240, 24 Hz, {code}, by FFMPEG; exposure not told, cannot be locked"


def test_a_stream_and_a_camera_that_is_not_there_in_a_process_of_its_own():
    server = CameraServer()
    try:
        address = server.url.replace("127", "anna:secret@127")
        command = [sys.executable, "-m", "pigaming_app.hardware.vision.formats", address, "97"]
        output = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True).stdout
    finally:
        server.close()
    stream, missing = map(json.loads, output.splitlines())
    assert stream[0] == "127.0.0.1"
    assert stream[1].startswith("640 × 360, ")
    assert "secret" not in output
    assert missing == ["97", ""]


class Remembering(CameraDriver):
    """A driver that tells its mode, and one that takes no fixed exposure."""

    fixed = False
    mode = 3.0

    def read(self):
        return False, None

    def get(self, name):
        return self.mode if name == cv2.CAP_PROP_AUTO_EXPOSURE else super().get(name)

    def set(self, name, value):
        if name == cv2.CAP_PROP_AUTO_EXPOSURE:
            if self.fixed:
                return False
            self.mode = value
        return super().set(name, value)


@pytest.mark.parametrize(
    ("fixed", "mode", "after"), [(False, 3.0, 3.0), (False, 1.0, 1.0), (False, 0.0, 3.0), (True, 3.0, 3.0)]
)
def test_a_lock_is_tried_and_taken_back(fixed, mode, after):
    """A driver that does not tell its mode is left automatic."""
    camera = EmulatedCamera(None, FrameTiming(), lambda: 0.0, 1, CameraTraits("V4L2", metered=1 / 100))  # type: ignore[arg-type]  # it paints nothing
    capture = Remembering(camera)
    capture.fixed, capture.mode = fixed, mode
    told = formats.told(cv2, capture)
    assert (told.locks, told.backend, told.width) == (not fixed, "V4L2", 0)
    assert told.exposure == pytest.approx(1 / 100)
    assert capture.mode == after
    assert "no picture came" in str(told)
