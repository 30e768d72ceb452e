"""Camera discovery, and diagnosis of cameras that do not open."""

import os
import re
import sys
from pathlib import Path
from typing import NamedTuple

from pigaming_app.hardware.vision.phone import FEED
from pigaming_app.hardware.vision.stream import host_of
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.settings import PHONE

DEVICES = Path("/sys/class/video4linux")
NODES = Path("/dev")


CameraId = int | str  # its number, or the address of its stream, or PHONE


class CameraInfo(NamedTuple):
    """A camera known to the operating system."""

    number: CameraId
    name: str


def cameras() -> list[CameraInfo]:
    """Connected cameras by number; outside Linux, where they cannot be listed, numbers 0 to 2."""
    if not sys.platform.startswith("linux"):
        return [CameraInfo(number, f"camera {number}") for number in range(3)]
    connected = []
    for folder in sorted(DEVICES.glob("video*")):
        number = re.fullmatch(r"video(\d+)", folder.name)
        if number and _text(folder / "index") in ("0", ""):  # other nodes of a camera carry metadata
            connected.append(CameraInfo(int(number[1]), _text(folder / "name") or folder.name))
    return sorted(connected)


def unavailable_reason(number: CameraId) -> OperatorMessage:
    """Operator message for a camera that could not be opened."""
    if number == PHONE:
        return FEED.fault
    if isinstance(number, str):
        return OperatorMessage("no_stream", host=host_of(number))
    if not sys.platform.startswith("linux"):
        return OperatorMessage("unusable", number=number)
    node = NODES / f"video{number}"
    if not node.exists():
        there = ", ".join(f"{known.number} ({known.name})" for known in cameras())
        return OperatorMessage("other_cameras" if there else "no_camera", number=number, there=there)
    if not os.access(node, os.R_OK | os.W_OK):
        return OperatorMessage("not_allowed", node=node)
    return OperatorMessage("busy", node=node)


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace").strip()
    except OSError:
        return ""
