"""The AIs of Robot Football."""

from pigaming_app.ai.game_ai import RANDOM_ONLY

AI = RANDOM_ONLY
