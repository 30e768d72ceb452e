"""PiTanks: hit, and don't get hit."""

from pigaming_app.games.game import FREE, Game, RecordKind
from pigaming_app.games.pitanks.observation import Observation, Senses, observe
from pigaming_app.games.pitanks.rules import judge
from pigaming_app.games.pitanks.start import VARIANTS, ranking_key, read, records, start, stats, times
from pigaming_app.games.pitanks.state import PiTanks

PITANKS = Game(
    name="pitanks",
    state=PiTanks,
    senses=Senses,
    observation=Observation,
    variants=VARIANTS,
    minutes=(1, 2, 3, 5),
    default_minutes=2,
    goals=(),
    default_goal=0,
    team_mode=FREE,
    teams=(0, 1, 2, 3),
    columns=("hits", "taken", "aim"),
    record_kinds=(RecordKind("points"),),
    read=read,
    start=start,
    judge=judge,
    observe=observe,
    ranking_key=ranking_key,
    stats=stats,
    records=records,
    times=times,
)
