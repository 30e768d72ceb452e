"""Memory: the cache stays within its budget and keeps nothing of a finished match."""

import gc
import random
import subprocess
import sys
import weakref
from collections.abc import Hashable
from pathlib import Path

import pygame
import pytest

from pigaming_app import ROOT
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.scene import Context, Home, Pop, Push, Stack, StackOperation, Swap
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.start import run
from pigaming_app.scenes.title import scene as title_page
from pigaming_app.scenes.title.scene import Title
from pigaming_app.scenes.views.sprites import robot as tank
from pigaming_app.scenes.views.sprites.effects import beam, wave
from pigaming_app.ui.draw import PLAYERS, surface_cache
from pigaming_app.ui.draw.frame_budget import Steps, Unfinished, budget, resumable
from pigaming_app.ui.draw.surface_cache import CacheEntry, SurfaceCache, surfaces
from pigaming_app.ui.input.events import Button
from tests.bench.memory import press
from tests.cases import repeated
from tests.matches import setup_of
from tests.scenes.arcade import Arcade, Floor

pytestmark = pytest.mark.usefixtures("_cache_as_in_the_arcade")


@pytest.fixture
def arcade(arcade: Arcade) -> Arcade:
    arcade.stack = Stack(Title(arcade.context))
    return arcade


def match(arcade: Arcade, game: str) -> MatchScene:
    """A match of AIs with the longest goal."""
    goal = max(games()[game].default.goals, default=0)
    return MatchScene(arcade.context, setup_of(game, ["level3"] * 4, minutes=2.0, goal=goal))


def warmed(arcade: Arcade, game: str) -> None:
    """Push a match, and wait until all its sprites are built and it has started."""
    scene = match(arcade, game)
    arcade.stack.apply(Push(scene))
    arcade.until(lambda: scene.opening.prewarmed, 60.0)
    arcade.until(lambda: not scene.opening.countdown.locked, 10.0)
    arcade.wait(0.2, draw=True)


@pytest.mark.long
def test_the_sprites_of_a_match_go_on_return_to_the_title(arcade: Arcade) -> None:
    arcade.wait(0.1, draw=True)
    title = surfaces.bytes
    warmed(arcade, "race")
    sprites = [beam(0, 5), wave(PLAYERS[1], 3), *(tank.tank(seat, turn) for seat in range(4) for turn in range(1, 96))]
    images = [weakref.ref(sprite.image) for sprite in sprites]
    assert surfaces.bytes > title + (90 << 20)
    del sprites
    arcade.press(Button.START)
    arcade.wait(0.1, draw=True)
    arcade.stack.apply(Home())
    assert [image for image in images if image()] == []
    arcade.wait(0.1, draw=True)
    assert surfaces.bytes < title + (24 << 20), "what is left are the pages of the match"


def test_after_a_second_the_title_releases_what_other_pages_have_painted(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Once after each return, and none of its own pictures."""
    returned: list[int] = []
    monkeypatch.setattr(title_page, "return_freed_blocks", lambda: returned.append(surfaces.bytes))
    page = surfaces.cached(lambda number: pygame.Surface((1920, 1080), depth=32))
    for number in range(12):
        page(number)
    arcade.wait(0.5, draw=True)
    assert surfaces.bytes > surface_cache.RESTING
    assert returned == []
    arcade.wait(1.0, draw=True)
    assert returned[0] <= surface_cache.RESTING
    assert surfaces.bytes < returned[0] + (2 << 20), "nothing large had to be painted again"
    arcade.wait(2.0, draw=True)
    assert len(returned) == 1
    arcade.stack.apply(Push(Floor()))
    arcade.stack.apply(Pop())
    arcade.wait(1.5, draw=True)
    assert len(returned) == 2


def test_the_title_drops_pictures_that_were_interrupted_on_other_pages(arcade: Arcade) -> None:
    sheets: list[weakref.ref[pygame.Surface]] = []

    @resumable
    def painted(number: int) -> Steps[None]:
        sheet = pygame.Surface((64, 64))
        sheets.append(weakref.ref(sheet))
        yield
        yield

    budget.note()
    with pytest.raises(Unfinished), budget.until(0.0):
        painted(1)
    assert sheets[0]()
    arcade.wait(1.5, draw=True)
    assert sheets[0]() is None
    painted(1)
    assert len(sheets) == 2, "it began anew"


@pytest.mark.long
@pytest.mark.parametrize("game", repeated(games()))
def test_no_sprite_of_a_match_is_ever_made_twice(arcade: Arcade, game: str, monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[tuple[int, Hashable]] = []
    keep = SurfaceCache._insert

    def noted(cache: SurfaceCache, entry: CacheEntry) -> None:
        made.append((id(entry.table), entry.key))
        keep(cache, entry)

    monkeypatch.setattr(SurfaceCache, "_insert", noted)
    warmed(arcade, game)
    assert len(made) == len(set(made)) > 2000
    assert surfaces.bytes <= surface_cache.BUDGET


@pytest.mark.long
@pytest.mark.again
def test_two_thousand_random_presses_stay_within_the_budget(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    monkeypatch.setattr(surfaces, "budget", 64 << 20)
    rng, used = random.Random(5), [0]

    def over() -> bool:
        used.append(surfaces.bytes)
        press(rng, 40)
        return len(used) > 50

    assert run(Options(headless=True, kiosk=True, step=0.1, should_close=over)) == 0
    pygame.display.quit()
    assert len(used) > 50
    assert 40 << 20 < max(used) <= surfaces.budget
    assert not (tmp_path / "data" / "pigaming.log").read_text()


class Leaving(Floor):
    """A scene in a reference cycle that leaves the stack in its third frame."""

    def __init__(self, turn: StackOperation) -> None:
        self.turn, self.frames = turn, 0
        self.cycle = lambda: self.turn

    def update(self, seconds: float) -> StackOperation:
        self.frames += 1
        return self.cycle() if self.frames == 3 else None

    def draw(self, screen: pygame.Surface) -> None:
        screen.fill("black")


@pytest.mark.parametrize(
    "turn", [Pop(), Home(), Swap(Leaving(None)), Home(Leaving(None))], ids=["pop", "home", "swap", "home and on"]
)
def test_a_scene_that_has_left_is_freed_in_the_next_frame(
    turn: StackOperation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    scenes: list[weakref.ref[Leaving]] = []
    alive: list[bool] = []

    def first(context: Context) -> Leaving:
        gc.disable()
        scene = Leaving(turn)
        scenes.append(weakref.ref(scene))
        return scene

    def over() -> bool:
        alive.append(scenes[0]() is not None)
        return len(alive) == 5

    try:
        run(Options(headless=True, first_scene=first, step=0.1, should_close=over))
    finally:
        gc.enable()
        pygame.display.quit()
    assert alive == [True, True, True, False, False]


@pytest.mark.again
@pytest.mark.long
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="counts the files of /proc")
@pytest.mark.parametrize(("presses", "each"), [(700, 1), (10_000, 12)])
def test_open_files_threads_and_memory_stay_level_over_presses_on_all_screens(presses: int, each: int) -> None:
    command = [sys.executable, "-m", "tests.bench.presses", str(presses), str(each)]
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True)
    assert done.returncode == 0, done.stdout
    assert done.stdout.count("Usage") >= 3
