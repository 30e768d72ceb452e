"""How long a frame of a busy match takes: `python tests/bench/frame.py`."""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))
os.environ.setdefault("SDL_VIDEODRIVER", "dummy")

import pygame

from pigaming_app.scenes.views.busy import busy_frames


def frame_times(frames: int = 600) -> list[float]:
    """Milliseconds of each frame of a busy made-up match at 1920 x 1080, sprites made ahead, without the flip."""
    pygame.display.init()
    pygame.font.init()
    return busy_frames(pygame.display.set_mode((1920, 1080)), frames)


if __name__ == "__main__":
    times = sorted(frame_times())
    print(f"median {times[len(times) // 2]:.2f} ms, p99 {times[len(times) * 99 // 100]:.2f}, worst {times[-1]:.2f}")
