"""List of all games."""

from collections.abc import Mapping
from functools import cache

from pigaming_app.games.factory import FACTORY
from pigaming_app.games.game import Game
from pigaming_app.games.pitanks import PITANKS
from pigaming_app.games.race import RACE


@cache
def games() -> Mapping[str, Game]:
    """Every game by its name, in the order of the title screen."""
    return {game.name: game for game in (PITANKS, FACTORY, RACE)}
