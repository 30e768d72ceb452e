"""PiTanks: hit, and don't get hit."""

from pigaming_app.games.game import Game
from pigaming_app.games.pitanks.rules import judge
from pigaming_app.games.pitanks.start import VARIANTS, facts, start
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.games.pitanks.view import Eyes, View, see

PITANKS = Game(
    name="pitanks",
    state=PiTanks,
    eyes=Eyes,
    view=View,
    variants=VARIANTS,
    minutes=(1, 2, 3, 5),
    default_minutes=2,
    columns=("hits", "taken", "aim"),
    start=start,
    judge=judge,
    see=see,
    facts=facts,
)
