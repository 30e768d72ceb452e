"""Robot Factory: ties, wins by team, standing still, thefts, times and stars of teams with equal brains."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from pigaming_app.games.game import ALLIES
from pigaming_app.games.registry import games
from pigaming_app.sim.world import DT
from tests.bench.trial import StandingStill, Trial, by_arena, live, of_parts, of_robots, played


def measure(trial: Trial) -> Mapping[str, Any]:
    """Measures of the matches of a trial, by arena and over all."""
    batch = trial.batch()
    standing = StandingStill(batch)
    present = of_robots(batch, "present") == 1
    for _ in played(trial, batch):
        standing.sample(batch, live(batch)[:, None] & present & (of_parts(batch, "loads", "frozen") == 0))
    ends = batch.ended()
    shares = standing.shares(present)
    figures = _stars if trial.rules.team_mode == ALLIES else _contest
    return {
        "equal teams": {
            name: {
                "matches": len(numbers),
                "seconds, mean": float(np.mean([ends[i].tick * DT for i in numbers])),
                "seconds, longest": float(max(ends[i].tick * DT for i in numbers)),
                "standing still, median": float(np.nanmedian(shares[numbers])),
                "people hit, a match": float(np.mean([sum(load.hits for load in ends[i].loads) for i in numbers])),
                "pallets spoiled": sum(load.spoiled for i in numbers for load in ends[i].loads),
                **figures([ends[i] for i in numbers]),
            }
            for name, numbers in by_arena(trial.setups)
        }
    }


def _contest(ends: list[Any]) -> Mapping[str, float]:
    """Measures of two teams."""
    keys = [[games()["factory"].ranking_key(end, _seat(end, team)) for team in range(2)] for end in ends]
    scores = [[sum(robot.score for robot in end.robots if robot.team == team) for team in range(2)] for end in ends]
    return {
        "ties": float(np.mean([one == other for one, other in keys])),
        "level scores": float(np.mean([one == other for one, other in scores])),
        "overtime": float(np.mean([end.tick > end.rules.ticks for end in ends])),
        "wins of Ice": float(np.mean([one > other for one, other in keys])),
        "wins of Fire": float(np.mean([one < other for one, other in keys])),
        "score of a team": float(np.mean(scores)),
        "stolen, a match": float(np.mean([sum(load.stolen for load in end.loads) for end in ends])),
    }


def _stars(ends: list[Any]) -> Mapping[str, float]:
    """Measures of allies."""
    return {f"{stars} stars": float(np.mean([end.stars == stars for end in ends])) for stars in range(4)}


def _seat(end: Any, team: int) -> int:
    """The first seat of a team."""
    return next(i for i, robot in enumerate(end.robots) if robot.present and robot.team == team)
