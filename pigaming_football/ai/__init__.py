"""The AIs of Robot Football: one footballer in five levels and as `hand1` to `hand3`, and a network."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pigaming_app.api.brains import BrainKind, GameAI, levels
from pigaming_app.api.networks import shipped_brain
from pigaming_app.api.rules import HZ

from .footballer import think
from .mind import PERIOD, Mind
from .thoughts import explain


@dataclass(frozen=True)
class Strength:
    """What makes a footballer weaker than it could be."""

    speed: float  # share of full speed
    reaction: float  # ticks between looks at the ball
    error: float  # rad, standard deviation of the aim
    turbo: bool  # whether it uses the turbo
    passes: bool  # and leaves one back
    haste: float = 0.0  # share of the time in which it goes straight at the ball, and shoots wherever it looks


HANDS = (
    Strength(0.50, 40, 0.26, turbo=False, passes=False),
    Strength(0.70, 18, 0.12, turbo=False, passes=True),
    Strength(0.90, 6, 0.05, turbo=True, passes=True),
)
STRENGTHS = (
    Strength(0.86, 33, 0.32, turbo=False, passes=False, haste=0.85),
    Strength(0.88, 24, 0.20, turbo=False, passes=False, haste=0.7),
    Strength(0.88, 22, 0.20, turbo=False, passes=False, haste=0.25),
    Strength(0.86, 22, 0.19, turbo=False, passes=True, haste=0.2),
    Strength(0.86, 16, 0.15, turbo=False, passes=True),
)


EASIEST = Strength(0.08, 90, 1.3, turbo=True, passes=True, haste=0.3)
HARDEST = Strength(1.0, 5, 0.04, turbo=True, passes=True)


def _footballer(name: str, strength: Strength) -> BrainKind:
    """A footballer of a strength."""

    def reset(mind: Mind, seed: int) -> None:
        mind.phase = mind.random % PERIOD
        mind.speed, mind.haste = strength.speed, strength.haste
        mind.reaction, mind.error = strength.reaction, strength.error
        mind.turbo, mind.plays = int(strength.turbo), int(strength.passes)

    return BrainKind(name, Mind, think, reset, explain=explain)


def person(traits: Any) -> BrainKind:
    """What a person of certain `Traits` sees and wants: at full stick, and the hastier the less it knows."""
    reaction, haste = round(traits.reaction * HZ), 0.3 * (1.0 - traits.tactics)
    return _footballer("person", Strength(1.0, reaction, 2.0 * traits.aim, traits.turbo, traits.tactics > 0.5, haste))


NET = shipped_brain("net", "football", "champion", Path(__file__).parents[1] / "brains", {"sharpness": 2.0})

AI = GameAI(
    {
        **levels(*(_footballer("", strength) for strength in STRENGTHS)),
        **{f"hand{i}": _footballer(f"hand{i}", strength) for i, strength in enumerate(HANDS, start=1)},
        "net": NET,
    },
    rivals=("level1", "level2", "level3", "level4", "level5", "net"),
    auto=(_footballer("easiest", EASIEST), _footballer("hardest", HARDEST)),
    person=person,
    chauffeur="net",
)
