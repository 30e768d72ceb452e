"""Robot Race: first round the course wins."""

from pigaming_app.games.game import ALONE, Feat, Game
from pigaming_app.games.race.observation import Eyes, View, see
from pigaming_app.games.race.rules import judge
from pigaming_app.games.race.start import GOALS, LAPS, facts, feat, read, standing, start, times
from pigaming_app.games.race.state import Race

RACE = Game(
    name="race",
    state=Race,
    eyes=Eyes,
    view=View,
    variants=("standard",),
    minutes=(10,),
    default_minutes=10,
    goals=GOALS,
    default_goal=LAPS,
    sides=ALONE,
    teams=(0, 1, 2, 3),
    columns=("laps", "best", "total"),
    feats=(Feat("lap", timed=True), Feat("race", timed=True, by_goal=True)),
    read=read,
    start=start,
    judge=judge,
    see=see,
    standing=standing,
    facts=facts,
    feat=feat,
    times=times,
    goal="laps",
)
