"""PiTanks: hit, and don't get hit."""

from pigaming_app.games.game import FREE, Feat, Game
from pigaming_app.games.pitanks.observation import Eyes, View, see
from pigaming_app.games.pitanks.rules import judge
from pigaming_app.games.pitanks.start import VARIANTS, facts, feat, read, standing, start, times
from pigaming_app.games.pitanks.state import PiTanks

PITANKS = Game(
    name="pitanks",
    state=PiTanks,
    eyes=Eyes,
    view=View,
    variants=VARIANTS,
    minutes=(1, 2, 3, 5),
    default_minutes=2,
    goals=(),
    default_goal=0,
    sides=FREE,
    teams=(0, 1, 2, 3),
    columns=("hits", "taken", "aim"),
    feats=(Feat("points"),),
    read=read,
    start=start,
    judge=judge,
    see=see,
    standing=standing,
    facts=facts,
    feat=feat,
    times=times,
)
