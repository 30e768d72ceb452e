"""Who is better: many matches of two brains, fairly paired.

Each seed is played twice with the sides swapped, so that neither chance nor a start favours anyone. A win is to stand
before the other in the end, whatever the margin; the interval is Wilson's for the share of wins (Wilson, J. Am. Stat.
Assoc. 22, 1927, 209-212).
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import sqrt
from time import perf_counter
from typing import Any, NamedTuple

from pigaming_app.ai import BRAINS
from pigaming_app.ai.rollout import Batch
from pigaming_app.games import GAMES
from pigaming_app.games.choices import choose, one_of
from pigaming_app.games.game import PAIRS, Setup
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import HZ

WORTH_COMPILING = 300_000  # ticks, below which compiling takes longer than plain play


@dataclass(frozen=True)
class Duel:
    """How `left` fared against `right`. Scores are means of a match."""

    game: str
    left: str
    right: str
    matches: int
    wins: int
    ties: int
    losses: int
    wilson95: tuple[float, float]
    mean_score_left: float
    mean_score_right: float
    seconds: float
    ticks_per_second: float


def duel(
    game: str,
    left: str,
    right: str,
    matches: int,
    seed: int,
    minutes: float | None = None,
    arena: str | None = None,
    variant: str | None = None,
    fast: bool | None = None,
    goal: int | None = None,
) -> Duel:
    """Play `matches` matches of two brains. Raises ChoiceError or ArenaError.

    In a game of two pairs each brain drives both robots of its team. `fast`: compiled; left out: where numba is
    installed and it is worth the time.
    """
    one_of("game", game, list(GAMES))
    pairs = GAMES[game].sides == PAIRS
    brains = [left, right, left, right] if pairs else [left, right]
    kinds = list(BRAINS[game])
    setups = [choose(game, brains, arena, minutes, seed + i // 2, variant, None, kinds, goal) for i in range(matches)]
    ticks = round(setups[0].minutes * 60 * HZ)
    if fast is None:
        fast = can_compile() and matches * ticks > WORTH_COMPILING
    began = perf_counter()
    played = [Batch(some, [BRAINS[game][name] for name in order], fast) for some, order in _both_ways(setups, brains)]
    for batch in played:
        batch.play(ticks)
    seconds = perf_counter() - began
    ends = [end for batch, swapped in zip(played, (False, True), strict=False) for end in _ends(game, batch, swapped)]
    wins = sum(end.left > end.right for end in ends)
    ties = sum(end.left == end.right for end in ends)
    return Duel(
        game=game,
        left=left,
        right=right,
        matches=matches,
        wins=wins,
        ties=ties,
        losses=matches - wins - ties,
        wilson95=wilson(wins, matches),
        mean_score_left=sum(end.left_score for end in ends) / matches,
        mean_score_right=sum(end.right_score for end in ends) / matches,
        seconds=seconds,
        ticks_per_second=sum(batch.ticks() for batch in played) / seconds,
    )


class End(NamedTuple):
    """How a match of a duel ended: where each side stands, and its score."""

    left: float
    right: float
    left_score: int
    right_score: int


def _both_ways(setups: list[Setup], brains: list[str]) -> Iterator[tuple[list[Setup], list[str]]]:
    """Every other match as it is, and the others with the sides swapped; teams alternate from seat to seat."""
    swapped = [brains[i ^ 1] for i in range(len(brains))]
    for some, order in ((setups[::2], brains), (setups[1::2], swapped)):
        if some:
            yield some, order


def _ends(game: str, batch: Batch, swapped: bool) -> Iterator[End]:
    """The end of every match, from the side of `left`."""
    rules = GAMES[game]
    for state in batch.ended():
        one, other = ((rules.standing(state, seat), _score(state, seat)) for seat in (0, 1))
        if swapped:
            one, other = other, one
        yield End(one[0], other[0], one[1], other[1])


def _score(state: Any, seat: int) -> int:
    """The score of a seat's team."""
    team = state.robots[seat].team
    return sum(robot.score for robot in state.robots if robot.present and robot.team == team)


def wilson(wins: int, matches: int, z: float = 1.959964) -> tuple[float, float]:
    """The 95 % interval of a share of which `wins` of `matches` have been seen."""
    share = wins / matches
    centre = share + z * z / (2 * matches)
    spread = z * sqrt(share * (1 - share) / matches + z * z / (4 * matches * matches))
    whole = 1 + z * z / matches
    return max(0.0, (centre - spread) / whole), min(1.0, (centre + spread) / whole)
