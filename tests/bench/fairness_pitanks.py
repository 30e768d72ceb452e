"""PiTanks: ties, the worth of hits, standing still and wins by seat, of four equal robots and of two."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from pigaming_app.games.match import standings
from pigaming_app.games.registry import games
from tests.bench.trial import StandingStill, Trial, by_arena, live, of_robots, played


def measure(trial: Trial) -> Mapping[str, Any]:
    """Measures of the four robots of a trial, and of duels of its first two, by arena and over all."""
    duel = trial.of(*trial.brains[:2], "off", "off")
    return {"four robots": company(trial), "duels": company(duel)}


def company(trial: Trial) -> Mapping[str, Mapping[str, float]]:
    """Measures of one trial, by arena."""
    batch = trial.batch()
    standing = StandingStill(batch)
    present = of_robots(batch, "present") == 1
    for _ in played(trial, batch):
        standing.sample(batch, live(batch)[:, None] & present & (_tanks(batch, "knocked_out") == 0))
    ends = batch.ended()
    shares = np.where(present, standing.still / np.maximum(1, standing.free), np.nan)
    winners = [standings(games()[trial.game], end)[1] for end in ends]
    return {
        name: {
            "matches": len(numbers),
            "ties": _share([not winners[i] for i in numbers]),
            "most hits wins": _share(_most_hits_win(ends[i], winners[i]) for i in numbers),
            "standing still, median": float(np.nanmedian(shares[numbers])),
            "overtime": _share([ends[i].tick > ends[i].rules.ticks for i in numbers]),
            "hits a match": float(np.mean([sum(tank.hits for tank in ends[i].tanks) for i in numbers])),
            **{f"wins of seat {seat + 1}": _share([seat in winners[i] for i in numbers]) for seat in _seats(present)},
        }
        for name, numbers in by_arena(trial.setups)
    }


def _tanks(batch: Any, name: str) -> Any:
    if batch.fast:
        return batch.matches["tanks"][name]
    return np.array([[getattr(tank, name) for tank in match.tanks] for match in batch.matches])


def _most_hits_win(end: Any, winners: Sequence[int]) -> bool | None:
    """Whether the robot with most hits wins; None if several have as many."""
    hits = [tank.hits for tank in end.tanks]
    if hits.count(max(hits)) > 1:
        return None
    return hits.index(max(hits)) in winners


def _share(cases: Any) -> float:
    """Share of the cases that hold, of those that are not None."""
    known = [case for case in cases if case is not None]
    return sum(known) / max(1, len(known))


def _seats(present: Any) -> list[int]:
    return [int(seat) for seat in np.flatnonzero(present.any(axis=0))]
