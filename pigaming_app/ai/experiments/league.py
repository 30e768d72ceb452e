"""Who is better: many matches of two brains, fairly paired, and of every two of several.

Each seed is played twice with the sides swapped, so that neither chance nor a start favours anyone. A win is to stand
before the other in the end, whatever the margin; the interval is Wilson's for the share of wins (Wilson, J. Am. Stat.
Assoc. 22, 1927, 209-212). All pairs of a league play the same seeds.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import sqrt
from time import perf_counter
from typing import Any, NamedTuple

from pigaming_app.ai import BRAINS
from pigaming_app.ai.experiments.ratings import Rating, ratings
from pigaming_app.ai.experiments.rollout import Batch
from pigaming_app.games.game import PAIRS, Setup
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, make_setup, require_one_of
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import HZ

MOST_MATCHES = 100_000  # of a duel; all lie in memory at once
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


@dataclass(frozen=True)
class LeagueRow:
    """What became of one brain of a league, over all its matches."""

    brain: str
    rating: Rating
    wins: int
    ties: int
    losses: int
    wilson95: tuple[float, float]
    mean_score: float


@dataclass(frozen=True)
class League:
    """Every brain against every other: who stands where, the best first, and each pair's duel."""

    game: str
    arena: str
    minutes: float
    variant: str
    matches: int  # of each pair
    seed: int
    standings: tuple[LeagueRow, ...]
    duels: tuple[Duel, ...]
    seconds: float


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
    return meet(_setups(game, left, right, matches, seed, minutes, arena, variant, goal), left, right, fast)[0]


def league(
    game: str,
    brains: Sequence[str],
    matches: int,
    seed: int,
    minutes: float | None = None,
    arena: str | None = None,
    variant: str | None = None,
    fast: bool | None = None,
    goal: int | None = None,
    heard: Callable[[int, int, str, str], None] | None = None,
) -> League:
    """Let every two of the brains play a duel of `matches` matches. Raises ChoiceError or ArenaError.

    `heard` is called before each duel with its number from 0 on, how many there are, and who plays.
    """
    require_one_of("game", game, list(games()))
    check_brains(game, brains)
    began = perf_counter()
    duels, shares = [], {}
    pairs = list(combinations(range(len(brains)), 2))
    for number, (i, j) in enumerate(pairs):
        left, right = brains[i], brains[j]
        setups = _setups(game, left, right, matches, seed, minutes, arena, variant, goal)
        if heard:
            heard(number, len(pairs), left, right)
        played, ends = meet(setups, left, right, fast)
        duels.append(played)
        shares[i, j] = [_points(ends[k : k + 2]) for k in range(0, matches, 2)]
    rated = ratings(len(brains), shares, seed)
    standings = [_standing(brain, rating, duels) for brain, rating in zip(brains, rated, strict=True)]
    standings.sort(key=lambda standing: -standing.rating.rating)
    one = setups[0]
    told = game, one.arena, one.minutes, one.variant, matches, seed
    return League(*told, tuple(standings), tuple(duels), perf_counter() - began)


def check_brains(game: str, brains: Sequence[str]) -> None:
    """Whether these can be the brains of a league. Raises ChoiceError."""
    for brain in brains:
        require_one_of("brain", brain, list(BRAINS[game]))
        if brains.count(brain) > 1:
            raise ChoiceError(f"brain '{brain}' is named twice; in a league each plays once against each other")
    if len(brains) < 2:
        raise ChoiceError(f"a league needs two brains or more; {game} has {', '.join(BRAINS[game])}")


class Ending(NamedTuple):
    """How a match of a duel ended: where each side stands, and its score."""

    left: float
    right: float
    left_score: int
    right_score: int


def meet(setups: Sequence[Setup], left: str, right: str, fast: bool | None) -> tuple[Duel, list[Ending]]:
    """Play these matches, every other one with the sides swapped; how each ended, in their order."""
    game, matches = setups[0].game, len(setups)
    brains = [left, right, left, right] if games()[game].team_mode == PAIRS else [left, right]
    ticks = round(setups[0].minutes * 60 * HZ)
    if fast is None:
        fast = can_compile() and matches * ticks > WORTH_COMPILING
    began = perf_counter()
    played = [Batch(some, [BRAINS[game][name] for name in order], fast) for some, order in _both_ways(setups, brains)]
    for batch in played:
        batch.play(ticks)
    seconds = perf_counter() - began
    ends = [Ending(0.0, 0.0, 0, 0)] * matches
    for side, batch in enumerate(played):
        ends[side::2] = _ends(game, batch, swapped=side == 1)
    wins = sum(end.left > end.right for end in ends)
    ties = sum(end.left == end.right for end in ends)
    told = Duel(
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
    return told, ends


def _setups(
    game: str,
    left: str,
    right: str,
    matches: int,
    seed: int,
    minutes: float | None,
    arena: str | None,
    variant: str | None,
    goal: int | None,
) -> list[Setup]:
    """The matches of a duel, two of each seed. Raises ChoiceError."""
    require_one_of("game", game, list(games()))
    if not 1 <= matches <= MOST_MATCHES:
        raise ChoiceError(f"--matches: {matches}; possible are 1 to {MOST_MATCHES}")
    brains = [left, right, left, right] if games()[game].team_mode == PAIRS else [left, right]
    kinds = list(BRAINS[game])
    return [make_setup(game, brains, arena, minutes, seed + i // 2, variant, None, kinds, goal) for i in range(matches)]


def _both_ways(setups: Sequence[Setup], brains: list[str]) -> Iterator[tuple[Sequence[Setup], list[str]]]:
    """Every other match as it is, and the others with the sides swapped; teams alternate from seat to seat."""
    swapped = [brains[i ^ 1] for i in range(len(brains))]
    for some, order in ((setups[::2], brains), (setups[1::2], swapped)):
        if some:
            yield some, order


def _ends(game: str, batch: Batch, swapped: bool) -> Iterator[Ending]:
    """The end of every match, from the side of `left`."""
    rules = games()[game]
    for state in batch.ended():
        one, other = ((rules.ranking_key(state, seat), _score(state, seat)) for seat in (0, 1))
        if swapped:
            one, other = other, one
        yield Ending(one[0], other[0], one[1], other[1])


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


def _points(ends: Sequence[Ending]) -> tuple[float, float]:
    """What the sides won of these matches: 1 for a win, 1/2 for a tie."""
    won = sum(1.0 if end.left > end.right else 0.5 if end.left == end.right else 0.0 for end in ends)
    return won, len(ends) - won


def _standing(brain: str, rating: Rating, duels: Sequence[Duel]) -> LeagueRow:
    """The sum of a brain's duels."""
    wins = ties = losses = 0
    score = 0.0
    for one in duels:
        if brain in (one.left, one.right):
            left = brain == one.left
            wins, losses = wins + (one.wins if left else one.losses), losses + (one.losses if left else one.wins)
            ties, score = ties + one.ties, score + one.matches * (one.mean_score_left if left else one.mean_score_right)
    played = wins + ties + losses
    return LeagueRow(brain, rating, wins, ties, losses, wilson(wins, played), score / played)
