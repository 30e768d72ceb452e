"""The rules of the games, and the only list of them."""

from pigaming_app.games.factory import FACTORY
from pigaming_app.games.game import Game
from pigaming_app.games.pitanks import PITANKS
from pigaming_app.games.race import RACE

GAMES: dict[str, Game] = {"pitanks": PITANKS, "factory": FACTORY, "race": RACE}
