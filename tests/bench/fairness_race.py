"""Fairness of Robot Race with four equal drivers: wins by seat and by line, ties, lead changes, standing still.

All drivers have the same brain; the seed of a race deals lines, or places on the grid, to the seats.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median
from typing import Any

import numpy as np

from pigaming_app.ai.experiments.rollout import Batch
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.race.state import LINES
from pigaming_app.games.registry import games
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import HZ, ROBOTS

SLOW = 20.0  # px/s, below which a robot stands
STANDING = HZ  # ticks of it, beyond which it counts
SIDES = ("seat", "start")


@dataclass(frozen=True)
class Fairness:
    """Figures of many races. `start`: the line, in driving order, or the place on the common grid."""

    track: str
    races: int
    ties: float  # share of races
    wins_by_seat: tuple[float, ...]  # shares of races
    wins_by_start: tuple[float, ...]
    lead_changes: float  # at crossings of lines, mean per race
    standing: float  # share of the time, median over robots
    seconds: float  # mean length of a race
    margin: float  # s between the first two, median


def measure(
    variant: str = "standard", matches: int = 400, brain: str = "hand2", seed: int = 1, tracks: Sequence[str] = ()
) -> list[Fairness]:
    """Figures of `matches` races on each track (default: all)."""
    return [_track(track, variant, matches, brain, seed) for track in tracks or arenas("race")]


def _track(track: str, variant: str, matches: int, brain: str, seed: int) -> Fairness:
    one, two, three, four = (Seat(brain, i) for i in range(ROBOTS))
    rules = games()["race"].variants[variant]
    setups = [
        Setup("race", track, (one, two, three, four), 10.0, seed + i, variant, rules.default_goal)
        for i in range(matches)
    ]
    batch = Batch(setups, [BRAINS["race"][brain]] * ROBOTS, can_compile())
    states: Any = batch.matches
    start = np.argsort(np.argsort(-states["racers"]["progress"], axis=1, kind="stable"), axis=1)
    if not states["rules"]["party"].any():
        start = states["racers"]["line"].copy()
    leader, best, changes = np.full(matches, -1), np.zeros(matches, int), np.zeros(matches, int)
    slow, stood, free = (np.zeros((matches, ROBOTS), int) for _ in range(3))
    while not states["over"].all():
        batch.play(1)
        racers, going = states["racers"], states["over"] == 0
        passed = racers["passed"].max(axis=1)
        crossed = going & (passed > best)
        first = np.where(racers["passed"] == passed[:, None], racers["rank"], ROBOTS + 1).argmin(axis=1)
        changes += crossed & (leader >= 0) & (leader != first)
        leader, best = np.where(crossed, first, leader), np.maximum(best, passed)
        moving = going[:, None] & (racers["finished"] == 0)
        slow = np.where(moving & (np.abs(states["robots"]["linear"]) < SLOW), slow + 1, 0)
        stood += np.where(slow == STANDING + 1, STANDING + 1, slow > STANDING)
        free += moving
    keys = np.where(states["racers"]["finished"] == 1, 1e9 - states["racers"]["finish"], states["racers"]["progress"])
    order = np.sort(keys, axis=1)
    ties = order[:, -1] == order[:, -2]
    won = keys.argmax(axis=1)[~ties]
    lines = start[np.flatnonzero(~ties), won]
    return Fairness(
        track,
        matches,
        float(ties.mean()),
        tuple(np.bincount(won, minlength=ROBOTS) / matches),
        tuple(np.bincount(lines, minlength=LINES) / matches),
        float(changes.mean()),
        median((stood / np.maximum(free, 1)).ravel().tolist()),
        float(states["tick"].mean() / HZ),
        float(np.median(order[:, -1] - order[:, -2]) / HZ),
    )
