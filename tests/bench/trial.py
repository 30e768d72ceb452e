"""Matches of equal AIs for the measures of `tests.bench.fairness`, and the time that robots stand still."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from typing import Any

import numpy as np

from pigaming_app.ai.learning.league import MIN_COMPILED_MATCHES
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Setup, Variant
from pigaming_app.games.registry import games
from pigaming_app.games.setup import longest, make_setup
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import DT, HZ, ROBOTS

SAMPLE = HZ // 10  # ticks between two samples
STILL = 20.0  # px/s, below which a robot stands
WHILE = 1.0  # s, which a robot must stand before it counts


@dataclass(frozen=True)
class Trial:
    """Matches to play: `matches` of them, spread evenly over the arenas, with one seed each from `seed` on."""

    game: str
    variant: str
    matches: int
    seed: int
    brains: Sequence[str]  # by seat; off: no robot
    minutes: float | None = None
    arena: str | None = None  # None: all
    goal: int | None = None
    fast: bool = False  # compiled, however few ticks

    @property
    def rules(self) -> Variant:
        """The variant that is played."""
        return games()[self.game].variants[self.variant]

    @property
    def setups(self) -> list[Setup]:
        """One setup for each match. Raises ChoiceError."""
        names = [self.arena] if self.arena else arenas(self.game)
        places = [(names[i % len(names)], self.seed + i) for i in range(self.matches)]
        chosen, known = (self.variant, None), list(BRAINS[self.game])
        return [
            make_setup(self.game, self.brains, arena, self.minutes, seed, *chosen, known, self.goal)
            for arena, seed in places
        ]

    def batch(self) -> Batch:
        """All matches before their first tick. Raises ChoiceError."""
        setups = self.setups
        return Batch(setups, [BRAINS[self.game].get(brain) for brain in self.brains], self.fast or is_compiled(setups))

    def of(self, *brains: str) -> "Trial":
        """The same trial with other robots."""
        return replace(self, brains=brains)


def is_compiled(setups: Sequence[Setup]) -> bool:
    """True if numba is installed and there are enough ticks to repay compiling."""
    return can_compile() and sum(map(longest, setups)) > MIN_COMPILED_MATCHES


def played(trial: Trial, batch: Batch) -> Iterator[None]:
    """Play all matches of a trial to their ends, SAMPLE ticks at a time."""
    minutes = trial.setups[0].minutes
    for _ in range(0, round((minutes * 60 + trial.rules.overtime) * HZ), SAMPLE):
        batch.play(SAMPLE)
        yield
        if not live(batch).any():
            return


def live(batch: Batch) -> Any:
    """True for each match that is not over, (n,)."""
    return column(batch, "over") == 0


def column(batch: Batch, name: str) -> Any:
    """A number of every match, (n,)."""
    return batch.matches[name] if batch.fast else np.array([getattr(match, name) for match in batch.matches])


def of_parts(batch: Batch, parts: str, name: str) -> Any:
    """A number, or several, of each part of every match: of its `robots`, `tanks`, ..., (n, parts, ...)."""
    if batch.fast:
        return batch.matches[parts][name]
    return np.array([[getattr(part, name) for part in getattr(match, parts)] for match in batch.matches])


def of_robots(batch: Batch, name: str) -> Any:
    """A number of every robot, (n, ROBOTS)."""
    return of_parts(batch, "robots", name)


class StandingStill:
    """Time for which robots move by less than STILL for more than WHILE, as a share of their time free to move."""

    def __init__(self, batch: Batch) -> None:
        shape = len(batch.matches), ROBOTS
        self.at = np.array(of_robots(batch, "x")), np.array(of_robots(batch, "y"))
        self.since, self.still, self.free = np.zeros(shape, int), np.zeros(shape, int), np.zeros(shape, int)

    def sample(self, batch: Batch, free: Any) -> None:
        """Count one sample; `free`: True for each robot of a running match that may move, (n, ROBOTS)."""
        x, y = np.array(of_robots(batch, "x")), np.array(of_robots(batch, "y"))
        stands = free & (np.hypot(x - self.at[0], y - self.at[1]) < STILL * SAMPLE * DT)
        self.at, needed = (x, y), round(WHILE / (SAMPLE * DT))
        self.since = np.where(stands, self.since + 1, 0)
        self.still += np.where(self.since == needed + 1, needed + 1, self.since > needed)
        self.free += free

    def shares(self, present: Any, free: Any = None) -> Any:
        """The share of each robot, (n, ROBOTS); nan where it is not `present`. `free`: other samples than the own."""
        return np.where(present, self.still / np.maximum(1, self.free if free is None else free), np.nan)


def by_arena(setups: Sequence[Setup]) -> Iterator[tuple[str, list[int]]]:
    """Name of each arena and the numbers of its matches; first "all" with those of all."""
    yield "all", list(range(len(setups)))
    numbered = sorted(range(len(setups)), key=lambda i: setups[i].arena)
    for name, numbers in groupby(numbered, key=lambda i: setups[i].arena):
        yield name, list(numbers)
