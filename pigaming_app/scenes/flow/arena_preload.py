"""The work that a match in each arena needs done once: reading the arena, and finding the racing line of a track."""

from contextlib import suppress

from pigaming_app.ai import seated
from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.sim.arena import ArenaError


def every_arena() -> list[tuple[str, str]]:
    """Game and name of each."""
    return [(game, name) for game in games() for name in arenas(game)]


def read(game: str, name: str) -> None:
    """Read an arena; what the games cache of it is there afterwards. A broken one is reported where it is chosen."""
    with suppress(ArenaError):
        load(game, name)


def prepare(game: str, name: str) -> None:
    """Seat AIs in an arena."""
    rules = games()[game]
    one, two, three, four = (Seat("hard", team) for team in rules.teams)
    setup = Setup(game, name, (one, two, three, four), rules.default_minutes, 1, rules.variants[0], rules.default_goal)
    with suppress(ArenaError):
        seated(setup)
