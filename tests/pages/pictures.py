"""The pictures of README and docs/, rendered from the present screens:

    .venv/bin/python -m tests.pages.pictures

writes them into assets/pictures/, and beside them `manifest.json`: of each picture a signature, its mean colours in a
coarse grid before it is encoded. The same program renders the same frames; nobody plays. Needs Pillow.
"""

import base64
import json
import os
import tempfile
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pygame

from pigaming_app.ai.learning.training import TableTraining
from pigaming_app.ai.registry import BRAINS, new_match
from pigaming_app.games.match import Match
from pigaming_app.games.setup import make_setup
from pigaming_app.hardware.control.rig import Rig
from pigaming_app.scenes.brain.rose import PETALS
from pigaming_app.scenes.lab.progress import TrainingProgress
from pigaming_app.scenes.lab.scene import Lab
from pigaming_app.scenes.mat.calibration.corner_markers import draw_corners
from pigaming_app.scenes.mat.robots.marker_discs import MarkerDiscs
from pigaming_app.scenes.views.screenshot import Screenshot
from pigaming_app.sim.plant import Sighting
from pigaming_app.sim.world import HZ
from pigaming_app.ui.input.controls import Controls
from tests.scenes.arcade import Arcade

FOLDER = Path(__file__).resolve().parents[2] / "assets" / "pictures"
MANIFEST = FOLDER / "manifest.json"
SIZE, GRID = (1280, 720), (32, 18)  # px of a picture, cells of a signature
TILE, GAP = (480, 270), 6  # px of the animation's tiles
TICKS, SECONDS, QUALITY = 5, 9.0, 50  # of a match between two frames of the animation; s; WebP
WARM_UP = 3.0  # s of a match rendered before its picture, so that treads and sparks are there
CLIPS = {  # game: arena, seed, second of the picture and of the first frame; in the order of the tiles
    "pitanks": ("classic", 3, 14.0),
    "factory": ("hall", 1, 20.0),
    "race": ("classic", 1, 6.0),
    "football": ("classic", 3, 8.0),
}
LESSONS, TICKS_A_MATCH, LAB_SEED = (0, 4, 8, 12), 6000, 1  # matches after which the robot of the Lab is examined


@cache
def clip(game: str) -> tuple[Match, Screenshot]:
    """A match at the moment of its picture."""
    arena, seed, first = CLIPS[game]
    match = new_match(make_setup(game, ["level5"] * 4, arena, None, seed, None, None, list(BRAINS[game]), None))
    while match.seconds < first - WARM_UP:
        match.tick()
    camera = Screenshot(match)
    while match.seconds < first:
        match.tick()
        camera.watch()
    return match, camera


def picture_of(game: str) -> pygame.Surface:
    """The moment of a game."""
    return pygame.transform.smoothscale(clip(game)[1].screen, SIZE)


def arcade() -> pygame.Surface:
    """The first frame of the animation: the moments of all games, side by side."""
    return tiled([clip(game)[1].screen for game in CLIPS])


def tiled(screens: list[pygame.Surface]) -> pygame.Surface:
    """Four screens side by side."""
    w, h = TILE
    page = pygame.Surface((2 * w + GAP, 2 * h + GAP))
    for i, screen in enumerate(screens):
        page.blit(pygame.transform.smoothscale(screen, TILE), ((w + GAP) * (i % 2), (h + GAP) * (i // 2)))
    return page


def robots() -> pygame.Surface:
    """The race as it is projected onto a mat: corner markers, and a disc under every robot."""
    match, camera = clip("race")
    screen = camera.screen.copy()
    seen = [Sighting(robot.x, robot.y, robot.heading, 0.0) for robot in match.state.robots]
    draw_corners(screen)
    MarkerDiscs(cast(Rig, SimpleNamespace(sense=lambda ahead=0.0: seen, margin=lambda robot, usual: 0.0))).draw(
        screen, {0, 1, 2, 3}
    )
    return pygame.transform.smoothscale(screen, SIZE)


def lab() -> pygame.Surface:
    """The Lab with a robot that has learned for some matches."""
    arcade = Arcade(Controls())
    scene = Lab(arcade.context, fast=False)
    training = TableTraining(scene.table.recipe, LAB_SEED, fast=False)
    progress = scene.table.progress = TrainingProgress(training)
    scene.table.training = training
    arcade.open(scene)
    scene.draw(arcade.screen)
    for matches in LESSONS:
        progress.train((matches - training.matches) * TICKS_A_MATCH)
        examine(progress)
    progress.train(HZ * 20)
    for _ in range(PETALS):
        progress._last_direction = 0.0
        progress.publish(False)
    progress.snapshot.number += 1
    for _ in range(120):
        scene.age += 1 / 60
        scene._follow(1 / 60)
        scene.draw(arcade.screen)
    return pygame.transform.smoothscale(arcade.screen, SIZE)


def examine(progress: TrainingProgress) -> None:
    """One evaluation, to its end."""
    progress._exam_time = 0.0
    exam = progress.exam_due()
    while exam and not exam.over:
        exam.play(1000)
    progress.record_exam()


SCENES: dict[str, Callable[[], pygame.Surface]] = {
    "match.png": lambda: picture_of("pitanks"),
    "factory.png": lambda: picture_of("factory"),
    "race.png": lambda: picture_of("race"),
    "football.png": lambda: picture_of("football"),
    "robots.png": robots,
    "lab.png": lab,
    "arcade.webp": arcade,  # last, since its other frames play on
}


def signature(picture: pygame.Surface) -> bytes:
    """Mean colours of a picture's cells, row by row: red, green, blue."""
    return pygame.image.tobytes(pygame.transform.smoothscale(picture.convert(24), GRID), "RGB")


def saved(name: str) -> pygame.Surface:
    """A picture as it lies in the folder; of an animation the first frame."""
    from PIL import Image

    with Image.open(FOLDER / name) as file:
        frame = file.convert("RGB")
    return pygame.image.frombytes(frame.tobytes(), frame.size, "RGB")


def manifest() -> dict[str, bytes]:
    """The signature of each picture when it was written."""
    return {name: base64.b64decode(text) for name, text in json.loads(MANIFEST.read_text(encoding="utf-8")).items()}


def frames() -> Iterator[pygame.Surface]:
    """The frames of the animation after the first."""
    for _ in range(round(SECONDS * HZ / TICKS)):
        for match, camera in map(clip, CLIPS):
            for _ in range(TICKS):
                match.tick()
                camera.watch()
        yield arcade()


def write(name: str, picture: pygame.Surface) -> None:
    """Save a picture; an animation with all of its frames."""
    if not name.endswith(".webp"):
        pygame.image.save(picture, FOLDER / name)
        return
    from PIL import Image

    first, *rest = (
        Image.frombytes("RGB", page.get_size(), pygame.image.tobytes(page, "RGB")) for page in (picture, *frames())
    )
    options: dict[str, Any] = {"duration": 1000 * TICKS // HZ, "loop": 0, "quality": QUALITY, "method": 6}
    first.save(FOLDER / name, save_all=True, append_images=rest, **options)


def main() -> None:
    """Write all pictures and the manifest."""
    signatures = {}
    for name, scene in SCENES.items():
        picture = scene()
        signatures[name] = base64.b64encode(signature(picture)).decode()
        write(name, picture)
        print(FOLDER / name, flush=True)
    MANIFEST.write_text(json.dumps(signatures, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    os.environ["SDL_VIDEODRIVER"] = os.environ["SDL_AUDIODRIVER"] = "dummy"
    with tempfile.TemporaryDirectory() as home:
        os.environ["PIGAMING_HOME"] = home
        pygame.display.init()
        pygame.display.set_mode((1920, 1080))
        main()
