"""The emulated projector: projects the arcade's window onto the emulated mat."""

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.optics import CANVAS


class Projector:
    """Projector over an arena. `project` takes the window's pixels, (height, width, 4) BGRA, of any size.

    It has the canvas's aspect ratio: from a window with another one it shows the centre, without the bars.
    """

    def __init__(self, arena: EmulatedArena) -> None:
        self.arena = arena

    def project(self, pixels: NDArray[np.uint8]) -> None:
        import cv2

        height, width = pixels.shape[:2]
        scale = min(width / CANVAS[0], height / CANVAS[1])
        left, top = round(width - scale * CANVAS[0]) // 2, round(height - scale * CANVAS[1]) // 2
        pixels = pixels[top : height - top, left : width - left]
        grey = cv2.cvtColor(pixels, cv2.COLOR_BGRA2GRAY)
        if (grey.shape[1], grey.shape[0]) != CANVAS:
            grey = cv2.resize(grey, CANVAS, interpolation=cv2.INTER_AREA)
        self.arena.project(np.asarray(grey, dtype=np.uint8))
