"""Robot Race: the first to finish wins."""

from pigaming_app.games.game import ALONE, Game, RecordKind
from pigaming_app.games.race.observation import Observation, Senses, observe
from pigaming_app.games.race.rules import judge
from pigaming_app.games.race.start import GOALS, LAPS, ranking_key, read, records, start, stats, times
from pigaming_app.games.race.state import Race

RACE = Game(
    name="race",
    state=Race,
    senses=Senses,
    observation=Observation,
    variants=("standard",),
    minutes=(10,),
    default_minutes=10,
    goals=GOALS,
    default_goal=LAPS,
    team_mode=ALONE,
    teams=(0, 1, 2, 3),
    columns=("laps", "best", "total"),
    record_kinds=(RecordKind("lap", timed=True), RecordKind("race", timed=True, by_goal=True)),
    read=read,
    start=start,
    judge=judge,
    observe=observe,
    ranking_key=ranking_key,
    stats=stats,
    records=records,
    times=times,
    goal="laps",
)
