"""The emulated arena in real time for an arcade in another process: its camera is a file, its radio a pseudo-terminal
or a network on loopback.

The projector shows one steady picture, grey with the corner markers: this proof is about stops, not about light. Motors
are observed here, where no fault of the arcade can reach.
"""

import time
from collections.abc import Callable
from pathlib import Path
from threading import Event, Thread
from typing import Self

import numpy as np

from pigaming_app.hardware.calibration.boards import CANVAS
from pigaming_app.hardware.calibration.drift import corner_markers
from pigaming_app.hardware.calibration.ground_plane import GroundPlane
from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.camera import FrameTiming
from pigaming_app.hardware.emulator.radio import MODERATE
from pigaming_app.hardware.emulator.realtime import PseudoTerminal, RealtimeArena
from pigaming_app.hardware.emulator.wifi.boards import Boards
from pigaming_app.hardware.emulator.wifi.radio import WifiRadio
from pigaming_app.hardware.proof.emergencies import LOSSY
from pigaming_app.hardware.proof.frame_feed import FrameWriter
from pigaming_app.hardware.session.emulated import calibrated
from pigaming_app.hardware.signals import Image

FPS, DELAY = 30.0, 0.03  # frames/s of the camera; s to the program: both share the computer's time
QUICK = 30  # interval of complete renders, frames
RUNNING, BARELY = 0.1, 0.01  # s since a motor last ran
MOVING = 3  # robots that must move before a fault
SETTLED = 0.4  # s for which they must have moved
OBSERVED = 1.0  # s of observation after a fault
PATIENCE = 60.0  # s until the robots of a running match must move


class OutsideArena:
    """The arena; a context manager. `feed`: file of its camera; `ground`: its calibration.

    With `key`, 16 bytes, its robots are on Wi-Fi, and the arcade is expected at the UDP port `arcade`. Raises
    NoMicroPython; without `key` OSError if the system has no pseudo-terminals.
    """

    def __init__(self, seed: int, feed: Path, key: bytes = b"", arcade: int = 0) -> None:
        self.feed, self.key = feed, key
        self.arena = EmulatedArena(seed, FrameTiming(FPS, DELAY), MODERATE, QUICK)
        self.ground: GroundPlane = calibrated(self.arena)
        self.arena.project(steady_light())
        self._boards: Boards | None = None
        if key:
            radio = WifiRadio(self.arena, LOSSY, arcade, self.arena.arena_id, key, paced=False)
            self.arena.radio, self._boards = radio, radio.boards
        self._time = RealtimeArena(self.arena, None if key else PseudoTerminal())
        self._writer = FrameWriter(feed)
        self._ended = Event()
        self._camera = Thread(target=self._film, name="emulated camera", daemon=True)

    def __enter__(self) -> Self:
        self._time.start()
        self._camera.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self._camera.join(timeout=1.0)
        self._time.close()
        self.arena.radio.end()

    @property
    def port(self) -> str:
        """Name of the serial port; "" on Wi-Fi."""
        return self._time.terminal.name if self._time.terminal else ""

    def pull(self) -> None:
        """Pull the radio's plug: its port hangs up."""
        self._time.plug(None)

    def settle(self, alive: Callable[[], bool]) -> None:
        """Wait until most robots have moved for a while. Raises RuntimeError if they do not, or if the arcade ends."""
        end, since = time.monotonic() + PATIENCE, time.monotonic()
        while (now := time.monotonic()) - since < SETTLED or not self._moving(BARELY):
            if now > end or not alive():
                raise RuntimeError("the robots did not drive" if alive() else "the arcade ended")
            if self._moving(RUNNING) < MOVING:
                since = now
            time.sleep(0.005)

    def stopping(self, begin: Callable[[], None]) -> float:
        """Seconds from a fault until the last motor stopped. Raises RuntimeError if one still runs."""
        began = time.monotonic() if self._boards else self.arena.clock()
        begin()
        time.sleep(OBSERVED)
        if self._moving(RUNNING):
            raise RuntimeError("the robots did not stop")
        return max(0.0, max(self._boards.powered_until if self._boards else self.arena.last_driven) - began)

    def _moving(self, lately: float) -> int:
        """Number of robots whose motors have run within these s."""
        now = self.arena.clock()
        return sum(now - ran < lately for ran in self.arena.last_driven)

    def _film(self) -> None:
        while not self._ended.wait(0.002):
            if frame := self.arena.camera.newest():
                self._writer.write(frame)


def steady_light() -> Image:
    """Grey with the corner markers, (1080, 1920)."""
    page: Image = np.full((CANVAS[1], CANVAS[0]), 128, np.uint8)
    for left, top, marker in corner_markers():
        page[top : top + len(marker), left : left + len(marker)] = marker
    return page
