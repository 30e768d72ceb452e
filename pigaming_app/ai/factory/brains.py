"""The AIs of Robot Factory by name."""

from pigaming_app.ai.factory import foreman, levels
from pigaming_app.ai.game_ai import GameAI

AI = GameAI({kind.name: kind for kind in (foreman.HAND1, foreman.HAND2, foreman.HAND3, *levels.LEVELS)})
