"""Renders the animation on top of README: `python assets/pictures/render.py` writes arcade.webp beside this file.

AIs play some seconds of all four games, each on a tile; the same script always renders the same frames. Needs Pillow
(the extra `pictures`).
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

TILE, GAP = (480, 270), 6  # px
TICKS = 5  # of a match between two frames
SECONDS = 9.0  # of a clip
WARM_UP = 3.0  # s of a match rendered before a clip, so that treads and sparks are there
QUALITY = 50
CLIPS = (  # game, arena, seed, first second; by tile
    ("pitanks", "classic", 3, 14.0),
    ("factory", "hall", 1, 20.0),
    ("race", "classic", 1, 6.0),
    ("football", "classic", 3, 8.0),
)


def clip(game: str, arena: str, seed: int, first: float) -> Iterator[pygame.Surface]:
    """The frames of a clip."""
    setup = make_setup(game, ["hard"] * 4, arena, None, seed, None, None, list(BRAINS[game]), None)
    match = new_match(setup)
    camera = None
    while match.seconds < first + SECONDS:
        match.tick()
        if match.seconds < first - WARM_UP:
            continue
        camera = camera or Screenshot(match)
        camera.watch()
        if match.seconds >= first and match.state.tick % TICKS == 0:
            yield pygame.transform.smoothscale(camera.screen, TILE)


def frames() -> Iterator[Image.Image]:
    """The frames of all clips side by side, in order."""
    w, h = TILE
    size = 2 * w + GAP, 2 * h + GAP
    for tiles in zip(*(clip(*one) for one in CLIPS), strict=False):
        page = pygame.Surface(size)
        for i, tile in enumerate(tiles):
            page.blit(tile, ((w + GAP) * (i % 2), (h + GAP) * (i // 2)))
        yield Image.frombytes("RGB", size, pygame.image.tobytes(page, "RGB"))


def main() -> None:
    """Write the file."""
    first, *rest = frames()
    file = Path(__file__).with_name("arcade.webp")
    first.save(file, save_all=True, append_images=rest, duration=1000 * TICKS // HZ, loop=0, quality=QUALITY, method=6)


if __name__ == "__main__":
    main()
