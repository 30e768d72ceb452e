"""All blocks by name."""

from tests.bench.figures import Derived, Measured, derived, duels, seeds, speed

OPPONENTS, MAIN = "docs/opponents.md", "python3 main.py"
TABLE = ".venv/bin/python -m tests.bench.reproduce_table"
DERIVED = {
    "links": Derived("README.md", derived.where_to_get_it),
    "bundles": Derived("docs/bundle.md", derived.bundles),
    "games": Derived("docs/thesis.md", derived.games_in_numbers),
}
MEASURED = {
    "speed": Measured("README.md", f"{MAIN} bench pitanks", speed.table, 3),
    "steps": Measured(OPPONENTS, f"{MAIN} league GAME level1 level2 level3 level4 level5 --variant V", duels.steps, 25),
    "against hand2": Measured(
        OPPONENTS, f"{MAIN} duel pitanks NAME hand2 --matches 200 [--variant party]", duels.against_hand2, 4
    ),
    "pairs": Measured(OPPONENTS, f"{MAIN} duel pitanks LEFT RIGHT --matches 400", duels.pairs, 3),
    "ties": Measured(OPPONENTS, f"{MAIN} duel pitanks LEFT RIGHT --matches 200 --arena islands", duels.ties, 5),
    "factory": Measured(OPPONENTS, f"{MAIN} league factory random hand1 hand2 hand3 --matches 40", duels.factory, 2),
    "football": Measured(
        "docs/football.md",
        f"{MAIN} league football level1 level2 level3 level4 level5 net --variant party --matches 200 --seed 60001",
        duels.football,
        6,
    ),
    "seeds": Measured("docs/qlearning.md", f"{TABLE} --seeds {seeds.FIRST} {seeds.LAST}", seeds.histogram, 4),
}
