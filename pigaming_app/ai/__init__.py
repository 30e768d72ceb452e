"""Who plays when nobody does, and the only list of them."""

from pigaming_app.ai import fsm, simple
from pigaming_app.ai.brain import Kind, Thinker

BRAINS: dict[str, dict[str, Kind]] = {
    "pitanks": {
        "idle": simple.IDLE,
        "random": simple.RANDOM,
        "easy": fsm.EASY,
        "normal": fsm.NORMAL,
        "hard": fsm.HARD,
        "fsm": fsm.FSM,
    },
}

STRENGTHS = ("easy", "normal", "hard")


def make(game: str, name: str, seed: int) -> Thinker:
    """A brain of a game by its name. Raises KeyError where there is none."""
    return Thinker(BRAINS[game][name], seed)
