"""What the seed of the next match deals, on the preview before it: starts, and in a race the lines."""

from functools import lru_cache
from typing import Any

from pigaming_app.games.game import Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.views.preview import fitted
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.ui.draw import GlowCanvas
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.sprites import Sprite
from pigaming_app.ui.draw.surface_cache import cached

GLOW = 0.6


@lru_cache(maxsize=16)
def first_state(setup: Setup) -> Any:
    """A match before its first tick."""
    rules, state = games()[setup.game], games()[setup.game].state()
    rules.start(state, load_cached(setup.game, setup.arena), setup)
    return state


def start_positions(setup: Setup) -> list[tuple[float, float]]:
    """Start positions of the robots in a match, px."""
    return [(robot.x, robot.y) for robot in first_state(setup).robots]


@cached
@resumable
def deal(setup: Setup, w: int, h: int) -> Steps[Sprite]:
    """What covers the preview of w x h px in a match."""
    ink = GlowCanvas(w, h, 3)
    left, top, k = fitted(w, h)
    SCREENS[setup.game].deal(
        ink.set_transform(left, top, 0.0, k), load_cached(setup.game, setup.arena), first_state(setup)
    )
    yield
    return Sprite((yield from ink.sprite_steps(GLOW)), 0, 0)
