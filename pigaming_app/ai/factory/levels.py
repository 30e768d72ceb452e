"""The five levels of Robot Factory: one planner, five pairs of hands.

They differ in numbers, never in rules: the lower ones drive more slowly, warm up in the first minute, pause longer
after each job, misjudge schedules, see others later, and now and then set out the wrong way. `form` makes a level
better in one match than in another, as with people.
"""

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.factory.planner import PlannerMind, make_reset, think

LEVELS: tuple[BrainKind, ...] = (
    BrainKind(
        "level1",
        PlannerMind,
        think,
        make_reset(
            speed=0.785, hesitation=0.36, noise=0.18, delay=0.4, slip=0.05, rules=1, form=0.3, start=6.0, warm_up=0.53
        ),
    ),
    BrainKind(
        "level2",
        PlannerMind,
        think,
        make_reset(speed=0.83, hesitation=0.18, noise=0.1, delay=0.3, rules=1, form=0.3, start=5.0, warm_up=0.44),
    ),
    BrainKind(
        "level3",
        PlannerMind,
        think,
        make_reset(speed=0.9, hesitation=0.07, noise=0.04, delay=0.2, rules=1, form=0.25, start=4.0, warm_up=0.34),
    ),
    BrainKind("level4", PlannerMind, think, make_reset(speed=0.955, delay=0.15, form=0.15, start=3.0, warm_up=0.2)),
    BrainKind("level5", PlannerMind, think, make_reset()),
)
