"""Robot Factory: ties, wins by team, standing still, thefts and times of matches between equal teams.

`standing still`: share of a robot's time below SLOW px/s, while free to move, in stretches longer than LONG; the median
over robots. Positions are sampled every STEP ticks.
"""

from typing import Any

import numpy as np

from pigaming_app.ai.experiments.rollout import Batch
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import ALLIES
from pigaming_app.games.registry import games
from pigaming_app.games.setup import make_setup
from pigaming_app.sim.world import DT, HZ

STEP = 5  # ticks between two samples
SLOW, LONG = 20.0, 1.0  # px/s, s


def measure(variant: str, matches: int, brain: str = "hard", robots: int = 4) -> dict[str, Any]:
    """Figures of `matches` matches of four robots with the same brain, in equal parts on all floors."""
    floors = arenas("factory")
    ends, still = [], []
    for k, floor in enumerate(floors):
        share = matches // len(floors) + (k < matches % len(floors))
        rows, here = play(variant, floor, brain, robots, range(1, share + 1))
        ends.append(rows)
        still.append(here)
    rows, rest = np.concatenate(ends), np.concatenate(still)
    allies = games()["factory"].variants[variant].team_mode == ALLIES
    steps = np.stack([rows["loads"]["steps"][:, [0, 2]].sum(axis=1), rows["loads"]["steps"][:, [1, 3]].sum(axis=1)], 1)
    score = rows["points"] if variant == "party" else rows["delivered"]
    result = {
        "matches": len(rows),
        "seconds": round(float(rows["tick"].mean()) * DT, 1),
        "standing still, median": round(float(np.median(rest)), 3),
        "standing still, by floor": [round(float(np.median(part)), 3) for part in still],
        "spoiled": int(rows["loads"]["spoiled"].sum()),
        "hits on people, a robot": round(float(rows["loads"]["hits"].mean()), 2),
    }
    if allies:
        result["stars"] = [int((rows["stars"] == k).sum()) for k in range(4)]
        return result
    key = score * 1000 + np.minimum(steps, 999)
    return {
        **result,
        "wins by team": [round(float((key[:, t] > key[:, 1 - t]).mean()), 3) for t in range(2)],
        "wins by team and floor": [
            [round(float((k[:, t] > k[:, 1 - t]).mean()), 3) for t in range(2)]
            for k in np.split(key, np.cumsum([len(part) for part in ends])[:-1])
        ],
        "ties": round(float((key[:, 0] == key[:, 1]).mean()), 4),
        "level scores": round(float((score[:, 0] == score[:, 1]).mean()), 4),
        "score of a team": round(float(score.mean()), 2),
        "stolen, a match": round(float(rows["loads"]["stolen"].sum(axis=1).mean()), 2),
    }


def play(variant: str, floor: str, brain: str, robots: int, seeds: range) -> tuple[Any, Any]:
    """Play these matches to their ends; returns their records, and for each robot its share of standing still."""
    brains = [brain] * robots
    setups = [
        make_setup("factory", brains, floor, None, seed, variant, None, list(BRAINS["factory"])) for seed in seeds
    ]
    batch = Batch(setups, [BRAINS["factory"][name] for name in brains], True)
    matches = batch.matches
    slow, still, free = (np.zeros((len(seeds), robots)) for _ in range(3))
    while not matches["over"].all():
        batch.play(STEP)
        going = (matches["over"] == 0)[:, None]
        robot = matches["robots"][:, :robots]
        able = going & (matches["loads"]["frozen"][:, :robots] == 0)
        rests = able & (np.abs(robot["linear"]) < SLOW)
        slow = np.where(rests, slow + STEP, 0)
        free += STEP * able
        long = round(LONG * HZ)
        still += np.where(slow > long, np.where(slow - STEP > long, STEP, slow), 0)
    return matches, still / np.maximum(free, 1)


if __name__ == "__main__":
    import json
    import sys

    print(json.dumps(measure(sys.argv[1], int(sys.argv[2]), *sys.argv[3:4]), indent=1))
