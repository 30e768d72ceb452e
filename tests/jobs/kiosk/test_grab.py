"""Keyboard and pointer of a kiosk under X with the window manager openbox; xdotool presses the keys."""

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from pigaming_app.storage.pin import PinFile

ROOT = Path(__file__).resolve().parents[3]
MISSING = [tool for tool in ("Xvfb", "openbox", "xdotool") if not shutil.which(tool)]
OTHER = """
import time, pygame
pygame.display.init()
pygame.display.set_caption("Other")
pygame.display.set_mode((300, 200))
while not any(event.type == pygame.QUIT for event in pygame.event.get()):
    time.sleep(0.02)
"""
PIN = "274918"
PATIENCE = 60.0  # s for a window to appear

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(bool(MISSING), reason=f"no {', '.join(MISSING)}: apt-get install xvfb openbox xdotool"),
]


class Desktop:
    """A screen with a window manager and another window."""

    def __init__(self, home: Path) -> None:
        self.home = home
        self.started: list[subprocess.Popen[bytes]] = []
        read, write = os.pipe()
        self.variables = dict(os.environ)
        words = ["Xvfb", "-displayfd", str(write), "-nolisten", "tcp", "-noreset", "-screen", "0", "1280x720x24"]
        self.started.append(subprocess.Popen(words, pass_fds=[write], stderr=subprocess.DEVNULL))
        os.close(write)
        with os.fdopen(read) as numbers:
            self.variables |= {"DISPLAY": f":{numbers.readline().strip()}", "PIGAMING_HOME": str(home)}
        self.variables |= {"SDL_AUDIODRIVER": "dummy", "SDL_VIDEODRIVER": "x11", "PYTHONPATH": str(ROOT)}

    def open(self) -> None:
        self.start("openbox")
        self.wait_until(lambda: self.tool("get_num_desktops") not in ("", "0"), "no window manager")
        self.start(sys.executable, "-c", OTHER)
        self.wait_for("Other")

    def start(self, *words: str) -> subprocess.Popen[bytes]:
        process = subprocess.Popen(words, env=self.variables, cwd=ROOT, stderr=subprocess.DEVNULL)
        self.started.append(process)
        return process

    def tool(self, *words: str) -> str:
        """The answer of xdotool; empty if it has none."""
        done = subprocess.run(["xdotool", *words], env=self.variables, capture_output=True, text=True, check=False)
        return done.stdout.strip()

    @property
    def active(self) -> str:
        """The title of the window in front."""
        return self.tool("getactivewindow", "getwindowname")

    def wait_for(self, title: str) -> None:
        self.wait_until(lambda: self.active == title, f"{title} is not in front")

    def wait_until(self, holds: Callable[[], bool], otherwise: str) -> None:
        end = time.monotonic() + PATIENCE
        while not holds():
            assert time.monotonic() < end, f"{otherwise}; in front: {self.active!r}"
            time.sleep(0.2)

    def press(self, *keys: str) -> None:
        for key in keys:
            self.tool("key", key)
            time.sleep(0.4)

    def close(self) -> None:
        for process in reversed(self.started):
            process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


@pytest.fixture
def desktop(tmp_path: Path) -> Iterator[Desktop]:
    made = Desktop(tmp_path)
    try:
        made.open()
        yield made
    finally:
        made.close()


def arcade(desktop: Desktop, *words: str) -> subprocess.Popen[bytes]:
    """An arcade that is in front."""
    started = desktop.start(sys.executable, "-m", "pigaming_app", *words)
    desktop.wait_for("PiGaming")
    time.sleep(1.0)
    return started


def test_the_keys_of_the_desktop_lead_out_of_an_arcade(desktop: Desktop) -> None:
    """The control experiment: what the kiosk withstands has an effect elsewhere."""
    arcade(desktop)
    desktop.press("alt+Tab")
    desktop.wait_for("Other")


def test_no_key_of_the_desktop_leads_out_of_a_kiosk(desktop: Desktop) -> None:
    started = arcade(desktop, "--kiosk")
    for keys in (
        "alt+Tab",
        "alt+shift+Tab",
        "alt+F4",
        "super+d",
        "alt+space",
        "ctrl+alt+Left",
        "super+e",
        "alt+Escape",
    ):
        desktop.press(keys)
        assert desktop.active == "PiGaming", keys
    assert started.poll() is None


def test_after_a_restart_it_is_in_front_again_and_keeps_the_keys(desktop: Desktop) -> None:
    started = arcade(desktop, "--kiosk")
    child = subprocess.run(["pgrep", "-P", str(started.pid)], capture_output=True, text=True, check=True).stdout.split()
    os.kill(int(child[0]), 9)
    time.sleep(1.0)
    desktop.wait_for("PiGaming")
    time.sleep(1.0)
    desktop.press("alt+Tab")
    assert desktop.active == "PiGaming"


def test_the_pin_that_is_typed_on_the_first_title_is_the_pin(desktop: Desktop) -> None:
    """The whole way: real keys on the page of a real kiosk."""
    arcade(desktop, "--kiosk")
    for _ in range(2):
        desktop.press(*PIN, "Return")
    assert (desktop.home / "config" / "pin.json").exists()
    assert PinFile(desktop.home / "config").check(PIN)
