"""Reproduction of the published table of the Q-learner against the FSM.

    python -m tests.bench.reproduce_table [--seeds FIRST LAST] [--plain] [--csv FILE]
    python -m tests.bench.reproduce_table --ship

For each reward it trains one robot per seed (1 to 12 by default) in 200 matches of two minutes, plays 100 matches of
two minutes of each against the frozen FSM `classic`, sides swapped, without the unstick reflex of seated robots, and
prints the results beside the published ones, with Wilson's 95 % intervals: of every seed, of their median, and of the
named seed whose table ships with the arcade. `--ship` trains, writes and measures only those two tables. Exit code 1
where one of the two lies outside the published interval.
"""

import argparse
import csv
import sys
from collections.abc import Iterator
from statistics import median
from typing import NamedTuple

from pigaming_app import ASSETS
from pigaming_app.ai.experiments.league import wilson
from pigaming_app.ai.experiments.training import Training, contest
from pigaming_app.ai.qlearning.rewards import RECIPES
from pigaming_app.ai.registry import BRAINS
from pigaming_app.scenes.files import save_table
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import HZ

PUBLISHED = {1: (32, 68, 0), 2: (94, 6, 0)}
WITHIN = {1: (0.237, 0.417), 2: (0.875, 0.972)}  # wins: Wilson's interval of the published share
MOST_LOST = 0.037  # the same for no loss in 100
NAMED = {1: 158, 2: 5}  # the seeds of the shipped tables
MATCHES, MEASURED, MEASURE_SEED = 200, 100, 1000


class Row(NamedTuple):
    """Results of the robot of one seed."""

    reward: int
    seed: int
    wins: int
    ties: int
    losses: int

    @property
    def within(self) -> bool:
        """True if the results lie within the published intervals."""
        low, high = WITHIN[self.reward]
        return low <= self.wins / MEASURED <= high and self.losses / MEASURED <= MOST_LOST


def trained(reward: int, seed: int, fast: bool) -> Training:
    """A robot after MATCHES matches."""
    learner = Training(RECIPES[reward], seed, fast=fast)
    learner.run(MATCHES * round(learner.minutes * 60 * HZ))
    return learner


def measured(learner: Training, reward: int, seed: int) -> Row:
    """Results against the frozen FSM."""
    opponent = BRAINS["pitanks"]["classic"]
    return Row(reward, seed, *contest(learner.checkpoint().kind, opponent, MEASURED, MEASURE_SEED, fast=learner.fast))


def rows(reward: int, seeds: range, fast: bool) -> Iterator[Row]:
    """Train and measure one seed after the other; each row is printed at once."""
    for seed in seeds:
        row = measured(trained(reward, seed, fast), reward, seed)
        print_row(str(seed), row)
        yield row


def print_row(name: str, row: Row) -> None:
    """Print a line of the table."""
    low, high = wilson(row.wins, MEASURED)
    interval = f"{100 * low:5.1f} to {100 * high:5.1f} %"
    mark = "  as published" if row.within else ""
    print(f"{name:>16}{row.wins:7}{row.ties:7}{row.losses:7}   {interval}{mark}", flush=True)


def table(reward: int, seeds: range, fast: bool) -> list[Row]:
    """Print the table of one reward; returns its rows."""
    print(f"\nreward {reward}{'seed':>7}{'wins':>8}{'ties':>7}{'losses':>8}   wins, 95 %")
    print_row("published", Row(reward, 0, *PUBLISHED[reward]))
    found = list(rows(reward, seeds, fast))
    wins, ties, losses = (round(median(row[k] for row in found)) for k in (2, 3, 4))
    print_row("median", Row(reward, 0, wins, ties, losses))
    named = next((row for row in found if row.seed == NAMED[reward]), None)
    if named is None:
        named = measured(trained(reward, NAMED[reward], fast), reward, NAMED[reward])
        found.append(named)
    print_row(f"named: {named.seed}", named)
    return found


def ship(fast: bool) -> list[Row]:
    """Train, save and measure the two shipped tables."""
    found = []
    for reward, seed in NAMED.items():
        learner = trained(reward, seed, fast)
        save_table(learner.trained(f"q{reward}"), ASSETS / "brains" / f"q{reward}.npz")
        found.append(measured(learner, reward, seed))
        print_row(f"q{reward}, seed {seed}", found[-1])
    return found


def main() -> int:
    """Run the benchmark; returns the exit code."""
    parser = argparse.ArgumentParser(description="The published table of the Q-learner, played again.")
    parser.add_argument("--seeds", type=int, nargs=2, default=(1, 12), metavar=("FIRST", "LAST"))
    parser.add_argument("--plain", action="store_true", help="without numba")
    parser.add_argument("--csv", help="write the rows")
    parser.add_argument("--ship", action="store_true", help="train assets/brains/q1.npz and q2.npz")
    arguments = parser.parse_args()
    fast = can_compile() and not arguments.plain
    if arguments.ship:
        found = ship(fast)
    else:
        seeds = range(arguments.seeds[0], arguments.seeds[1] + 1)
        found = [row for reward in PUBLISHED for row in table(reward, seeds, fast)]
    if arguments.csv:
        with open(arguments.csv, "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([Row._fields, *found])
    named = [row for row in found if row.seed == NAMED[row.reward]]
    return 0 if all(row.within for row in named) else 1


if __name__ == "__main__":
    sys.exit(main())
