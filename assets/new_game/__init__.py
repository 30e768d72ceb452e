"""New Game: drive over the coin before the others do."""

from pigaming_app.api import Game, Variant

from .rules import NewGame, judge, start

API = 1  # of pigaming_app.api, for which this game was written
GAME = Game(
    name="new_game",
    state=NewGame,
    variants=Variant.by_name(Variant("standard", minutes=(1, 2, 3), default_minutes=2)),
    start=start,
    judge=judge,
)
