"""The five levels of Robot Factory: one planner, five pairs of hands."""

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.factory.planner import PlannerMind, make_reset, think

LEVELS: tuple[BrainKind, ...] = tuple(
    BrainKind(f"level{number}", PlannerMind, think, make_reset(**strength))
    for number, strength in enumerate(
        (
            dict(speed=0.55, hesitation=2.0, noise=0.8, delay=0.4, dash=0, slip=0.2, rules=1, form=0.1),
            dict(speed=0.65, hesitation=1.2, noise=0.5, delay=0.3, dash=0, slip=0.1, rules=1, form=0.1),
            dict(speed=0.78, hesitation=0.7, noise=0.3, delay=0.25, dash=0, slip=0.0, rules=1, form=0.1),
            dict(speed=0.9, hesitation=0.3, noise=0.15, delay=0.2, dash=1, slip=0.0, rules=1, form=0.05),
            dict(speed=1.0, hesitation=0.0, noise=0.0, delay=0.1, dash=1, slip=0.0, rules=3, form=0.0),
        ),
        start=1,
    )
)
