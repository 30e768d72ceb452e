"""Cameras with RTSP, of which GStreamer's server is the other end, with a name and a password."""

import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path

import pytest

from pigaming_app.hardware.vision.camera import Camera
from tests.hardware.vision.test_stream import BITS, SIZE, number_in, until

SERVER = Path(__file__).with_name("rtsp_server.py")
PYTHON = "/usr/bin/python3"  # Debian's, which has GStreamer's bindings
BINDINGS = "import gi; gi.require_version('GstRtspServer', '1.0')"
PACKAGES = "python3-gi gir1.2-gst-rtsp-server-1.0 gstreamer1.0-plugins-{base,good,ugly}"
DELAY = {"jpeg": 0.030, "h264": 0.060}  # s, of the quickest: one picture is held back by FFmpeg's parser of H.264
PICTURES = 60
pytestmark = [pytest.mark.long, pytest.mark.again]


@pytest.fixture(autouse=True)
def bindings() -> None:
    try:
        subprocess.run([PYTHON, "-c", BINDINGS], check=True, capture_output=True, timeout=20)
    except (OSError, subprocess.SubprocessError):
        pytest.skip(f"no RTSP server of GStreamer: apt-get install --no-install-recommends {PACKAGES}")


@contextmanager
def served(codec: str, port: int = 0) -> Iterator[int]:
    """The port of a running server; a name and password are needed."""
    command = [PYTHON, str(SERVER), str(port), codec, "anna", "secret"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        try:
            yield int(server.stdout.readline())
        finally:
            server.kill()


def address(port: int, password: str = "secret") -> str:
    return f"rtsp://anna:{password}@127.0.0.1:{port}/live"


@pytest.mark.parametrize("codec", ["jpeg", "h264"])
def test_pictures_come_in_order_and_are_not_held_back(codec: str) -> None:
    with served(codec) as port, Camera(address(port)) as camera:
        until(camera.newest)
        taken, delays = [], []
        for _ in range(PICTURES):
            frame = until(camera.newest)
            taken.append(number_in(frame.image))
            delays.append((round(1000 * time.monotonic()) - taken[-1]) % 2**BITS / 1000)
        assert frame.image.shape == SIZE[::-1]
        assert all(0 < after - before < 2**BITS / 2 for before, after in pairwise(taken))
        assert min(delays) < DELAY[codec]


def test_a_server_that_ends_is_a_fault_and_its_pictures_return_with_it() -> None:
    with served("h264") as port:
        camera = Camera(address(port))
        until(camera.newest)
    with camera:
        fault = until(lambda: camera.fault)
        assert (fault.key, fault.values) == ("no_stream", {"host": "127.0.0.1"})
        camera.newest()  # one that came before the end
        with served("h264", port):
            until(camera.newest)
            assert camera.fault is None


def test_a_wrong_password_is_a_fault_that_does_not_tell_it() -> None:
    with served("jpeg") as port, Camera(address(port, "guessed")) as camera:
        fault = until(lambda: camera.fault and camera.fault.key == "no_stream" and camera.fault)
        assert "guessed" not in str(fault)
        assert camera.newest() is None
