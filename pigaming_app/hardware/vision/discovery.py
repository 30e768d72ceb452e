"""Which cameras there are, and why one cannot be used, in one sentence."""

import os
import re
import sys
from pathlib import Path
from typing import NamedTuple

from pigaming_app.hardware.messages import Said

DEVICES = Path("/sys/class/video4linux")
NODES = Path("/dev")


class Known(NamedTuple):
    """A camera that the system knows."""

    number: int
    name: str


def cameras() -> list[Known]:
    """The cameras that are plugged in, by number; where the system does not tell, the first three numbers."""
    if not sys.platform.startswith("linux"):
        return [Known(number, f"camera {number}") for number in range(3)]
    found = []
    for folder in sorted(DEVICES.glob("video*")):
        number = re.fullmatch(r"video(\d+)", folder.name)
        if number and _text(folder / "index") in ("0", ""):  # the others of a camera carry data, not pictures
            found.append(Known(int(number[1]), _text(folder / "name") or folder.name))
    return sorted(found)


def why_not(number: int) -> Said:
    """Why the camera with this number could not be opened."""
    if not sys.platform.startswith("linux"):
        sentence = f"Camera {number} cannot be used: it is not plugged in, or another program uses it."
        return Said(sentence, "unusable", number=number)
    node = NODES / f"video{number}"
    if not node.exists():
        there = ", ".join(f"{known.number} ({known.name})" for known in cameras())
        sentence = f"There is no camera {number}" + (f"; there are {there}." if there else ": plug one in.")
        return Said(sentence, "other_cameras" if there else "no_camera", number=number, there=there)
    if not os.access(node, os.R_OK | os.W_OK):
        sentence = f"The camera {node} may not be used by this user: add the user to the group video and log in again."
        return Said(sentence, "not_allowed", node=node)
    sentence = f"The camera {node} does not open: another program uses it, or it sends no pictures."
    return Said(sentence, "busy", node=node)


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace").strip()
    except OSError:
        return ""
