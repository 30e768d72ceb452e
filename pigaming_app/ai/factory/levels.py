"""The five levels of Robot Factory: one planner, five pairs of hands.

They differ in numbers, never in rules: the lower ones drive more slowly, pause longer after each job, misjudge
schedules, see others later, and now and then set out the wrong way. `form` makes a level better in one match than in
another, as with people.
"""

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.factory.planner import PlannerMind, make_reset, think

LEVELS: tuple[BrainKind, ...] = (
    BrainKind(
        "level1",
        PlannerMind,
        think,
        make_reset(speed=0.55, hesitation=2.0, noise=0.8, delay=0.4, dash=0, slip=0.2, rules=1, form=0.1),
    ),
    BrainKind(
        "level2",
        PlannerMind,
        think,
        make_reset(speed=0.65, hesitation=1.2, noise=0.5, delay=0.3, dash=0, slip=0.1, rules=1, form=0.1),
    ),
    BrainKind(
        "level3",
        PlannerMind,
        think,
        make_reset(speed=0.78, hesitation=0.7, noise=0.3, delay=0.25, dash=0, slip=0.0, rules=1, form=0.1),
    ),
    BrainKind(
        "level4",
        PlannerMind,
        think,
        make_reset(speed=0.9, hesitation=0.3, noise=0.15, delay=0.2, dash=1, slip=0.0, rules=1, form=0.05),
    ),
    BrainKind("level5", PlannerMind, think, make_reset()),
)
