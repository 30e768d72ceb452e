"""The AIs of PiTanks by name: by hand, from tables, from networks. The five levels: one network with handicaps.

The levels are set against models of people (`ai/people`). All see others late and beside where they are, and go for one
opponent after the other, so that they hunt nobody; weaker ones save more shots, and the weakest drive more slowly than
people. Shooting less rather than driving slowly is what makes a level easy without making it prey for whoever stands
and holds FIRE. No level skips decisions, which would look like a machine that hangs. `net` is another network, which
continued that one against itself: no person beats it, and a network that has studied it hardly does.
"""

from pigaming_app.ai.game_ai import LEVELS as NAMES
from pigaming_app.ai.game_ai import GameAI, Gun
from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.pitanks import classic, fsm, gunner
from pigaming_app.ai.qlearning import table_files

NETWORK, CHAMPION = "pitanks", "champion"  # files in assets/brains: of the levels, and of `net`
TURNS = 6.0  # s
HANDICAPS = tuple(
    {"delay": 0.4, "error": 0.3, "thrift": thrift, "speed": speed, "reluctance": reluctance, "turns": TURNS}
    for thrift, speed, reluctance in (
        (1.0, 0.65, 3.8),
        (1.0, 0.95, 2.7),
        (0.94, 0.95, 0.7),
        (0.78, 1.0, 0.5),
        (0.66, 1.0, 0.0),
    )
)
EASIEST, HARDEST = (
    shipped_brain(name, "pitanks", NETWORK, handicap={**handicap, "turns": TURNS})
    for name, handicap in {
        "easiest": {"delay": 0.4, "error": 0.25, "thrift": 1.0, "speed": 0.4, "reluctance": 11.0},
        "hardest": {"delay": 0.0, "error": 0.0, "thrift": 0.1, "speed": 1.0, "reluctance": -11.0},
    }.items()
)
LEVELS = tuple(
    shipped_brain(f"level{number}", "pitanks", NETWORK, handicap=handicap)
    for number, handicap in enumerate(HANDICAPS, start=1)
)
NET = shipped_brain("net", "pitanks", CHAMPION, handicap={"sharpness": 3.0})

AI = GameAI(
    {
        **{kind.name: kind for kind in (gunner.HAND1, gunner.HAND2, gunner.HAND3, fsm.FSM, classic.CLASSIC)},
        "q1": table_files.shipped_brain("q1"),
        "q2": table_files.shipped_brain("q2"),
        "net": NET,
        **{level.name: level for level in LEVELS},
    },
    rivals=(*NAMES, "q1", "q2", "fsm", "classic"),
    auto=(EASIEST, HARDEST),
    person=gunner.person,
    gun=Gun(gunner.recall, gunner.sight),
    chauffeur="net",
)
