"""Robot Football: put the ball into the other team's goal."""

from pigaming_app.api import Game, LadderMatches

from .observation import Observation, observe
from .pitch import faults, read
from .rules import judge
from .start import VARIANTS, rules_of, start, stats
from .state import Football
from .surprise import surprise

API = 1  # of pigaming_app.api, for which this game was written
GAME = Game(
    name="football",
    state=Football,
    observation=Observation,
    variants=VARIANTS,
    columns=("goals", "assists", "own_goals"),
    start=start,
    judge=judge,
    observe=observe,
    read=read,
    faults=faults,
    rules=rules_of,
    stats=stats,
    surprise=surprise,
    ladder=LadderMatches(2.0, 0, ("classic", "bumpers", "small_goals"), 3.0),
)
