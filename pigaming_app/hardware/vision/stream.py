"""Cameras in the network, by the address of their stream: MJPEG over HTTP, or RTSP. OpenCV's FFmpeg reads both."""

import os
from typing import Any
from urllib.parse import urlsplit

OPENING, SILENT = 4000, 1500  # ms until an attempt to open, or to read, fails
OPTIONS = "OPENCV_FFMPEG_CAPTURE_OPTIONS"
LIVE = "fflags;nobuffer|flags;low_delay|rtsp_transport;tcp|max_delay;100000|analyzeduration;0"


def opened(cv: Any, address: str) -> Any:
    """A `cv2.VideoCapture` of a stream, without FFmpeg's buffers, which would add to its delay.

    Nor with its threads: a decoder holds back a picture for each further one.
    """
    os.environ.setdefault(OPTIONS, LIVE)
    limits = [cv.CAP_PROP_OPEN_TIMEOUT_MSEC, OPENING, cv.CAP_PROP_READ_TIMEOUT_MSEC, SILENT, cv.CAP_PROP_N_THREADS, 1]
    return cv.VideoCapture(address, cv.CAP_FFMPEG, limits)


def host_of(address: str) -> str:
    """The computer in an address, for messages: without name and password."""
    try:
        return urlsplit(address).hostname or "?"
    except ValueError:  # a bracket without its partner
        return "?"
