"""Robot Race: ties, wins by seat and by line, lead changes, standing still, of equal drivers."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from pigaming_app.games.race.start import ranking_key
from tests.bench.trial import StandingStill, Trial, by_arena, column, live, of_parts, of_robots, played


def measure(trial: Trial) -> Mapping[str, Any]:
    """Measures of the drivers of a trial, by track and over all."""
    batch = trial.batch()
    standing, leads = StandingStill(batch), LeadChanges(len(batch.matches))
    present = of_robots(batch, "present") == 1
    lines = np.array(of_parts(batch, "racers", "line"))
    common = bool(batch.ended()[0].rules.party)
    starts = (
        np.argsort(np.argsort(-of_parts(batch, "racers", "progress"), axis=1, kind="stable"), axis=1)
        if common
        else lines
    )
    for _ in played(trial, batch):
        standing.sample(batch, live(batch)[:, None] & present & (of_parts(batch, "racers", "finished") == 0))
        leads.sample(np.where(present, of_parts(batch, "racers", "passed"), 0), of_parts(batch, "racers", "rank"))
    keys = np.array([[ranking_key(match, seat) for seat in range(present.shape[1])] for match in batch.ended()])
    keys[~present] = -np.inf
    best = np.sort(keys, axis=1)
    ties, winners = best[:, -1] == best[:, -2], keys.argmax(axis=1)
    won = np.arange(present.shape[1]) == winners[:, None]
    shares = standing.shares(present)
    place = "place on the grid" if common else "line"
    seconds = column(batch, "tick") / 50.0
    return {
        "drivers": {
            name: {
                "matches": len(numbers),
                "ties": float(ties[numbers].mean()),
                "lead changes a race": float(leads.changes[numbers].mean()),
                "standing still, median": float(np.nanmedian(shares[numbers])),
                "seconds a race": float(seconds[numbers].mean()),
                **{
                    f"wins of seat {seat + 1}": float((won[numbers, seat] & ~ties[numbers]).mean())
                    for seat in np.flatnonzero(present.any(axis=0))
                },
                **{
                    f"wins of {place} {start + 1}": float(
                        ((won & (starts == start))[numbers].any(axis=1) & ~ties[numbers]).mean()
                    )
                    for start in range(present.shape[1])
                },
            }
            for name, numbers in by_arena(trial.setups)
        }
    }


class LeadChanges:
    """Counts how often another racer than before is the first to cross the next line."""

    def __init__(self, matches: int) -> None:
        self.changes = np.zeros(matches, int)
        self._leader, self._crossed = np.full(matches, -1), np.zeros(matches, int)

    def sample(self, passed: Any, rank: Any) -> None:
        """Lines crossed by each racer, and its rank, (n, ROBOTS)."""
        most = passed.max(axis=1)
        ahead = most > self._crossed
        first = np.where(passed == most[:, None], rank, np.inf).argmin(axis=1)
        self.changes += ahead & (self._leader >= 0) & (self._leader != first)
        self._leader, self._crossed = np.where(ahead, first, self._leader), np.maximum(most, self._crossed)
