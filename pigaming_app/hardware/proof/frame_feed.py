"""Camera frames from one process to another through a file in memory, in place of a camera driver.

`FrameWriter` stands for the camera, `FrameFeed` for a `cv2.VideoCapture` on it. Two slots take turns: a frame is
complete when its number appears. Time is `time.monotonic`, which all processes share.
"""

import time
from pathlib import Path
from typing import Any

import numpy as np

from pigaming_app.hardware.emulator.optics import SENSOR
from pigaming_app.hardware.signals import CameraFrame, Image
from pigaming_app.hardware.vision.markers import opencv

HEAD = 64  # bytes: number of the newest frame, and the time of exposure of both slots, s
SLOTS = 2
WIDTH, HEIGHT = SENSOR
PATIENCE = 0.2  # s for which `read` waits


class _Frames:
    """The file: its head as numbers, and its slots as pictures."""

    def __init__(self, path: Path, mode: Any) -> None:
        size = HEAD + SLOTS * WIDTH * HEIGHT
        self._file = np.memmap(path, np.uint8, mode, shape=(size,))
        self.count = self._file[:8].view(np.uint64)
        self.captured = self._file[8 : 8 + 8 * SLOTS].view(np.float64)
        self.slots = self._file[HEAD:].reshape(SLOTS, HEIGHT, WIDTH)


class FrameWriter(_Frames):
    """Creates the file."""

    def __init__(self, path: Path) -> None:
        super().__init__(path, "w+")

    def write(self, frame: CameraFrame) -> None:
        """Publish a frame."""
        number = int(self.count[0]) + 1
        self.slots[number % SLOTS] = frame.image
        self.captured[number % SLOTS] = frame.captured
        self.count[0] = number


class FrameFeed(_Frames):
    """The part of `cv2.VideoCapture` that a camera uses."""

    def __init__(self, path: Path) -> None:
        super().__init__(path, "r")
        self._read = int(self.count[0])
        self._captured = 0.0

    def read(self) -> tuple[bool, Image | None]:
        """Wait for a frame newer than the last one; false if none comes."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            number = int(self.count[0])
            if number != self._read:
                image, self._captured = self.slots[number % SLOTS].copy(), float(self.captured[number % SLOTS])
                if int(self.count[0]) - number < SLOTS - 1:  # else it may have been overwritten
                    self._read = number
                    return True, image
            time.sleep(0.001)
        return False, None

    def isOpened(self) -> bool:  # noqa: N802
        return True

    def get(self, name: int) -> float:
        return 1000.0 * self._captured if name == opencv().CAP_PROP_POS_MSEC else 0.0

    def set(self, name: int, value: float) -> bool:
        return True

    def release(self) -> None:
        pass


def replace_cameras(path: Path) -> None:
    """Let every camera that this process opens be a feed from that file."""
    opencv().VideoCapture = lambda *_: FrameFeed(path)
