"""Who is better: many matches of two brains, fairly paired.

Each seed is played twice with the sides swapped, so that neither chance nor a start favours anyone. A win counts as one
whatever its margin; the interval is Wilson's for the share of wins (Wilson, J. Am. Stat. Assoc. 22, 1927, 209-212).
"""

from dataclasses import dataclass
from math import sqrt
from time import perf_counter

from pigaming_app.ai import BRAINS
from pigaming_app.ai.rollout import Batch
from pigaming_app.games.choices import choose
from pigaming_app.games.game import Setup
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
    arena: str = "classic",
    variant: str | None = None,
    fast: bool | None = None,
) -> Duel:
    """Play `matches` matches of two brains. Raises ChoiceError or ArenaError.

    `fast`: compiled; left out: where numba is installed and it is worth the time.
    """
    kinds = BRAINS.get(game, {})
    setups = [
        choose(game, [left, right], arena, minutes, seed + i // 2, variant, None, list(kinds)) for i in range(matches)
    ]
    ticks = round(setups[0].minutes * 60 * HZ)
    if fast is None:
        fast = can_compile() and matches * ticks > WORTH_COMPILING
    began = perf_counter()
    there = _play(setups[::2], left, right, fast, ticks)
    back = [(one, other) for other, one in _play(setups[1::2], right, left, fast, ticks)]
    seconds = perf_counter() - began
    scores = there + back
    wins = sum(one > other for one, other in scores)
    ties = sum(one == other for one, other in scores)
    return Duel(
        game=game,
        left=left,
        right=right,
        matches=matches,
        wins=wins,
        ties=ties,
        losses=matches - wins - ties,
        wilson95=wilson(wins, matches),
        mean_score_left=sum(one for one, _ in scores) / matches,
        mean_score_right=sum(other for _, other in scores) / matches,
        seconds=seconds,
        ticks_per_second=matches * ticks / seconds,
    )


def wilson(wins: int, matches: int, z: float = 1.959964) -> tuple[float, float]:
    """The 95 % interval of a share of which `wins` of `matches` have been seen."""
    share = wins / matches
    centre = share + z * z / (2 * matches)
    spread = z * sqrt(share * (1 - share) / matches + z * z / (4 * matches * matches))
    whole = 1 + z * z / matches
    return max(0.0, (centre - spread) / whole), min(1.0, (centre + spread) / whole)


def _play(setups: list[Setup], one: str, other: str, fast: bool, ticks: int) -> list[tuple[int, int]]:
    """The scores of the first two seats in each match."""
    if not setups:
        return []
    kinds = BRAINS[setups[0].game]
    batch = Batch(setups, [kinds[one], kinds[other], None, None], fast)
    batch.play(ticks)
    return [(scores[0], scores[1]) for scores in batch.scores()]
