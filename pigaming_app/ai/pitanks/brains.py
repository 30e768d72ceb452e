"""The AIs of PiTanks by name: by hand, from tables, from a network."""

from pigaming_app.ai.game_ai import LEVELS, GameAI
from pigaming_app.ai.pitanks import classic, fsm, gunner, levels
from pigaming_app.ai.qlearning import table_files

AI = GameAI(
    {
        **{kind.name: kind for kind in (gunner.HAND1, gunner.HAND2, gunner.HAND3, fsm.FSM, classic.CLASSIC)},
        "q1": table_files.shipped_brain("q1"),
        "q2": table_files.shipped_brain("q2"),
        "net": levels.NET,
        **{level.name: level for level in levels.LEVELS},
    },
    rivals=(*LEVELS, "q1", "q2", "fsm", "classic"),
)
