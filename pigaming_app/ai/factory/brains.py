"""The AIs of Robot Factory by name."""

from dataclasses import replace

from pigaming_app.ai.factory import foreman, foreman_thoughts, levels
from pigaming_app.ai.game_ai import GameAI

AI = GameAI(
    {
        kind.name: replace(kind, explain=foreman_thoughts.explain)
        for kind in (foreman.HAND1, foreman.HAND2, foreman.HAND3, *levels.LEVELS)
    }
)
