"""PiTanks: ties, the worth of hits, standing still, revenge and wins by seat, of four equal robots and of two.

A robot camps while it stands still and no opponent has a clear line to it.
"""

from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np

from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.games.match import standings
from pigaming_app.games.registry import games
from pigaming_app.sim.kernel import compiled
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import ROBOTS
from tests.bench.trial import StandingStill, Trial, by_arena, column, live, of_parts, of_robots, played


def measure(trial: Trial) -> Mapping[str, Any]:
    """Measures of the four robots of a trial, and of duels of its first two, by arena and over all."""
    duel = trial.of(*trial.brains[:2], "off", "off")
    return {"four robots": company(trial), "duels": company(duel)}


def company(trial: Trial) -> Mapping[str, Mapping[str, float]]:
    """Measures of one trial, by arena."""
    batch = trial.batch()
    standing, camping, grudges = StandingStill(batch), StandingStill(batch), Grudges(trial.matches)
    present = of_robots(batch, "present") == 1
    for _ in played(trial, batch):
        standing.sample(batch, live(batch)[:, None] & present & (of_parts(batch, "tanks", "knocked_out") == 0))
        camping.sample(batch, unseen(batch, standing.since > 0))
        grudges.sample(batch)
    ends = batch.ended()
    shares, camped = standing.shares(present), camping.shares(present, standing.free)
    winners = [standings(games()[trial.game], end)[1] for end in ends]
    return {
        name: {
            "matches": len(numbers),
            "ties": _share([not winners[i] for i in numbers]),
            "most hits wins": _share(_most_hits_win(ends[i], winners[i]) for i in numbers),
            "standing still, median": float(np.nanmedian(shares[numbers])),
            "camping": float(np.nanmean(camped[numbers])),
            "overtime": _share([ends[i].tick > ends[i].rules.ticks for i in numbers]),
            **({"revenge": grudges.share(numbers)} if ends[0].rules.knockout else {}),
            "hits a match": float(np.mean([sum(tank.hits for tank in ends[i].tanks) for i in numbers])),
            **{f"wins of seat {seat + 1}": _share([seat in winners[i] for i in numbers]) for seat in _seats(present)},
        }
        for name, numbers in by_arena(trial.setups)
    }


class Grudges:
    """Of the hits that knock out: how often the next hit between the same two robots is the victim's.

    Of several hits in one sample only the last is seen.
    """

    def __init__(self, matches: int) -> None:
        self.seen = np.zeros(matches, int)
        self.shooter: dict[tuple[int, frozenset[int]], int] = {}  # of the last hit, by match and pair
        self.returned, self.repeated = np.zeros(matches, int), np.zeros(matches, int)

    def sample(self, batch: Batch) -> None:
        """Count the last hit of every match, if it is a new one."""
        hits, shooters, victims = (column(batch, f"last_{name}") for name in ("hit", "shooter", "victim"))
        for i in np.flatnonzero(hits != self.seen):
            shooter, pair = int(shooters[i]), (int(i), frozenset((int(shooters[i]), int(victims[i]))))
            if pair in self.shooter:
                self.returned[i] += self.shooter[pair] != shooter
                self.repeated[i] += self.shooter[pair] == shooter
            self.shooter[pair] = shooter
        self.seen = np.array(hits)

    def share(self, matches: Sequence[int]) -> float:
        """The share over these matches; 0 without such hits."""
        returned, repeated = self.returned[matches].sum(), self.repeated[matches].sum()
        return float(returned / max(1, returned + repeated))


def unseen(batch: Batch, robots: Any) -> Any:
    """Those of `robots`, (n, ROBOTS), to which no opponent has a clear line."""
    hidden = robots.astype(np.int64)
    if hidden.any():
        (_compiled_search() if batch.fast else search)(batch.matches, hidden)
    return hidden == 1


def search(matches: Any, hidden: Any) -> None:
    """Clear the flag of each robot of `hidden`, (n, ROBOTS), that an opponent sees."""
    for i in range(len(matches)):
        match = matches[i]
        for seat in range(ROBOTS):
            robot = match.robots[seat]
            for other in match.robots:
                if hidden[i, seat] and other.present and other.team != robot.team:
                    hidden[i, seat] = not is_clear(match, robot.x, robot.y, other.x, other.y, 0.0)


@cache
def _compiled_search() -> Any:
    return compiled(search)


def _most_hits_win(end: Any, winners: Sequence[int]) -> bool | None:
    """Whether the robot with most hits wins; None if several have as many."""
    hits = [tank.hits for tank in end.tanks]
    if hits.count(max(hits)) > 1:
        return None
    return hits.index(max(hits)) in winners


def _share(cases: Any) -> float:
    """Share of the cases that hold, of those that are not None."""
    known: list[float] = [case for case in cases if case is not None]
    return sum(known) / max(1, len(known))


def _seats(present: Any) -> list[int]:
    return [int(seat) for seat in np.flatnonzero(present.any(axis=0))]
