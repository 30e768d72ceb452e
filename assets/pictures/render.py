"""Renders the animation on top of README: `python assets/pictures/render.py` writes arcade.webp beside this file.

AIs play some seconds of each game; the same script always renders the same frames. Needs Pillow (the extra `pictures`).
"""

import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pygame
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
os.environ["SDL_VIDEODRIVER"] = "dummy"
sys.path.insert(0, str(ROOT))

from pigaming_app.ai.registry import BRAINS, new_match  # noqa: E402
from pigaming_app.games.setup import make_setup  # noqa: E402
from pigaming_app.scenes.views.screenshot import Screenshot  # noqa: E402
from pigaming_app.sim.world import HZ  # noqa: E402

SIZE = (800, 450)  # px
TICKS = 4  # of a match between two frames
WARM_UP = 3.0  # s of a match rendered before a clip, so that treads and sparks are there
QUALITY = 50
CLIPS = (  # game, arena, seed, first and last second
    ("pitanks", "classic", 3, 14.0, 21.0),
    ("factory", "hall", 1, 20.0, 27.0),
    ("race", "classic", 1, 6.0, 12.0),
)


def frames() -> Iterator[Image.Image]:
    """The frames of all clips, in order."""
    for game, arena, seed, first, last in CLIPS:
        setup = make_setup(game, ["hard"] * 4, arena, None, seed, None, None, list(BRAINS[game]), None)
        match = new_match(setup)
        camera = None
        while match.seconds < last:
            match.tick()
            if match.seconds < first - WARM_UP:
                continue
            camera = camera or Screenshot(match)
            camera.watch()
            if match.seconds >= first and match.state.tick % TICKS == 0:
                small = pygame.transform.smoothscale(camera.screen, SIZE)
                yield Image.frombytes("RGB", SIZE, pygame.image.tobytes(small, "RGB"))


def main() -> None:
    """Write the file."""
    first, *rest = frames()
    file = Path(__file__).with_name("arcade.webp")
    first.save(file, save_all=True, append_images=rest, duration=1000 * TICKS // HZ, loop=0, quality=QUALITY, method=6)


if __name__ == "__main__":
    main()
