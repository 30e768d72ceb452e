"""The AIs of Robot Race by name, and the driving styles with steering help."""

from pigaming_app.ai.brain.driving import point_where_to_go, turn_and_drive
from pigaming_app.ai.game_ai import HELPED_POINT, HELPED_TURN, ONE_BUTTON, POINT, TURN, GameAI
from pigaming_app.ai.race import levels, racer
from pigaming_app.ai.race.steering_help import with_help

AI = GameAI(
    {kind.name: kind for kind in (racer.HAND1, racer.HAND2, racer.HAND3, *levels.LEVELS)},
    driving={
        TURN: turn_and_drive,
        POINT: point_where_to_go,
        HELPED_TURN: with_help(turn_and_drive),
        HELPED_POINT: with_help(point_where_to_go),
        ONE_BUTTON: turn_and_drive,
    },
    boosts=True,
)
