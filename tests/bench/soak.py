"""Soak test: `python -m tests.bench.soak [HOURS]`. Exit code 1 where an invariant breaks.

The hours are shared among the games, and every simulated second of every match is checked: no NaN, no robot in a wall,
and the invariants of the game. Then 10,000 plain matches are created and played briefly: memory must stay flat. Last,
10,000 buttons are pressed on all screens: open files, threads and memory must stay level.
"""

import argparse
import resource
import sys
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.arenas import arenas
from pigaming_app.games.factory.state import IN_SLOT
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.pitanks.state import OWN_BULLETS
from pigaming_app.games.registry import games
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.record import unpack
from pigaming_app.sim.world import HZ, ROBOTS

BRAIN = ("level5", "random", "level3", "random")
ABREAST = 24  # matches at once
SECONDS = 120


def main(hours: float) -> int:
    """Run the three soak tests; returns the exit code."""
    wrong = [trouble for game in games() for seconds in day(game, hours / len(games())) for trouble in seconds]
    print(f"{hours:g} simulated hours: {len(wrong)} broken invariants", *wrong[:5], sep="\n  ")
    grown = memory()
    print(f"10,000 matches: memory grew by {grown:.1f} MB")
    from tests.bench import presses  # late: it loads every screen

    return int(bool(presses.main()) or bool(wrong) or grown > 8.0)


def setup(game: str, arena: str, seed: int) -> Setup:
    """A match with the longest goal."""
    rules = games()[game]
    one, two, three, four = (Seat(name, team) for name, team in zip(BRAIN, rules.default.teams, strict=True))
    goal = max(rules.default.goals, default=0)
    return Setup(game, arena, (one, two, three, four), 2.0, seed, rules.default.name, goal)


def day(game: str, hours: float) -> Iterator[list[str]]:
    """Broken invariants, checked after each simulated second, over all arenas."""
    seed, left = 1, hours * 3600.0
    while left > 0.0:
        for arena in arenas(game):
            setups = [setup(game, arena, seed + i) for i in range(ABREAST)]
            batch = Batch(setups, [BRAINS[game][name] for name in BRAIN], True)
            for _ in range(SECONDS):
                batch.play(HZ)
                yield [f"{game}, {arena}: {trouble}" for trouble in broken(game, batch)]
            seed += ABREAST
            left -= ABREAST * SECONDS


def broken(game: str, batch: Batch) -> list[str]:
    """The invariants that are broken now."""
    robots = batch.matches["robots"]
    wrong = [
        f"{field} is not a number"
        for field in ("x", "y", "heading", "linear", "angular", "turbo")
        if not np.isfinite(robots[field]).all()
    ]
    state = unpack(batch.state, batch.matches[batch.matches["tick"][0] // HZ % len(batch.matches)])
    wrong += [f"robot {i} stands in a wall" for i, r in enumerate(state.robots) if in_wall(state, r.x, r.y)]
    return wrong + PROMISES[game](batch.matches)


def pitanks(matches: Any) -> list[str]:
    """Scores sum to zero; no robot has more bullets than the rules allow."""
    wrong = ["scores do not sum to zero"] if matches["robots"]["score"].sum(axis=1).any() else []
    alive = matches["bullets"]["alive"].reshape(len(matches), ROBOTS, OWN_BULLETS).sum(axis=2)
    return wrong + (["too many bullets"] if (alive > matches["rules"]["boosted_alive"][:, None]).any() else [])


def race(matches: Any) -> list[str]:
    """Every rank occurs once; counted laps equal crossed lines."""
    ranks = np.sort(matches["racers"]["rank"], axis=1)
    wrong = [] if (ranks == np.arange(1, ROBOTS + 1)).all() else ["two robots share a rank"]
    laps = np.maximum(0, matches["racers"]["passed"] - 1) // ROBOTS
    return wrong + ([] if (laps == matches["robots"]["score"]).all() else ["a lap without its lines"])


def factory(matches: Any) -> list[str]:
    """No slot holds two pallets; every slot that holds one is where that pallet is."""
    pallets, slots = matches["pallets"], matches["slots"]
    lying = (pallets["exists"] > 0) & (pallets["place"] == IN_SLOT)
    wrong = [] if (lying.sum(axis=1) == (slots["pallet"] > 0).sum(axis=1)).all() else ["a pallet lost or doubled"]
    rows, which = np.nonzero(lying)
    there = slots["pallet"][rows, pallets["at"][rows, which]]
    return wrong + ([] if (there == which + 1).all() else ["a pallet in two places"])


PROMISES: dict[str, Callable[[Any], list[str]]] = {"pitanks": pitanks, "race": race, "factory": factory}


def memory() -> float:
    """Growth of the process, MB, over the last 9,000 of 10,000 short plain matches."""
    first = 0
    names = list(games())
    for i in range(10_000):
        game = names[i % len(names)]
        Batch([setup(game, arenas(game)[0], i)], [BRAINS[game][name] for name in BRAIN], False).play(5)
        if i == 1000:
            first = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - first) / 1024.0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.bench.soak", description="Soak test.")
    parser.add_argument("hours", type=float, nargs="?", default=24.0, help="simulated hours (24)")
    sys.exit(main(parser.parse_args().hours))
