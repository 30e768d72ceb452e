"""Calm mode: nothing in a match at peak load flashes more than three times a second, and nothing shakes."""

import numpy as np
import pygame
import pytest

from pigaming_app.games.registry import games
from pigaming_app.scenes.bench.frame_times import busy_match
from pigaming_app.scenes.views.particles import CALM_BURSTS, Particles
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.scenes.views.view import ShownEffects
from pigaming_app.sim.world import DT
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import Words
from tests.cases import repeated
from tests.scenes.views.flashing import CELL, Cells, luminance, most_flashes

RATE = 25.0  # pictures a second: each second tick
SECONDS = 4.0
WHITE, GREY = np.ones((2, 2)), np.full((2, 2), 0.05)


def filmed(game: str, variant: str, calm: bool) -> list[Cells]:
    """The cells of a match at peak load, after its first second."""
    pygame.display.init()
    screen = pygame.display.set_mode((1920, 1080))
    scene = busy_match(game, variant)
    effects = ShownEffects(Settings(calm=calm))
    view = SCREENS[game].view(scene.arena, scene.state, ["human", "human", "level1", "level5"], effects, Words("en"))
    film = []
    for picture in range(int((1.0 + SECONDS) * RATE)):
        for _ in range(round(1.0 / RATE / DT)):
            scene.tick()
            view.watch(scene.state)
        view.draw(screen, scene.state, 1.0, 1.0 / RATE)
        assert not calm or view.particles.offset == (0, 0), "shakes"
        if picture >= RATE:
            film.append(luminance(screen))
    return film


@pytest.mark.long
@pytest.mark.parametrize("game", repeated(games()))
def test_nothing_flashes_more_than_three_times_a_second_in_calm_mode(game: str) -> None:
    for variant in games()[game].variants:
        assert most_flashes(filmed(game, variant, calm=True), RATE) <= 3, variant


@pytest.mark.long
def test_without_calm_mode_hits_flash_more_often() -> None:
    assert most_flashes(filmed("pitanks", "pickups", calm=False), RATE) > 3


def test_flashes_are_counted() -> None:
    slow = ([GREY] * 5 + [WHITE] * 5) * 5  # 2.5 a second
    fast = ([GREY] * 2 + [WHITE] * 2) * 10
    assert most_flashes(slow, RATE) <= 3 < most_flashes(fast, RATE)
    assert most_flashes([GREY * (1 + 0.2 * (i % 2)) for i in range(50)], RATE) == 0, "too weak"
    assert most_flashes([WHITE * min(1.0, i / 50) for i in range(60)], RATE) == 0, "only brighter"


def test_the_luminance_is_that_of_the_cells() -> None:
    picture = pygame.Surface((4 * CELL, 2 * CELL))
    picture.fill("white", (0, 0, CELL, CELL))
    cells = luminance(picture)
    assert cells.shape == (4, 2)
    assert cells[0, 0] == pytest.approx(1.0, abs=0.1)
    assert cells[2, 1] == 0.0


def test_calm_mode_takes_precedence_over_the_other_settings() -> None:
    settings = Settings(flashes="full", shake=True)
    effects = ShownEffects(settings)
    assert (effects.flashes, effects.shake) == ("full", True)
    settings.calm = True
    assert (effects.flashes, effects.shake) == ("off", False)


def test_only_so_many_bursts_begin_in_a_second_in_calm_mode() -> None:
    for calm in (False, True):
        particles, seen = Particles(calm), 0
        for _ in range(20):
            before = len(particles.particles)
            particles.burst(100, 100, (255, 0, 0), 3, 4, 50)
            particles.burst(300, 100, (255, 0, 0), 3, 4, 50)  # the same event
            seen += (len(particles.particles) - before) // 6
            particles.clock += 0.04
        assert seen == (CALM_BURSTS if calm else 20)
