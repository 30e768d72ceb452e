"""Performance of the drivers of Robot Factory: deadlocks, wrong machines, people hit, wins, and makespan.

    python -m tests.bench.makespan [MATCHES]

1000 matches of four `level5` by default, over all floors, and as many in total of each level against the next; exit
code 1 where a target is missed.

A deadlock is a minute without progress (no machine finishes, nothing is delivered) while pallets remain, or a match of
`level5` without a winner at the end of the time.

The makespan of a team alone is compared with the lower bound of `makespan_bound`.
"""

import argparse
import sys
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from pigaming_app.ai.factory.brains import LEVELS
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.arenas import arenas
from pigaming_app.games.factory.start import PALLETS
from pigaming_app.games.game import Seat, Setup
from pigaming_app.sim.world import DT, HZ, ROBOTS
from tests.bench.makespan_bound import bound

TEAMS = (0, 1, 0, 1)
MINUTES = 5.0
STUCK = 60  # s without any progress
MOST_HITS, LEAST_WINS = 0.3, 0.5
MOST = 1.5  # makespan of two alone, as a multiple of the proven bound
ALONE = 40  # matches of two alone
BEST = "level5"


def setup(floor: str, strengths: tuple[str, ...], seed: int) -> Setup:
    """A match of these drivers; "off" is an empty seat."""
    one, two, three, four = (Seat(brain, team) for brain, team in zip(strengths, TEAMS, strict=True))
    return Setup("factory", floor, (one, two, three, four), MINUTES, seed, "standard", PALLETS)


def play(floor: str, strengths: tuple[str, ...], seeds: range) -> tuple[Any, Any]:
    """Play matches; returns their records, and the longest time without progress of each, s."""
    kinds = [BRAINS["factory"].get(brain) for brain in strengths]
    batch = Batch([setup(floor, strengths, seed) for seed in seeds], kinds, True)
    matches = batch.matches
    before, since, longest = progress(matches), np.zeros(len(seeds), int), np.zeros(len(seeds), int)
    while not matches["over"].all():
        batch.play(HZ)
        now = progress(matches)
        since = np.where(matches["over"].astype(bool) | (now != before), 0, since + 1)
        longest, before = np.maximum(longest, since), now
    return matches, longest


def progress(matches: Any) -> Any:
    """Number of deliveries and finished machine steps of both teams."""
    return matches["delivered"].sum(axis=1) + matches["loads"]["steps"].sum(axis=1)


def count(matches: Any, longest: Any) -> dict[str, Any]:
    """Statistics of matches by name."""
    loads = matches["loads"]
    return {
        "matches": len(matches),
        "stuck": int((longest >= STUCK).sum()),
        "unfinished": int((matches["winner"] == 0).sum()),
        "spoiled": int(loads["spoiled"].sum()),
        "median hits": float(np.median(loads["hits"])),
        "mean hits": round(float(loads["hits"].mean()), 3),
        "median s": float(np.median(matches["tick"])) * DT,
        "longest s": float(matches["tick"].max()) * DT,
    }


def wins(better: str, worse: str, each: int) -> tuple[int, int, int]:
    """Wins, ties and losses of one strength against another, on both sides, over all floors."""
    won, tied, lost = 0, 0, 0
    for floor in arenas("factory"):
        for side in (0, 1):
            strengths = tuple(better if team == side else worse for team in TEAMS)
            matches, _ = play(floor, strengths, range(1, each + 1))
            loads = matches["loads"]["steps"]
            mine = matches["delivered"][:, side] * 1000 + loads[:, side] + loads[:, side + 2]
            theirs = matches["delivered"][:, 1 - side] * 1000 + loads[:, 1 - side] + loads[:, 3 - side]
            won += int((mine > theirs).sum())
            tied += int((mine == theirs).sum())
            lost += int((mine < theirs).sum())
    return won, tied, lost


# ------------------------------------------------------------------------------------------------------------- reports


def reports(matches: int) -> Iterator[bool]:
    """Print each report; yields true where its target is met."""
    floors = arenas("factory")
    each = -(-matches // len(floors))
    parts = []
    for floor in floors:
        played, longest = play(floor, (BEST,) * ROBOTS, range(1, each + 1))
        statistics = count(played, longest)
        print(f"{floor}: {statistics}")
        parts.append(played["loads"]["hits"].ravel())
        yield not (statistics["stuck"] or statistics["unfinished"] or statistics["spoiled"])
        yield makespans(floor, statistics["median s"])
    median = float(np.median(np.concatenate(parts)))
    print(f"people hit: median {median:g} a robot")
    yield median <= MOST_HITS
    few = -(-matches // (len(floors) * 2 * (len(LEVELS) - 1)))
    for better, worse in pairwise(reversed([level.name for level in LEVELS])):
        won, tied, lost = wins(better, worse, few)
        print(f"{better} against {worse}: {won} won, {tied} tied, {lost} lost", flush=True)
        yield won / (won + tied + lost) >= LEAST_WINS
    for level in LEVELS[:-1]:
        for floor in floors:
            statistics = count(*play(floor, (level.name,) * ROBOTS, range(1, few + 1)))
            print(f"{level.name}, {floor}: {statistics}", flush=True)
            yield not statistics["stuck"]


def makespans(floor: str, against_others: float) -> bool:
    """Print makespans on a floor; True if those of two alone meet the target."""
    proven = bound(floor, 2, PALLETS)
    took = {}
    for brain in ("hand3", BEST):
        alone, _ = play(floor, (brain, "off", brain, "off"), range(1, ALONE + 1))
        took[brain] = float(np.median(alone["tick"])) * DT
        print(f"  two {brain} alone {took[brain]:.1f} s: {took[brain] / proven:.2f} x the bound of {proven:.1f} s")
    print(f"  the winners against two others {against_others:.1f} s: {against_others / proven:.2f} x", flush=True)
    return took[BEST] <= MOST * proven


def main(matches: int) -> int:
    """Print all reports; returns the exit code."""
    return 0 if all([*reports(matches)]) else 1


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.bench.makespan", description=__doc__.splitlines()[0])
    parser.add_argument("matches", type=int, nargs="?", default=1000, help="matches of four level5 (1000)")
    sys.exit(main(parser.parse_args().matches))
