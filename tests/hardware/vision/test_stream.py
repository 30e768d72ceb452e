"""Cameras in the network, of which another program is the other end: MJPEG by the standard library and Pillow."""

import base64
import io
import threading
import time
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import numpy as np
import pytest
from PIL import Image

from pigaming_app.hardware.vision.camera import Camera
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import english

SIZE = 640, 360
BITS = 16  # of the number in each picture
PERIOD = 1 / 30  # s
WAIT = 20.0  # s


class CameraServer:
    """A phone's camera app: pictures with their number in black and white blocks. `secret`: asked for, in base64."""

    def __init__(self, port: int = 0, secret: str = "") -> None:
        self.sent: dict[int, float] = {}  # time by number
        self.closing, self.silent = threading.Event(), False
        outer = self

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                if secret and self.headers.get("Authorization") != f"Basic {secret}":
                    self.send_response(401)
                    self.send_header("WWW-Authenticate", 'Basic realm="camera"')
                    self.end_headers()
                    return
                self.send_response(200)
                self.send_header("Content-Type", "multipart/x-mixed-replace; boundary=frame")
                self.end_headers()
                try:
                    while not outer.closing.wait(PERIOD):
                        if not outer.silent:
                            self.wfile.write(outer.part())
                except OSError:
                    pass

            def log_message(self, *_: Any) -> None:
                pass

        self.server = ThreadingHTTPServer(("127.0.0.1", port), Handler)
        self.server.daemon_threads = True
        self.port = self.server.server_address[1]
        self.url = f"http://127.0.0.1:{self.port}/video"
        self._lock = threading.Lock()
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def part(self) -> bytes:
        with self._lock:
            number = len(self.sent)
            self.sent[number] = time.monotonic()
        blocks = np.array([255 * (number >> bit & 1) for bit in range(BITS)], np.uint8)
        picture = np.repeat(blocks[None], SIZE[1], 0).repeat(SIZE[0] // BITS, 1)
        file = io.BytesIO()
        Image.fromarray(picture).convert("RGB").save(file, "JPEG")
        raw = file.getvalue()
        return b"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: %d\r\n\r\n%s\r\n" % (len(raw), raw)

    def close(self) -> None:
        self.closing.set()
        self.server.shutdown()
        self.server.server_close()


def number_in(picture: Any) -> int:
    middle = picture[SIZE[1] // 2, SIZE[0] // BITS // 2 :: SIZE[0] // BITS]
    return sum(int(value > 127) << bit for bit, value in enumerate(middle))


@pytest.fixture
def server() -> Iterator[CameraServer]:
    server = CameraServer()
    yield server
    server.close()


def until(holds: Callable[[], Any]) -> Any:
    end = time.monotonic() + WAIT
    while not (found := holds()):
        assert time.monotonic() < end
        time.sleep(0.002)
    return found


def test_pictures_come_in_order_as_they_are_taken(server: CameraServer) -> None:
    """No buffer holds them back: the newest is at most a few behind the last one sent."""
    with Camera(server.url) as camera:
        until(camera.newest)
        numbers, behind = [], []
        for _ in range(40):
            frame = until(camera.newest)
            numbers.append(number_in(frame.image))
            behind.append(time.monotonic() - server.sent[numbers[-1]])
            assert 0.0 < camera.clock() - frame.captured < 0.3
        assert frame.image.shape == SIZE[::-1]
    assert numbers == sorted(set(numbers))
    assert np.median(behind) < 0.2


def test_a_stream_that_stops_is_a_fault_and_returns_by_itself(server: CameraServer) -> None:
    with Camera(server.url) as camera:
        until(camera.newest)
        server.silent = True
        fault = until(lambda: camera.fault)
        assert (fault.key, fault.values) == ("no_stream", {"host": "127.0.0.1"})
        server.silent = False
        until(camera.newest)
        assert camera.fault is None


def test_an_address_without_a_camera_is_a_fault_that_keeps_its_password(server: CameraServer) -> None:
    with Camera("http://anna:secret@127.0.0.1:9/video") as camera:
        until(lambda: camera.fault and camera.fault.key == "no_stream")
        assert "secret" not in str(camera.fault)


def test_a_password_is_sent_as_it_was_before_it_was_written_into_the_address() -> None:
    """The server knows it by RFC 7617: base64 of user:password."""
    server = CameraServer(secret=base64.b64encode(b"kid:p@ss:w/rd").decode())
    try:
        with Camera(server.url.replace("://", "://kid:p%40ss%3Aw%2Frd@")) as camera:
            until(camera.newest)
        with Camera(server.url.replace("://", "://kid:wrong@")) as camera:
            fault = until(lambda: camera.fault and camera.fault.key == "no_stream" and camera.fault)
        assert "password" in english().sentence(fault)
        assert "wrong" not in english().sentence(fault)
    finally:
        server.close()


@pytest.mark.parametrize(
    ("address", "right"),
    [
        ("http://192.168.0.7:8080/video", True),
        ("https://phone.local/stream?size=720", True),
        ("rtsp://anna:secret@10.0.0.2:554/live", True),
        ("http://kid:p%40ss%3Aw%2Frd@host.local/video", True),
        ("http://kid:p@ss@host:80?size=720", True),  # the last @ counts
        ("http://kid:p@ss:w/rd@host/video", False),
        ("http://kid:p@ss/rd@host/video", False),
        ("http://kid:w/rd@host/video", False),
        ("http://kid:p?ss@host/video", False),
        ("http://kid:p#ss@host/video", False),
        ("http://host:port/video", False),
        ("file:///etc/passwd", False),
        ("concat:http://a/b", False),
        ("http://", False),
        ("http:///video", False),
        ("http://a b/", False),
        ("http://anna:pa[ss@10.0.0.2/video", False),
        ("http://[x]/v", False),
        ("http://a/\n", False),
        ("http://" + "a" * 200, False),
        ("rtsp://x/|touch y", False),
    ],
)
def test_addresses_are_those_of_streams_only(address: str, right: bool) -> None:
    settings = Settings()
    if right:
        settings.choose("camera", address)
        assert settings.camera == address
    else:
        with pytest.raises(ValueError, match="camera"):
            settings.choose("camera", address)
    assert settings.camera == (address if right else 0)
