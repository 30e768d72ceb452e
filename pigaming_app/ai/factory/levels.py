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
        make_reset(speed=0.73, hesitation=0.45, noise=0.2, delay=0.4, slip=0.05, rules=1, form=0.35, start=12.0),
    ),
    BrainKind(
        "level2",
        PlannerMind,
        think,
        make_reset(speed=0.8, hesitation=0.22, noise=0.1, delay=0.3, rules=1, form=0.35, start=10.0),
    ),
    BrainKind(
        "level3",
        PlannerMind,
        think,
        make_reset(speed=0.865, hesitation=0.1, noise=0.05, delay=0.2, rules=1, form=0.3, start=8.0),
    ),
    BrainKind("level4", PlannerMind, think, make_reset(speed=0.93, delay=0.15, form=0.2, start=4.8)),
    BrainKind("level5", PlannerMind, think, make_reset()),
)
