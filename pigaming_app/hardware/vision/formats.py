"""Formats of cameras, as far as OpenCV tells.

The doctor runs this file in a process of its own, because a driver may hang or crash. Each camera in the arguments, a
number, or without any in the lines of standard input, an address whose password no list of processes shows, prints one
line of JSON as soon as it is done: its number or host, and what is found; an empty text if it does not open.
"""

import json
import sys
from typing import Any, NamedTuple

from pigaming_app.hardware.vision import stream
from pigaming_app.hardware.vision.exposure import backend, fraction, locks_exposure, told_exposure

WIDTH, HEIGHT, FPS, CODE = 1920, 1080, 30, "MJPG"  # requested: px, frames/s; raw 1080p does not fit through USB 2
TRIES = 10  # pictures until one must have come


class CameraFormat(NamedTuple):
    """What OpenCV tells about an opened camera; 0, "" and None where it does not."""

    width: int  # px, of a picture that was read; 0: none came
    height: int
    fps: float  # frames/s
    code: str  # FOURCC
    backend: str
    exposure: float | None  # s
    locks: bool  # True if the driver takes a fixed exposure

    def __str__(self) -> str:
        size = f"{self.width} × {self.height}" if self.width else "no picture came"
        rate = f"{self.fps:.4g} Hz" if self.fps else "rate not told"
        exposure = f"exposure {fraction(self.exposure)} s" if self.exposure else "exposure not told"
        locks = "can be locked" if self.locks else "cannot be locked"
        return f"{size}, {rate}, {self.code or 'format not told'}, by {self.backend or '?'}; {exposure}, {locks}"


def ask(cv: Any, capture: Any) -> None:
    """Ask a camera for the format that the mat wants; it may deliver another."""
    capture.set(cv.CAP_PROP_FOURCC, cv.VideoWriter_fourcc(*CODE))
    capture.set(cv.CAP_PROP_FRAME_WIDTH, WIDTH)
    capture.set(cv.CAP_PROP_FRAME_HEIGHT, HEIGHT)
    capture.set(cv.CAP_PROP_FPS, FPS)
    capture.set(cv.CAP_PROP_BUFFERSIZE, 1)


def told(cv: Any, capture: Any) -> CameraFormat:
    """The format of an opened camera. It reads a picture: drivers may name a size that they do not deliver."""
    width = height = 0
    for _ in range(TRIES):
        ok, picture = capture.read()
        if ok and picture is not None and picture.size:
            height, width = picture.shape[:2]
            break
    fps = float(capture.get(cv.CAP_PROP_FPS))
    return CameraFormat(
        width,
        height,
        fps if 0.0 < fps < 1000.0 else 0.0,
        _letters(int(capture.get(cv.CAP_PROP_FOURCC))),
        backend(capture),
        told_exposure(cv, capture),
        locks_exposure(cv, capture),
    )


def _letters(number: int) -> str:
    """A FOURCC as text; "" if it is none."""
    letters = (number & 0xFFFFFFFF).to_bytes(4, "little").rstrip(b"\0 ").decode("latin-1")
    return letters if letters.isascii() and letters.isprintable() else ""


def main(cameras: list[str]) -> None:
    """Print what OpenCV tells about each. Raises ImportError without OpenCV."""
    import cv2

    for text in cameras:
        number = int(text) if text.isdecimal() else None
        capture: Any = cv2.VideoCapture(number) if number is not None else stream.opened(cv2, text)
        found = ""
        if capture.isOpened():
            if number is not None:
                ask(cv2, capture)
            found = str(told(cv2, capture))
        capture.release()
        print(json.dumps([stream.host_of(text) if number is None else text, found]), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:] or sys.stdin.read().splitlines())
