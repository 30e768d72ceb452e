"""Frame-time benchmark: a game's busiest match on an invisible display.

Two hundred particles are kept alive, and every number of the match changes.
"""

from collections.abc import Callable
from time import perf_counter
from typing import Any, Protocol

import pygame

from pigaming_app.ai.registry import new_match
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.views.benchmark import pitanks as busy
from pigaming_app.scenes.views.benchmark import race as race_busy
from pigaming_app.scenes.views.registry import VIEWS
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import DT
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


class BusyFactory:
    """Factory match with eight pallets per team and frantic drivers; one robot is always frozen."""

    def __init__(self) -> None:
        rules = games()["factory"].default
        one, two, three, four = (Seat("hard", team) for team in rules.teams)
        setup = Setup("factory", arenas("factory")[0], (one, two, three, four), 8.0, 1, "standard", max(rules.goals))
        self.match = new_match(setup)
        self.arena, self.state = self.match.arena, self.match.state

    def tick(self) -> None:
        self.match.tick()
        frozen = self.state.loads[3]
        frozen.frozen = frozen.frozen or self.state.rules.freeze


BUSY: dict[str, Callable[[], BenchmarkMatch]] = {
    "pitanks": lambda: busy.BusyPiTanks(party=True),
    "factory": BusyFactory,
    "race": lambda: race_busy.BusyRace(laps=max(games()["race"].default.goals)),
}


def frame_times(game: str, frames: int) -> list[float]:
    """Times of `frames` warm frames at 60 per second, ms. The caller has selected the dummy video driver."""
    pygame.display.init()
    pygame.font.init()
    screen = pygame.display.set_mode((1920, 1080))
    scene = BUSY[game]()
    view = VIEWS[game](scene.arena, scene.state, ["human", "human", "easy", "hard"], busy.AllEffects(), Words("en"))
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
