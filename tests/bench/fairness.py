"""Fairness of a rule set between equal AIs: ties, wins by seat, and other measures of each game.

    python -m tests.bench.fairness GAME [--variant V] [--matches 400] [--brains level5,level5,level5,level5] [--json]

The matches are spread evenly over the arenas; each has its own seed. A robot stands still if it moves by less than
20 px/s for more than a second while it is free to move.
"""

import argparse
import json
import re
import sys
from collections.abc import Callable, Mapping
from typing import Any

from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError
from tests.bench import fairness_factory, fairness_football, fairness_pitanks, fairness_race
from tests.bench.trial import Trial

MEASURES: Mapping[str, Callable[[Trial], Mapping[str, Any]]] = {
    "pitanks": fairness_pitanks.measure,
    "factory": fairness_factory.measure,
    "race": fairness_race.measure,
    "football": fairness_football.measure,
}
MEANS = r"a match|a race|seconds|score|lead"  # in the names of all measures that are no shares


def main() -> int:
    """Run the measures of a game; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.fairness", description=__doc__.splitlines()[0])
    parser.add_argument("game", choices=list(MEASURES))
    parser.add_argument("--variant")
    parser.add_argument("--matches", type=int, default=400)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float)
    parser.add_argument("--arena")
    parser.add_argument("--goal", type=int)
    parser.add_argument("--brains", default="level5,level5,level5,level5", help="by seat")
    parser.add_argument("--json", action="store_true")
    words = parser.parse_args()
    trial = Trial(
        words.game,
        words.variant or games()[words.game].default.name,
        words.matches,
        words.seed,
        words.brains.split(","),
        words.minutes,
        words.arena,
        words.goal,
    )
    try:
        found = MEASURES[words.game](trial)
    except (ChoiceError, KeyError) as error:
        print(error, file=sys.stderr)
        return 2
    if words.json:
        print(json.dumps({"game": trial.game, "variant": trial.variant, "brains": trial.brains, **found}, indent=1))
        return 0
    for title, table in found.items():
        print(f"\n{trial.game} {trial.variant}, {','.join(trial.brains)}: {title}")
        print_table(table)
    return 0


def print_table(table: Mapping[str, Mapping[str, float]]) -> None:
    """Print a column for each entry of `table` and a line for each of its measures; shares in %."""
    lines = list(next(iter(table.values())))
    print(f"{'':26}" + "".join(f"{name:>12}" for name in table))
    for line in lines:
        print(f"{line:26}" + "".join(f"{cell(line, column.get(line)):>12}" for column in table.values()))


def cell(name: str, value: float | None) -> str:
    """The value of a measure for the table: counts as they are, means with one digit, shares in %."""
    if value is None or isinstance(value, int):
        return "" if value is None else str(value)
    return f"{value:.1f}" if re.search(MEANS, name) else f"{100 * value:.1f} %"


if __name__ == "__main__":
    sys.exit(main())
