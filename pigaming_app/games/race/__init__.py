"""Robot Race: the first to finish wins."""

from pigaming_app.games.game import Game, LadderMatches, RecordKind
from pigaming_app.games.race.observation import RaceObservation, RaceSenses, observe
from pigaming_app.games.race.rules import judge
from pigaming_app.games.race.start import (
    VARIANTS,
    faults,
    laps_of,
    ranking_key,
    read,
    records,
    reroute,
    rules_of,
    start,
    stats,
    times,
)
from pigaming_app.games.race.state import Race
from pigaming_app.games.race.surprise import surprise

GAME = Game(
    name="race",
    state=Race,
    senses=RaceSenses,
    observation=RaceObservation,
    variants=VARIANTS,
    columns=("laps", "best", "total"),
    record_kinds=(RecordKind("lap", timed=True), RecordKind("race", timed=True, by_goal=True)),
    read=read,
    faults=faults,
    surprise=surprise,
    start=start,
    judge=judge,
    observe=observe,
    ranking_key=ranking_key,
    stats=stats,
    records=records,
    times=times,
    rules=rules_of,
    goal="laps",
    goal_of=laps_of,
    reroute=reroute,
    timed=True,
    scored=False,
    ladder=LadderMatches(10.0, 3, ("classic", "kidney", "hairpin", "technical"), 5.0),
)
