"""What the tables of the best keep: which there are for a game, where they lie, and how what they hold is told."""

from dataclasses import dataclass

from pigaming_app.games import GAMES
from pigaming_app.games.game import Feat

NONE = "–"


@dataclass(frozen=True)
class Board:
    """A table as it is shown. `heading`: of its words; `days`: it is of so many last days; None: of all time."""

    heading: str
    feat: Feat
    table: str
    days: int | None = None


def table_of(arena: str, feat: Feat, goal: int) -> str:
    """The name under which a feat is kept; what depends on the goal has a table for each."""
    if not feat.timed:
        return arena
    return f"{arena} {feat.name} {goal}" if feat.by_goal else f"{arena} {feat.name}"


def boards(game: str, arena: str, goal: int) -> list[Board]:
    """The two tables that are shown side by side: of each feat, or of the only one today's and that of all time."""
    feats = [(feat, table_of(arena, feat, goal)) for feat in GAMES[game].feats]
    if len(feats) > 1:
        return [Board(f"results.best_{feat.name}", feat, table) for feat, table in feats[:2]]
    feat, table = feats[0]
    return [Board("results.today", feat, table, 1), Board("results.ever", feat, table)]


def told(value: int, feat: Feat) -> str:
    """Points, or milliseconds as minutes and seconds."""
    return clock(value / 1000.0) if feat.timed else str(value).replace("-", "−")


def clock(seconds: float) -> str:
    """A time to the hundredth; 0 is none."""
    if seconds <= 0.0:
        return NONE
    hundredths = round(100 * seconds)
    minutes, rest = divmod(hundredths, 6000)
    return f"{minutes}:{rest // 100:02}.{rest % 100:02}" if minutes else f"{rest // 100}.{rest % 100:02}"
