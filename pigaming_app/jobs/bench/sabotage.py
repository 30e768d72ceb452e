"""The arcade, with a camera from a file, and with faults on request: one word a line on standard input.

    python -X pigaming -m pigaming_app.jobs.bench.sabotage FEED play pitanks …

The arcade itself is main.py, unchanged; faults replace functions while it runs.
"""

import ctypes
import os
import runpy
import sys
from collections.abc import Callable
from itertools import count
from pathlib import Path
from threading import Thread
from typing import Any

from pigaming_app.hardware.proof.frame_feed import replace_cameras
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.tracking.tracker import Tracker
from pigaming_app.scenes.app import App
from pigaming_app.scenes.mat.robots.match_scene import RealMatch

ROOT = Path(__file__).resolve().parents[3]
SHOWN = 10  # every how many frames a picture is drawn: the emulated arena beside it needs the processor as well
HELD = 2.0  # s for which the interpreter's lock is held
PLAYING = "playing"  # a line on standard output


class Sabotage(Exception):
    """A fault on request."""


def obey() -> None:
    """Carry out the words on standard input."""
    process = Tracker.process
    for line in sys.stdin:
        match line.strip():
            case "lock":
                ctypes.PyDLL(None).usleep(ctypes.c_uint(round(1e6 * HELD)))  # unlike CDLL, it keeps the lock
            case "scene":
                substitute(RealMatch, "update", _fail)
            case "link":
                substitute(Link, "pump", _fail)
            case "tracker":
                substitute(Tracker, "process", _fail)
            case "mend":
                substitute(Tracker, "process", process)
    os._exit(1)  # the process that gave the words has ended


def substitute(owner: type, name: str, function: Callable[..., object]) -> None:
    """Replace a method of a class."""
    setattr(owner, name, function)


def spare() -> None:
    """Draw one frame in SHOWN, which nobody sees."""
    paint, frames = App._paint, count()

    def now_and_then(app: App, end: float) -> bool:
        return paint(app, end) if next(frames) % SHOWN == 0 else True

    substitute(App, "_paint", now_and_then)


def announce() -> None:
    """Print PLAYING as soon as a match has begun."""
    update = RealMatch.update

    def watched(match: RealMatch, seconds: float) -> Any:
        if match.match.seconds > 0.5:
            substitute(RealMatch, "update", update)
            print(PLAYING, flush=True)
        return update(match, seconds)

    substitute(RealMatch, "update", watched)


def _fail(*_: object) -> Any:
    raise Sabotage


def main(words: list[str]) -> None:
    """Run the arcade with these words after the file of the camera."""
    replace_cameras(Path(words[0]))
    announce()
    spare()
    Thread(target=obey, name="sabotage", daemon=True).start()
    sys.argv = ["main.py", *words[1:]]
    runpy.run_path(str(ROOT / "main.py"), run_name="__main__")


if __name__ == "__main__":
    main(sys.argv[1:])
