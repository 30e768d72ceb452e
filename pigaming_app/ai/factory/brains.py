"""The AIs of Robot Factory by name. The five levels: one planner, five pairs of hands.

They differ in numbers, never in rules: the lower ones drive more slowly, warm up in the first minute, pause longer
after each job, misjudge schedules, see others later, and now and then set out the wrong way. `form` makes a level
better in one match than in another, as with people.
"""

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.factory import foreman
from pigaming_app.ai.factory.job_choice import PlannerMind
from pigaming_app.ai.factory.planner import make_reset, think
from pigaming_app.ai.game_ai import GameAI

LEVELS: tuple[BrainKind, ...] = (
    BrainKind(
        "level1",
        PlannerMind,
        think,
        make_reset(
            speed=0.945, hesitation=0.23, noise=0.12, delay=0.4, slip=0.04, rules=1, form=0.3, start=6.5, warm_up=0.78
        ),
    ),
    BrainKind(
        "level2",
        PlannerMind,
        think,
        make_reset(speed=0.95, hesitation=0.12, noise=0.06, delay=0.3, rules=1, form=0.3, start=6.0, warm_up=0.68),
    ),
    BrainKind(
        "level3",
        PlannerMind,
        think,
        make_reset(speed=0.97, hesitation=0.04, noise=0.02, delay=0.2, rules=2, form=0.27, start=5.0, warm_up=0.54),
    ),
    BrainKind("level4", PlannerMind, think, make_reset(speed=0.995, delay=0.1, form=0.2, start=3.0, warm_up=0.34)),
    BrainKind("level5", PlannerMind, think, make_reset()),
)

AI = GameAI({kind.name: kind for kind in (foreman.HAND1, foreman.HAND2, foreman.HAND3, *LEVELS)})
