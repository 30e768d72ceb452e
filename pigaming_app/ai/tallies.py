"""Tallies: numbers that a match keeps for a seat, from which the environments make rewards."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from pigaming_app.games.simple import MatchState
from pigaming_app.sim.kernel import kernel


@kernel
def is_over(match: MatchState, seat: int) -> int:
    """1 if the match is over."""
    return int(match.over)


@dataclass(frozen=True)
class Tallies:
    """The tallies of a game. `tally` and `is_done` are kernels.

    `tally(match, seat, senses, totals)` fills the array `totals` in the order of the names; `senses` are those of the
    observation just made.

    `is_done(match, seat)` is 1 when nothing that the seat does can change its result any more.
    """

    names: tuple[str, ...]
    weights: Mapping[str, float]  # of the default reward; tallies that are not named count nothing
    tally: Callable[[Any, int, Any, Any], None]
    is_done: Callable[[Any, int], int] = is_over


@kernel
def sign(value: float) -> float:
    return 1.0 if value > 0 else -1.0 if value < 0 else 0.0
