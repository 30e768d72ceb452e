"""The AIs of PiTanks by name: by hand, from tables, from a network. The five levels: one network with handicaps.

All levels see others late and beside where they are, as people do. Weaker levels drive more slowly and save more shots,
as beginners do. The two weakest go for one opponent after the other, so that they hunt nobody. No level skips
decisions, which would look like a machine that hangs. The network alone is `net`: no person beats it.
"""

from pigaming_app.ai.game_ai import LEVELS as NAMES
from pigaming_app.ai.game_ai import GameAI
from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.pitanks import classic, fsm, gunner
from pigaming_app.ai.qlearning import table_files

NETWORK = "pitanks"  # file in assets/brains
TURNS = 6.0  # s
HANDICAPS = (
    {"delay": 0.4, "error": 0.3, "thrift": 0.586, "speed": 0.4, "turns": TURNS},
    {"delay": 0.4, "error": 0.3, "thrift": 0.535, "speed": 0.528, "turns": TURNS},
    {"delay": 0.4, "error": 0.3, "thrift": 0.508, "speed": 0.668},
    {"delay": 0.39, "error": 0.3, "thrift": 0.489, "speed": 0.832},
    {"delay": 0.38, "error": 0.3, "thrift": 0.476, "speed": 0.995},
)
LEVELS = tuple(
    shipped_brain(f"level{number}", "pitanks", NETWORK, handicap=handicap)
    for number, handicap in enumerate(HANDICAPS, start=1)
)
NET = shipped_brain("net", "pitanks", NETWORK)

AI = GameAI(
    {
        **{kind.name: kind for kind in (gunner.HAND1, gunner.HAND2, gunner.HAND3, fsm.FSM, classic.CLASSIC)},
        "q1": table_files.shipped_brain("q1"),
        "q2": table_files.shipped_brain("q2"),
        "net": NET,
        **{level.name: level for level in LEVELS},
    },
    rivals=(*NAMES, "q1", "q2", "fsm", "classic"),
)
