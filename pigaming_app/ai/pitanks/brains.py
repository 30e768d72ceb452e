"""The AIs of PiTanks by name: by hand, from tables, from a network."""

from dataclasses import replace

from pigaming_app.ai.game_ai import LEVELS, GameAI
from pigaming_app.ai.pitanks import classic, classic_thoughts, fsm, fsm_thoughts, gunner, gunner_thoughts, levels
from pigaming_app.ai.qlearning import table_files

AI = GameAI(
    {
        "hand1": replace(gunner.HAND1, explain=gunner_thoughts.explain),
        "hand2": replace(gunner.HAND2, explain=gunner_thoughts.explain),
        "hand3": replace(gunner.HAND3, explain=gunner_thoughts.explain),
        "fsm": replace(fsm.FSM, explain=fsm_thoughts.explain),
        "classic": replace(classic.CLASSIC, explain=classic_thoughts.explain),
        "q1": table_files.shipped_brain("q1"),
        "q2": table_files.shipped_brain("q2"),
        "net": levels.NET,
        **{level.name: level for level in levels.LEVELS},
    },
    rivals=(*LEVELS, "q1", "q2", "fsm", "classic"),
)
