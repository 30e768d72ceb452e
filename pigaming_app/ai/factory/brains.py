"""The AIs of Robot Factory by name, and the driving styles with steering help.

The five levels: one planner, five pairs of hands, set against models of people.

They differ in numbers, never in rules: the lower ones drive more slowly, warm up in the first minute, pause longer
after each job, misjudge schedules, see others later, and now and then set out the wrong way. `form` makes a level
better in one match than in another, as with people. `planner` is the same without any of it. `net` is a network that
learned against the planner and itself.
"""

from functools import partial

from pigaming_app.ai.brain.driving import helped, point_where_to_go, turn_and_drive
from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.factory import foreman
from pigaming_app.ai.factory.job_choice import PlannerMind
from pigaming_app.ai.factory.planner import make_reset, think
from pigaming_app.ai.factory.steering_help import HELP, Guide
from pigaming_app.ai.game_ai import HELPED_POINT, HELPED_TURN, ONE_BUTTON, POINT, TURN, GameAI
from pigaming_app.ai.game_ai import LEVELS as NAMES
from pigaming_app.ai.networks.files import shipped_brain

weaker = partial(make_reset, form=0.3, start=6.5, warm_up=0.3)
STRENGTHS = (
    weaker(speed=0.36, hesitation=3.3, noise=0.3, delay=0.4, slip=0.04, rules=1),
    weaker(speed=0.39, hesitation=2.6, noise=0.2, delay=0.4, slip=0.04, rules=1),
    weaker(speed=0.43, hesitation=2.0, noise=0.2, delay=0.4, slip=0.04, rules=1),
    weaker(speed=0.5, hesitation=1.5, noise=0.12, delay=0.3, slip=0.02, rules=2),
    weaker(form=0.12, speed=0.605, hesitation=0.9, noise=0.06, delay=0.2, rules=2),
)
EASIEST = weaker(speed=0.26, hesitation=5.0, noise=0.35, delay=0.45, slip=0.03, rules=2)
HARDEST = weaker(speed=1.0, hesitation=0.0, noise=0.0, delay=0.1, slip=0.0, rules=2)
LEVELS = tuple(BrainKind(f"level{n}", PlannerMind, think, reset) for n, reset in enumerate(STRENGTHS, start=1))
PLANNER = BrainKind("planner", PlannerMind, think, make_reset())
NET = shipped_brain("net", "factory", "factory", handicap={"sharpness": 3.0})
GUIDE = Guide()

AI = GameAI(
    {kind.name: kind for kind in (foreman.HAND1, foreman.HAND2, foreman.HAND3, PLANNER, NET, *LEVELS)},
    rivals=(*NAMES, "net"),
    driving={
        TURN: turn_and_drive,
        POINT: point_where_to_go,
        HELPED_TURN: helped(turn_and_drive, GUIDE.helped_stick),
        HELPED_POINT: helped(point_where_to_go, GUIDE.helped_stick),
        ONE_BUTTON: turn_and_drive,
    },
    auto=(BrainKind("easiest", PlannerMind, think, EASIEST), BrainKind("hardest", PlannerMind, think, HARDEST)),
    person=foreman.person,
    help=HELP,
    chauffeur="planner",
)
