"""New Game: drive over the coin before the others do."""

from pigaming_app.api import Game, Variant, named

from .rules import NewGame, judge, rules_of, start

API = 1  # of pigaming_app.api, for which this game was written
GAME = Game(
    name="new_game",
    state=NewGame,
    variants=named(Variant("standard", minutes=(1, 2, 3), default_minutes=2)),
    start=start,
    rules=rules_of,
    judge=judge,
)
