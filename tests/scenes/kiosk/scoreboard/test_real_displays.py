"""The printed command on two real displays: two screens of one X server, whose pictures are read from its memory."""

import mmap
import os
import shutil
import signal
import struct
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(shutil.which("Xvfb") is None, reason="no Xvfb: apt-get install xvfb"),
]

ROOT = Path(__file__).resolve().parents[4]
SIZES = ((640, 480), (1366, 768))  # px; SDL puts both at (0, 0), so a window's middle has to be on one of them only
PATIENCE = 60.0  # s


@pytest.fixture
def screens(tmp_path: Path) -> Iterator[tuple[str, tuple[Callable[[], float], ...]]]:
    """The name of an X server with two screens, and for each the share of its pixels that are lit."""
    reading, writing = os.pipe()
    options = [word for i, (w, h) in enumerate(SIZES) for word in ("-screen", str(i), f"{w}x{h}x24")]
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writing), "-nolisten", "tcp", "-fbdir", str(tmp_path), *options],
        pass_fds=[writing],
        stderr=subprocess.DEVNULL,
    )
    os.close(writing)
    try:
        with open(reading) as line:
            number = line.readline().strip()
        yield f":{number}", tuple(lit(tmp_path / f"Xvfb_screen{i}", size) for i, size in enumerate(SIZES))
    finally:
        server.terminate()
        server.wait(PATIENCE)


def lit(dump: Path, size: tuple[int, int]) -> Callable[[], float]:
    """A function of the share of lit pixels in a screen that Xvfb keeps as an X window dump."""

    def share() -> float:
        with dump.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as memory:
            header, *fields = struct.unpack_from(">20I", memory)
            assert (fields[3], fields[4]) == size
            pixels = np.frombuffer(bytes(memory), np.uint8, offset=header + 12 * fields[18])
            return float((pixels[: 4 * size[0] * size[1]].reshape(-1, 4)[:, :3].max(1) > 40).mean())

    return share


@pytest.mark.again
def test_the_second_screen_of_the_command_line_fills_the_second_display(
    tmp_path: Path, screens: tuple[str, tuple[Callable[[], float], ...]]
) -> None:
    display, (first, second) = screens
    environment = {name: value for name, value in os.environ.items() if name != "SDL_VIDEODRIVER"}
    command = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), "--display", "1", "--scoreboard", "2"]
    arcade = subprocess.Popen(
        command, env={**environment, "DISPLAY": display, "PIGAMING_HOME": str(tmp_path)}, stderr=subprocess.PIPE
    )
    end = time.monotonic() + PATIENCE
    while min(first(), second()) < 0.02 and arcade.poll() is None and time.monotonic() < end:
        time.sleep(0.05)
    seen = first(), second()
    arcade.send_signal(signal.SIGTERM)
    errors = arcade.communicate(timeout=PATIENCE)[1]
    assert (arcade.returncode, errors) == (0, b"")
    assert min(seen) >= 0.02, "the title on one display, the scores on the other"
