"""Arenas of the pages, parsed once."""

from functools import lru_cache

from pigaming_app.games.arenas import is_own_name, load
from pigaming_app.sim.arena import Arena


def load_cached(game: str, name: str) -> Arena:
    """An arena, cached; those of the user as long as their files are the same. Raises ArenaError."""
    return load(game, name) if is_own_name(game, name) else load_shipped(game, name)


@lru_cache(maxsize=32)
def load_shipped(game: str, name: str) -> Arena:
    """An arena that comes with a game, or is made from a seed, cached. Raises ArenaError."""
    return load(game, name)
