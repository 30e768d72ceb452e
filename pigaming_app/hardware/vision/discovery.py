"""Which cameras there are, and why one cannot be used."""

import os
import re
import sys
from pathlib import Path
from typing import NamedTuple

from pigaming_app.hardware.messages import OperatorMessage

DEVICES = Path("/sys/class/video4linux")
NODES = Path("/dev")


class CameraInfo(NamedTuple):
    """A camera that the system knows."""

    number: int
    name: str


def cameras() -> list[CameraInfo]:
    """The cameras that are plugged in, by number; where the system does not tell, the first three numbers."""
    if not sys.platform.startswith("linux"):
        return [CameraInfo(number, f"camera {number}") for number in range(3)]
    found = []
    for folder in sorted(DEVICES.glob("video*")):
        number = re.fullmatch(r"video(\d+)", folder.name)
        if number and _text(folder / "index") in ("0", ""):  # the others of a camera carry data, not pictures
            found.append(CameraInfo(int(number[1]), _text(folder / "name") or folder.name))
    return sorted(found)


def why_not(number: int) -> OperatorMessage:
    """Why the camera with this number could not be opened."""
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
