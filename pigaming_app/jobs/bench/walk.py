"""Frames of the whole arcade, measured by scenes/walk in separate processes."""

import json
import os
import subprocess
import sys
from tempfile import TemporaryDirectory

from pigaming_app import ROOT


def measure() -> dict[str, float]:
    """Milliseconds of CPU time by screen, the longest first. Raises subprocess.CalledProcessError."""
    return dict(sorted(_figures("walker").items(), key=lambda screen: -screen[1]))


def second_screen() -> dict[str, float]:
    """Frame times with the second screen over those without it. Raises subprocess.CalledProcessError."""
    return _figures("second_screen")


def _figures(module: str) -> dict[str, float]:
    """What a module of scenes/walk prints in its last line."""
    with TemporaryDirectory() as home:
        headless = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PIGAMING_HOME": home}
        command = [sys.executable, "-m", f"pigaming_app.scenes.walk.{module}"]
        done = subprocess.run(
            command, env={**os.environ, **headless}, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True
        )
    found: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    return found
