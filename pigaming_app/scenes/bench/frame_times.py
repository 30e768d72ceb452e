"""Frame-time benchmark: a game's busiest match on an invisible display.

Two hundred particles are kept alive, and every number of the match changes.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from time import perf_counter
from typing import Any, Protocol

import pygame

from pigaming_app.games.registry import OURS
from pigaming_app.scenes.bench.busy_drivers import BusyDrivers
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import DT
from pigaming_app.storage.optional import optional
from pigaming_app.ui.i18n import Words

PARTICLES = 200
FPS = 60
FIRST = 60  # warm-up frames, not counted


class BenchmarkMatch(Protocol):
    """A match or a synthetic replacement."""

    arena: Arena
    state: Any

    def tick(self) -> None:
        """Advance by 1/50 s."""


@dataclass
class AllEffects:
    """View options with every effect on."""

    flashes: str = "full"
    shake: bool = True
    calm: bool = False


BUSY: dict[str, Callable[..., BenchmarkMatch]] = {
    game: room.BUSY for game in OURS if (room := optional(f"scenes.bench.busy_{game}"))
}  # by game; each takes the `variant`


def busy_match(game: str, variant: str) -> BenchmarkMatch:
    """The most laborious match of a game."""
    return BUSY.get(game, partial(BusyDrivers, game))(variant=variant)


def frame_times(game: str, variant: str, frames: int) -> list[float]:
    """Times of `frames` warm frames at 60 per second, ms. The caller has selected the dummy video driver."""
    pygame.display.init()
    pygame.font.init()
    screen = pygame.display.set_mode((1920, 1080))
    scene = busy_match(game, variant)
    view = SCREENS[game].view(
        scene.arena, scene.state, ["human", "human", "level1", "level5"], AllEffects(), Words("en")
    )
    while not view.prewarm(1000.0):
        pass
    times, owed = [], 0.0
    for frame in range(frames + FIRST):
        owed += 1 / FPS
        while owed >= DT:
            scene.tick()
            view.watch(scene.state)
            owed -= DT
        missing = PARTICLES - len(view.particles.particles)
        if missing > 0:
            view.particles.burst(960, 540, (60, 160, 255), missing, 40, 300)
        began = perf_counter()
        view.draw(screen, scene.state, owed / DT, 1 / FPS)
        if frame >= FIRST:
            times.append(1000.0 * (perf_counter() - began))
    return times
