"""Who leads in the course of a match, and who wins it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.games.game import Setup
from pigaming_app.games.match import standings
from pigaming_app.games.registry import games
from pigaming_app.games.setup import longest
from pigaming_app.games.simple import team_points
from pigaming_app.sim.world import HZ

EVERY = HZ  # ticks from sample to sample
LEVEL = -1  # nobody leads alone, or a tie


@dataclass(frozen=True)
class Lead:
    """A match: the team that leads alone at each sample, and the winner; LEVEL: none."""

    leaders: tuple[int, ...]
    winner: int

    @property
    def half_time(self) -> int:
        """Who leads in the middle of the match."""
        return self.leaders[len(self.leaders) // 2] if self.leaders else LEVEL

    @property
    def first(self) -> int:
        """Who is the first to lead."""
        return next((team for team in self.leaders if team != LEVEL), LEVEL)

    @property
    def changes(self) -> int:
        """How often another team than before leads alone."""
        return sum(one != other for one, other in pairwise(team for team in self.leaders if team != LEVEL))


def leads(setups: Sequence[Setup], batch: Batch) -> list[Lead]:
    """The leads of matches not yet played, which are played to their ends."""
    leaders: list[list[int]] = [[] for _ in setups]
    for _ in range(0, max(map(longest, setups)), EVERY):
        batch.play(EVERY)
        live, keys = _live(batch), _keys(batch)
        for i in live:
            leaders[i].append(leader(keys(i, setups[i])))
        if not live:
            break
    ends = (standings(games()[batch.game], end)[1] for end in batch.ended())
    winners = [setup.seats[won[0]].team if won else LEVEL for setup, won in zip(setups, ends, strict=True)]
    return [Lead(tuple(line), winner) for line, winner in zip(leaders, winners, strict=True)]


def leader(keys: Mapping[int, float]) -> int:
    """The team with the highest key alone; LEVEL: none."""
    best = max(keys.values())
    first, *more = (team for team, key in keys.items() if key == best)
    return LEVEL if more else first


def _keys(batch: Batch) -> Callable[[int, Setup], Mapping[int, float]]:
    """The function that returns the ranking key of each team in a match, by its number and setup."""
    rank, scores = games()[batch.game].ranking_key, batch.scores()

    def points(i: int, setup: Setup) -> Mapping[int, float]:
        totals: dict[int, float] = {}
        for seat, team in _playing(setup):
            totals[team] = totals.get(team, 0.0) + scores[i][seat]
        return totals

    def ranked(i: int, setup: Setup) -> Mapping[int, float]:
        return {team: rank(_match(batch, i), seat) for seat, team in _playing(setup)}

    return points if rank is team_points else ranked  # the same, but ten times as fast


def _playing(setup: Setup) -> list[tuple[int, int]]:
    """Seat and team of each robot."""
    return [(seat, one.team) for seat, one in enumerate(setup.seats) if one.brain != "off"]


def _live(batch: Batch) -> list[int]:
    """The numbers of the matches that are not over."""
    over = batch.matches["over"] if batch.fast else [match.over for match in batch.matches]
    return [i for i, ended in enumerate(over) if not ended]


def _match(batch: Batch, i: int) -> Any:
    """A match to read, without a copy."""
    from numpy import recarray  # NumPy is an extra

    return batch.matches.view(recarray)[i] if batch.fast else batch.matches[i]
