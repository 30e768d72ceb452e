"""The AIs of Robot Football: one footballer in five levels, which differ in speed, reaction time and aim."""

from typing import Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.game_ai import LEVELS, GameAI
from pigaming_app.sim.rng import seeded

from .footballer import think
from .mind import PERIOD, Mind
from .thoughts import explain

# Share of full speed, ticks between looks at the ball, standard deviation of the aim (rad), turbo, passes.
STRENGTHS = (
    (0.50, 40, 0.26, 0, 0),
    (0.60, 28, 0.18, 0, 0),
    (0.70, 18, 0.12, 0, 1),
    (0.80, 12, 0.08, 1, 1),
    (0.90, 6, 0.05, 1, 1),
)


def _reset(speed: float, reaction: int, error: float, turbo: int, plays: int) -> Any:
    """A `reset` for a level."""

    def fill(mind: Mind, seed: int) -> None:
        mind.speed, mind.reaction, mind.error, mind.turbo, mind.plays = speed, reaction, error, turbo, plays
        mind.random = seeded(seed)
        mind.phase = mind.random % PERIOD

    return fill


def _footballer(name: str, strength: int) -> BrainKind:
    """A footballer of strength 0..4."""
    return BrainKind(name, Mind, think, _reset(*STRENGTHS[strength]), explain=explain)


AI = GameAI(
    {
        **{name: _footballer(name, strength) for strength, name in enumerate(LEVELS)},
        **{f"hand{i + 1}": _footballer(f"hand{i + 1}", strength) for i, strength in enumerate((0, 2, 4))},
    }
)
