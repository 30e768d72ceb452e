"""Frame-time benchmark: a game's busiest match on an invisible display.

Two hundred particles are kept alive, and every number of the match changes.
"""

from collections.abc import Callable
from time import perf_counter
from typing import Any, Protocol

import pygame

from pigaming_app.ai.registry import new_match
from pigaming_app.games.arenas import arenas
from pigaming_app.games.factory.state import OUTPUT
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.views.benchmark import pitanks as busy
from pigaming_app.scenes.views.benchmark import race as race_busy
from pigaming_app.scenes.views.registry import VIEWS
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import DT, HZ
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
    """Factory match with as many pallets as possible and frantic drivers. One robot is always frozen, every output
    counts down, and in party every second order is a rush order.
    """

    def __init__(self, variant: str) -> None:
        rules = games()["factory"].variants[variant]
        one, two, three, four = (Seat("hard", team) for team in rules.teams)
        goal = max(rules.goals, default=0)
        setup = Setup("factory", arenas("factory")[0], (one, two, three, four), 8.0, 1, variant, goal)
        self.match = new_match(setup)
        self.arena, self.state = self.match.arena, self.match.state

    def tick(self) -> None:
        self.match.tick()
        state = self.state
        frozen = state.loads[3]
        frozen.frozen = frozen.frozen or state.rules.freeze
        for slot in state.slots[: state.slot_count]:
            if slot.pallet and slot.kind == OUTPUT:
                pallet = state.pallets[slot.pallet - 1]
                pallet.waited = max(pallet.waited, state.rules.collect - 10 * HZ)
        if state.rules.party:
            for pallet in state.pallets[::2]:
                pallet.rush = pallet.rush or int(pallet.exists) * state.rules.rush


BUSY: dict[str, Callable[[str], BenchmarkMatch]] = {
    "pitanks": lambda variant: busy.BusyPiTanks(variant=variant),
    "factory": BusyFactory,
    "race": lambda variant: race_busy.BusyRace(laps=max(games()["race"].variants[variant].goals), variant=variant),
}


def frame_times(game: str, variant: str, frames: int) -> list[float]:
    """Times of `frames` warm frames at 60 per second, ms. The caller has selected the dummy video driver."""
    pygame.display.init()
    pygame.font.init()
    screen = pygame.display.set_mode((1920, 1080))
    scene = BUSY[game](variant)
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
