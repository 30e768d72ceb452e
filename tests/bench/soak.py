"""A day in the simulator: `python -m tests.bench.soak [HOURS]`. Exit code 1 where an invariant breaks.

Every simulated second of every match: no number is NaN, nobody stands in a wall, scores sum to zero in free-for-all, no
robot has more bullets than it may. Then 10,000 plain-record matches are made and played briefly: memory stays flat.
"""

import resource
import sys
from collections.abc import Iterator
from typing import Any

import numpy as np

from pigaming_app.ai import BRAINS
from pigaming_app.ai.rollout import Batch
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.pitanks.state import OWN_BULLETS, PiTanks
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.record import unpack
from pigaming_app.sim.world import HZ, ROBOTS

GAME = "pitanks"
BRAIN = ("hard", "random", "normal", "random")
ABREAST = 24  # matches at once


def main(hours: float) -> int:
    """Run both soaks; the exit code."""
    wrong = [trouble for seconds in day(hours) for trouble in seconds]
    print(f"{hours:g} simulated hours: {len(wrong)} broken invariants", *wrong[:5], sep="\n  ")
    grown = memory()
    print(f"10,000 matches: memory grew by {grown:.1f} MB")
    return int(bool(wrong) or grown > 8.0)


def day(hours: float) -> Iterator[list[str]]:
    """What is wrong after each simulated second, over all arenas."""
    seed, left = 1, hours * 3600.0
    while left > 0.0:
        for arena in arenas(GAME):
            one, two, three, four = (Seat(name, i) for i, name in enumerate(BRAIN))
            setups = [Setup(GAME, arena, (one, two, three, four), 2.0, seed + i, "pickups") for i in range(ABREAST)]
            batch = Batch(setups, [BRAINS[GAME][name] for name in BRAIN], True)
            for _ in range(120):
                batch.play(HZ)
                yield broken(batch.matches)
            seed += ABREAST
            left -= ABREAST * 120.0


def broken(matches: Any) -> list[str]:
    """The invariants that do not hold now."""
    robots, bullets = matches["robots"], matches["bullets"]
    wrong = []
    for field in ("x", "y", "heading", "linear", "angular", "turbo"):
        if not np.isfinite(robots[field]).all():
            wrong.append(f"{field} is not a number")
    if robots["score"].sum(axis=1).any():
        wrong.append("scores do not sum to zero")
    alive = bullets["alive"].reshape(len(matches), ROBOTS, OWN_BULLETS).sum(axis=2)
    if (alive > matches["rules"]["boosted_alive"][:, None]).any():
        wrong.append("too many bullets")
    state = unpack(PiTanks, matches[matches["tick"][0] // HZ % len(matches)])
    wrong += [f"robot {i} stands in a wall" for i, r in enumerate(state.robots) if in_wall(state, r.x, r.y)]
    return wrong


def memory() -> float:
    """MB by which the process grew while the last 9,000 of 10,000 short plain matches were played."""
    one, two, three, four = (Seat(name, i) for i, name in enumerate(BRAIN))
    kinds = [BRAINS[GAME][name] for name in BRAIN]
    first = 0
    for i in range(10_000):
        Batch([Setup(GAME, "classic", (one, two, three, four), 2.0, i, "pickups")], kinds, False).play(5)
        if i == 1000:
            first = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - first) / 1024.0


if __name__ == "__main__":
    sys.exit(main(float(sys.argv[1]) if len(sys.argv) > 1 else 24.0))
