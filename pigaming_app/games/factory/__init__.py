"""Robot Factory: bring your pallets through the machines and out, before the others do."""

from pigaming_app.games.factory.layout import faults, read
from pigaming_app.games.factory.observation import FactoryObservation, FactorySenses, observe
from pigaming_app.games.factory.rules import judge
from pigaming_app.games.factory.start import VARIANTS, ranking_key, records, rules_of, start, stats
from pigaming_app.games.factory.state import Factory
from pigaming_app.games.factory.surprise import surprise
from pigaming_app.games.game import Game, LadderMatches, RecordKind

GAME = Game(
    name="factory",
    state=Factory,
    senses=FactorySenses,
    observation=FactoryObservation,
    variants=VARIANTS,
    columns=("delivered", "steps", "bumps"),
    record_kinds=(RecordKind("time", timed=True, by_goal=True), RecordKind("points")),
    read=read,
    faults=faults,
    surprise=surprise,
    start=start,
    judge=judge,
    observe=observe,
    ranking_key=ranking_key,
    stats=stats,
    records=records,
    rules=rules_of,
    goal="pallets",
    scored=False,
    ladder=LadderMatches(2.0, 0, ("hall", "lines", "yard"), 3.0),
)
