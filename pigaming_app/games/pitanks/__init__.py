"""PiTanks: hit, and don't get hit."""

from pigaming_app.games.game import Game, LadderMatches, RecordKind
from pigaming_app.games.pitanks.observation import Observation, Senses, observe
from pigaming_app.games.pitanks.rules import judge
from pigaming_app.games.pitanks.start import VARIANTS, ranking_key, read, records, rules_of, start, stats, times
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.games.pitanks.surprise import surprise
from pigaming_app.games.rounds import BEST_OF

PITANKS = Game(
    name="pitanks",
    state=PiTanks,
    senses=Senses,
    observation=Observation,
    variants=VARIANTS,
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
    rules=rules_of,
    rounds=BEST_OF,
    surprise=surprise,
    scored=True,
    ladder=LadderMatches(1.0, 0, ("classic", "courtyard", "trenches", "islands", "labyrinth"), 4.0),
)
