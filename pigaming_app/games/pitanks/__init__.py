"""PiTanks: hit, and don't get hit."""

from pigaming_app.games.game import Game, LadderMatches
from pigaming_app.games.pitanks.observation import PiTanksObservation, PiTanksSenses, observe
from pigaming_app.games.pitanks.rules import judge
from pigaming_app.games.pitanks.start import VARIANTS, rules_of, start, stats
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.games.pitanks.surprise import surprise
from pigaming_app.games.rounds import BEST_OF

GAME = Game(
    name="pitanks",
    state=PiTanks,
    senses=PiTanksSenses,
    observation=PiTanksObservation,
    variants=VARIANTS,
    columns=("hits", "taken", "aim"),
    start=start,
    judge=judge,
    observe=observe,
    stats=stats,
    rules=rules_of,
    rounds=BEST_OF,
    surprise=surprise,
    ladder=LadderMatches(1.0, 0, ("classic", "courtyard", "trenches", "islands", "labyrinth"), 4.0),
)
