"""The longest frame of every screen, measured by scenes/walk in a separate process."""

import json
import os
import subprocess
import sys
from tempfile import TemporaryDirectory

from pigaming_app import ROOT


def measure() -> dict[str, float]:
    """Milliseconds of CPU time by screen, the longest first. Raises subprocess.CalledProcessError."""
    with TemporaryDirectory() as home:
        headless = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PIGAMING_HOME": home}
        command = [sys.executable, "-m", "pigaming_app.scenes.walk.walker"]
        done = subprocess.run(
            command, env={**os.environ, **headless}, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True
        )
    found: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    return dict(sorted(found.items(), key=lambda screen: -screen[1]))
