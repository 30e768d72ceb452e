"""One-time work for matches in each arena: parsing the arena and solving a track's racing line."""

from contextlib import suppress

from pigaming_app.ai.registry import new_match
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.sim.arena import ArenaError


def every_arena() -> list[tuple[str, str]]:
    """Game and name of each arena."""
    return [(game, name) for game in games() for name in arenas(game)]


def read(game: str, name: str) -> None:
    """Load an arena into the cache of the pages. An invalid one is reported when it is selected."""
    with suppress(ArenaError):
        load_cached(game, name)


def prepare(game: str, name: str) -> None:
    """Seat AIs in an arena, which solves the racing line."""
    rules = games()[game].default
    one, two, three, four = (Seat("level5", team) for team in rules.teams)
    setup = Setup(game, name, (one, two, three, four), rules.default_minutes, 1, rules.name, rules.default_goal)
    with suppress(ArenaError):
        new_match(setup)
