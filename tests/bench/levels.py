"""The five levels of a game: rating steps, ties, results against random and idle robots, and in PiTanks manners.

    python -m tests.bench.levels GAME [--variant V] [--matches 200] [--seed 1] [--arena A] [--json]

Ratings are those of a league of the five levels. Manners are taken from duels of each level with the one above, over
all arenas: shots a match; shots into walls, fired while no opponent is in the line of fire; camping, the time for which
a robot stands still and no opponent has a clear line to it.
"""

import argparse
import json
import sys
from collections.abc import Mapping
from typing import Any

import numpy as np

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.learning.league import duel, league
from pigaming_app.games.pitanks.state import RICOCHET
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError
from pigaming_app.sim.world import ROBOTS
from tests.bench.fairness_pitanks import unseen
from tests.bench.trial import StandingStill, Trial, live, of_parts, of_robots, played

STEP, MOST_TIES, LEAST_WINS = (120.0, 220.0), 0.10, 0.95
MOST_CAMPING, MOST_SHOTS, MOST_BLIND = 0.03, 60.0, 0.05  # of every level, of level 1, of level 5


def measure(game: str, variant: str | None, matches: int, seed: int, arena: str | None) -> dict[str, Any]:
    """Rating and results of every level, by name."""
    levels = list(LEVELS)
    result = league(game, levels, matches, seed, arena=arena, variant=variant)
    ratings = {row.brain: row.rating.rating for row in result.standings}
    ties = {met.left: met.ties / met.matches for met in result.duels if _neighbours(met.left, met.right, levels)}
    table: dict[str, dict[str, float]] = {}
    for number, name in enumerate(levels):
        row: dict[str, float] = {"rating": ratings[name]}
        if number + 1 < len(levels):
            row["step up"], row["ties"] = ratings[levels[number + 1]] - ratings[name], ties[name]
        for rival in ("random", "idle"):
            met = duel(game, name, rival, matches, seed, arena=arena, variant=variant)
            row[f"beats {rival}"] = met.wins / met.matches
        if game == "pitanks":
            above = levels[min(number + 1, len(levels) - 1)]
            variant_played = variant or games()[game].default.name
            row |= manners(Trial(game, variant_played, matches, seed, (name, above, "off", "off")))
        table[name] = row
    return table


def manners(trial: Trial) -> dict[str, float]:
    """Shots, shots into walls and camping of the first robot of a trial."""
    batch = trial.batch()
    standing, camping = StandingStill(batch), StandingStill(batch)
    present = of_robots(batch, "present") == 1
    first = np.zeros((trial.matches, ROBOTS), bool)
    first[:, 0] = True
    shots, blind, fired = np.zeros(trial.matches, int), 0, 0
    hidden = np.zeros(trial.matches, bool)
    for _ in played(trial, batch):
        free = live(batch)[:, None] & present & (of_parts(batch, "tanks", "knocked_out") == 0)
        standing.sample(batch, free)
        camping.sample(batch, unseen(batch, standing.since > 0))
        before, hidden = hidden, unseen(batch, first)[:, 0]
        new = np.array(of_parts(batch, "tanks", "shots")[:, 0]) - shots
        shots += new
        bounces = of_parts(batch, "tanks", "powers")[:, 0, RICOCHET] > 0
        fired += int(new[~bounces].sum())
        blind += int(new[hidden & before & ~bounces].sum())
    return {
        "shots": float(shots.mean()),
        "shots into walls": blind / max(1, fired),
        "camping": float((camping.still[:, 0] / np.maximum(1, standing.free[:, 0])).mean()),
    }


def misses(table: Mapping[str, Mapping[str, float]]) -> list[str]:
    """The targets that were missed, one line each."""
    names, found = list(table), []
    for name, row in table.items():
        checks = {
            "step up": STEP[0] <= row.get("step up", STEP[0]) <= STEP[1],
            "ties": row.get("ties", 0.0) <= MOST_TIES,
            "beats random": row["beats random"] >= LEAST_WINS,
            "beats idle": row["beats idle"] >= LEAST_WINS,
            "camping": row.get("camping", 0.0) <= MOST_CAMPING,
            "shots": name != names[0] or row.get("shots", 0.0) <= MOST_SHOTS,
            "shots into walls": name != names[-1] or row.get("shots into walls", 0.0) <= MOST_BLIND,
        }
        found += [f"{name}: {key} {row[key]:.3g}" for key, reached in checks.items() if not reached]
    return found


def _neighbours(left: str, right: str, levels: list[str]) -> bool:
    return levels.index(right) - levels.index(left) == 1


def main() -> int:
    """Measure and print; returns the exit code: 1 where a target was missed."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.levels", description=__doc__.splitlines()[0])
    parser.add_argument("game", choices=list(games()))
    parser.add_argument("--variant")
    parser.add_argument("--matches", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--arena")
    parser.add_argument("--json", action="store_true")
    words = parser.parse_args()
    try:
        table = measure(words.game, words.variant, words.matches, words.seed, words.arena)
    except ChoiceError as error:
        print(error, file=sys.stderr)
        return 2
    missed = misses(table)
    if words.json:
        print(json.dumps({"levels": table, "missed": missed}, indent=1))
    else:
        columns = list(dict.fromkeys(key for row in table.values() for key in row))
        print(f"{'':8}" + "".join(f"{column:>18}" for column in columns))
        for name, row in table.items():
            print(f"{name:8}" + "".join(f"{row.get(column, float('nan')):18.3f}" for column in columns))
        print("\n".join(["", *(missed or ["all targets reached"])]))
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
