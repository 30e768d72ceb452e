"""The AIs of Robot Football: one footballer in five levels and as `hand1` to `hand3`, and a network."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pigaming_app.api.brains import BrainKind, GameAI, levels
from pigaming_app.api.networks import shipped_brain
from pigaming_app.api.rules import HZ, uniform

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
    passes: bool
    form: float = 0.0  # share of its speed that it lacks at most, on a bad day; drawn for each match


HANDS = (
    Strength(0.50, 40, 0.26, turbo=False, passes=False),
    Strength(0.70, 18, 0.12, turbo=False, passes=True),
    Strength(0.90, 6, 0.05, turbo=True, passes=True),
)
STRENGTHS = (
    Strength(0.255, 55, 0.45, turbo=False, passes=False, form=0.4),
    Strength(0.4, 50, 0.40, turbo=False, passes=False, form=0.55),
    Strength(0.485, 45, 0.35, turbo=False, passes=False, form=0.5),
    Strength(0.58, 38, 0.28, turbo=False, passes=True, form=0.5),
    Strength(0.64, 34, 0.22, turbo=False, passes=True, form=0.45),
)


EASIEST = Strength(0.08, 90, 1.3, turbo=True, passes=True, form=0.4)
HARDEST = Strength(1.0, 5, 0.04, turbo=True, passes=True, form=0.01)


def _footballer(name: str, strength: Strength) -> BrainKind:
    """A footballer of a strength."""

    def reset(mind: Mind, seed: int) -> None:
        mind.phase = mind.random % PERIOD
        mind.speed = strength.speed * (1.0 - strength.form * uniform(mind)) if strength.form else strength.speed
        mind.reaction, mind.error = strength.reaction, strength.error
        mind.turbo, mind.plays = int(strength.turbo), int(strength.passes)

    return BrainKind(name, Mind, think, reset, explain=explain)


def person(traits: Any) -> BrainKind:
    """What a person of certain `Traits` sees and wants."""
    reaction, pace = round(traits.reaction * HZ), 0.36 + 0.21 * traits.tactics
    return _footballer("person", Strength(pace, reaction, 2.0 * traits.aim, traits.turbo, traits.tactics > 0.5))


NET = shipped_brain("net", "football", "football", Path(__file__).parents[1] / "brains", {"sharpness": 2.0})

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
