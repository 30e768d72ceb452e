"""Robot Factory: bring your pallets through the machines and out, before the others do."""

from pigaming_app.games.factory.layout import read
from pigaming_app.games.factory.observation import Eyes, View, see
from pigaming_app.games.factory.rules import judge
from pigaming_app.games.factory.start import GOALS, PALLETS, facts, feat, standing, start, times
from pigaming_app.games.factory.state import Factory
from pigaming_app.games.game import PAIRS, Feat, Game

FACTORY = Game(
    name="factory",
    state=Factory,
    eyes=Eyes,
    view=View,
    variants=("standard",),
    minutes=(3, 5, 8),
    default_minutes=5,
    goals=GOALS,
    default_goal=PALLETS,
    sides=PAIRS,
    teams=(0, 1, 0, 1),
    columns=("delivered", "steps", "bumps"),
    feats=(Feat("time", timed=True, by_goal=True),),
    read=read,
    start=start,
    judge=judge,
    see=see,
    standing=standing,
    facts=facts,
    feat=feat,
    times=times,
    goal="pallets",
)
