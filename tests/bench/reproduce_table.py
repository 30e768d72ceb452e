"""Reproduction of the published table of the Q-learner against the FSM, and of its verdict on the two rewards.

    python -m tests.bench.reproduce_table [--seeds 25 224] [--set NAME=NUMBER] [--plain] [--csv FILE] [--json]
    python -m tests.bench.reproduce_table --ship

For each seed it trains one robot per reward in 200 matches of two minutes. It plays 100 matches of two minutes of each
against the frozen FSM `classic`, and 100 of the first against the second, sides swapped, without the unstick reflex of
seated robots. It prints every seed; for each reward a histogram of the wins, the percentile of the published wins
among the seeds, and the shares of seeds that never win and that lie inside Wilson's 95 % intervals of the published
result; the seeds with which reward 1 does better than reward 2; and the same matches of the two robots that ship.

Seeds 1 to 24 are not among the preset ones: the unknown numbers of `classic` were fitted to the first of them. `--set`
changes both recipes, for another reading of the paper; the shipped robots are then left out. `--ship` trains, writes
and measures only the shipped tables. Exit code 1 where one of these two lies outside the published intervals.
"""

import argparse
import csv
import json
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any, NamedTuple

from pigaming_app import ASSETS
from pigaming_app.ai.learning.league import wilson
from pigaming_app.ai.learning.training import TableTraining, contest
from pigaming_app.ai.qlearning.recipe import RECIPES, Recipe
from pigaming_app.ai.registry import BRAINS
from pigaming_app.jobs.learning.train.options import changed
from pigaming_app.scenes.files import save_table
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import HZ

NAMED = {1: 158, 2: 5}  # the seeds of the shipped tables
MATCHES, MEASURED, MEASURE_SEED = 200, 100, 1000
BINS = ((0, 0), (1, 20), (21, 40), (41, 60), (61, 80), (81, 99), (100, 100))  # wins of MEASURED


class Result(NamedTuple):
    """Matches of one robot against another."""

    wins: int
    ties: int
    losses: int


PUBLISHED = {1: Result(32, 68, 0), 2: Result(94, 6, 0)}


class Row(NamedTuple):
    """Results of the two robots of one seed against the FSM, and of the first against the second."""

    seed: int
    one: Result
    two: Result
    duel: Result


@dataclass(frozen=True)
class Summary:
    """The seeds of one reward beside the published result; shares from 0 to 1."""

    histogram: dict[str, int]  # seeds by their wins
    percentile: float  # of the published wins: share of seeds with fewer wins, those with as many counted half
    never: float  # share of seeds without a win
    never_95: tuple[float, float]  # its Wilson interval
    reproduced: float  # share of seeds inside the published intervals


def is_published(reward: int, found: Result) -> bool:
    """True if wins and losses lie within Wilson's intervals of the published ones."""
    pairs = ((found.wins, PUBLISHED[reward].wins), (found.losses, PUBLISHED[reward].losses))
    intervals = [(value / MEASURED, wilson(published, MEASURED)) for value, published in pairs]
    return all(low <= share <= high for share, (low, high) in intervals)


def summary(reward: int, found: Sequence[Result]) -> Summary:
    """Summary of the results of one reward, one a seed."""
    published = PUBLISHED[reward].wins
    fewer, same = sum(one.wins < published for one in found), sum(one.wins == published for one in found)
    never = sum(one.wins == 0 for one in found)
    return Summary(
        histogram([one.wins for one in found]),
        (fewer + same / 2) / len(found),
        never / len(found),
        wilson(never, len(found)),
        sum(is_published(reward, one) for one in found) / len(found),
    )


def histogram(found: Sequence[int]) -> dict[str, int]:
    """Number of seeds whose wins lie in each of BINS. A median would mislead: most win hardly ever or nearly always."""
    names = (str(low) if low == high else f"{low} to {high}" for low, high in BINS)
    counts = (sum(low <= wins <= high for wins in found) for low, high in BINS)
    return dict(zip(names, counts, strict=True))


def bar(count: int, seeds: int) -> str:
    """A bar with a block for each 2 % of the seeds."""
    return "█" * round(50 * count / seeds)


def trained(recipe: Recipe, seed: int, fast: bool) -> TableTraining:
    """A robot after MATCHES matches."""
    learner = TableTraining(recipe, seed, fast=fast)
    learner.run(MATCHES * round(learner.minutes * 60 * HZ))
    return learner


def row(seed: int, one: TableTraining, two: TableTraining) -> Row:
    """Results of the robots of two rewards."""
    first, second, opponent = one.checkpoint().kind, two.checkpoint().kind, BRAINS["pitanks"]["classic"]
    meetings = ((first, opponent), (second, opponent), (first, second))
    return Row(seed, *(Result(*contest(*pair, MEASURED, MEASURE_SEED, fast=one.fast)) for pair in meetings))


def rows(recipes: dict[int, Recipe], seeds: range, fast: bool) -> Iterator[Row]:
    """Train and measure one seed after the other."""
    return (row(seed, trained(recipes[1], seed, fast), trained(recipes[2], seed, fast)) for seed in seeds)


def shipped(save: bool, fast: bool) -> Row:
    """Train and measure the two robots of the arcade; `save`: write their tables."""
    learners = {reward: trained(RECIPES[reward], seed, fast) for reward, seed in NAMED.items()}
    if save:
        for reward, learner in learners.items():
            save_table(learner.trained(f"q{reward}"), ASSETS / "brains" / f"q{reward}.npz")
    return row(0, learners[1], learners[2])


def cell(reward: int, found: Result) -> str:
    """A result in the table, marked if it is as published."""
    mark = "*" if reward and is_published(reward, found) else " "
    return f"{found.wins:8}{found.ties:6}{found.losses:6}{mark}"


def print_row(name: str, found: Row) -> None:
    print(f"{name:>14}{cell(1, found.one)}{cell(2, found.two)}{cell(0, found.duel)}", flush=True)


def print_head() -> None:
    print(f"{'':14}{'reward 1':>20} {'reward 2':>20} {'1 against 2':>20}")
    print(f"{'seed':>14}" + f"{'wins':>8}{'ties':>6}{'lost':>6} " * 3)
    print(f"{'published':>14}{cell(1, PUBLISHED[1])}{cell(2, PUBLISHED[2])}   (*: within its 95 % intervals)")


def print_summary(found: Sequence[Row], summaries: dict[int, Summary]) -> None:
    """Print the histograms and the shares of seeds."""
    for reward, one in summaries.items():
        low, high = one.never_95
        print(
            f"\nreward {reward}: the published {PUBLISHED[reward].wins} wins are percentile {100 * one.percentile:.1f} "
            f"of {len(found)} seeds; {100 * one.never:.1f} % of them never win (95 %: {100 * low:.1f} to "
            f"{100 * high:.1f}); {100 * one.reproduced:.1f} % are as published"
        )
        for wins, count in one.histogram.items():
            print(f"{wins:>14} wins: {count:3} {bar(count, len(found))}".rstrip())
    for name, counts in verdict(found).items():
        print(
            f"\nreward 1 against reward 2, {name}: " + ", ".join(f"{word} in {n}" for word, n in counts.items()), end=""
        )
    print(f" of {len(found)} seeds")


def verdict(found: Sequence[Row]) -> dict[str, dict[str, int]]:
    """Seeds by whether the robot of reward 1 is better, equal or worse, by two measures."""
    measures = {
        "by wins against classic": [one.one.wins - one.two.wins for one in found],
        "head to head": [one.duel.wins - one.duel.losses for one in found],
    }
    return {
        name: {
            "ahead": sum(lead > 0 for lead in leads),
            "level": sum(lead == 0 for lead in leads),
            "behind": sum(lead < 0 for lead in leads),
        }
        for name, leads in measures.items()
    }


def as_json(found: Sequence[Row], summaries: dict[int, Summary], named: Row | None, settings: Sequence[str]) -> str:
    """All that is printed, as JSON."""
    words: dict[str, Any] = {"set": settings, "published": PUBLISHED}
    if found:
        words |= {"summary": {reward: asdict(one) for reward, one in summaries.items()}, "verdict": verdict(found)}
        words["seeds"] = [one._asdict() for one in found]
    if named:
        words["shipped"] = {"seeds": NAMED, "one": named.one, "two": named.two, "duel": named.duel}
    return json.dumps(words, indent=1)


def main() -> int:
    """Run the benchmark; returns the exit code."""
    parser = argparse.ArgumentParser(description="The published table of the Q-learner, played again.")
    parser.add_argument("--seeds", type=int, nargs=2, default=(25, 224), metavar=("FIRST", "LAST"))
    parser.add_argument("--set", action="append", default=[], metavar="NAME=NUMBER", help="change both recipes")
    parser.add_argument("--plain", action="store_true", help="without numba")
    parser.add_argument("--csv", help="write the rows")
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--ship", action="store_true", help="train assets/brains/q1.npz and q2.npz")
    arguments = parser.parse_args()
    fast = can_compile() and not arguments.plain
    try:
        recipes = {reward: changed(recipe, arguments.set) for reward, recipe in RECIPES.items()}
    except ValueError as error:
        parser.error(f"--set: {error}")
    seeds = range(0) if arguments.ship else range(arguments.seeds[0], arguments.seeds[1] + 1)
    found: list[Row] = []
    if not arguments.json:
        print_head()
    for one in rows(recipes, seeds, fast):
        found.append(one)
        if not arguments.json:
            print_row(str(one.seed), one)
    summaries = {1: summary(1, [one.one for one in found]), 2: summary(2, [one.two for one in found])} if found else {}
    named = None if arguments.set else shipped(arguments.ship, fast)
    if arguments.json:
        print(as_json(found, summaries, named, arguments.set))
    else:
        if found:
            print_summary(found, summaries)
        if named:
            print()
            print_row(f"q1:{NAMED[1]}, q2:{NAMED[2]}", named)
    if arguments.csv:
        with open(arguments.csv, "w", newline="", encoding="utf-8") as file:
            lines = [(one.seed, *one.one, *one.two, *one.duel) for one in found]
            heads = [f"{kind}_{side}" for side in ("1", "2", "1v2") for kind in Result._fields]
            csv.writer(file).writerows([("seed", *heads), *lines])
    return 0 if named is None or (is_published(1, named.one) and is_published(2, named.two)) else 1


if __name__ == "__main__":
    sys.exit(main())
