"""Robot Factory: bring your pallets through the machines and out, before the others do."""

from pigaming_app.games.factory.layout import read
from pigaming_app.games.factory.observation import Observation, Senses, observe
from pigaming_app.games.factory.rules import judge
from pigaming_app.games.factory.start import GOALS, PALLETS, ranking_key, records, start, stats, times
from pigaming_app.games.factory.state import Factory
from pigaming_app.games.game import PAIRS, Game, RecordKind

FACTORY = Game(
    name="factory",
    state=Factory,
    senses=Senses,
    observation=Observation,
    variants=("standard",),
    minutes=(3, 5, 8),
    default_minutes=5,
    goals=GOALS,
    default_goal=PALLETS,
    team_mode=PAIRS,
    teams=(0, 1, 0, 1),
    columns=("delivered", "steps", "bumps"),
    record_kinds=(RecordKind("time", timed=True, by_goal=True),),
    read=read,
    start=start,
    judge=judge,
    observe=observe,
    ranking_key=ranking_key,
    stats=stats,
    records=records,
    times=times,
    goal="pallets",
)
