"""The AI of New Game: along the shortest way to the coin. The same for all levels, until there are better ones."""

from typing import Any

from pigaming_app.api.brains import BrainKind, GameAI, Route, follow, levels
from pigaming_app.api.rules import kernel, record

PERIOD = 5  # ticks between decisions


@record
class Mind:
    """What it keeps between decisions."""

    route: Route


@kernel
def think(match: Any, seat: int, mind: Any, weights: Any) -> None:
    """Set the seat's action."""
    if match.tick % PERIOD == seat:
        mind.route.active, mind.route.goal_x, mind.route.goal_y = 1, match.coin_x, match.coin_y
        follow(match, seat, mind.route, PERIOD)


AI = GameAI(levels(BrainKind("collector", Mind, think)))
