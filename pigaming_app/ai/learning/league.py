"""Duels of two brains over many paired matches, and round-robin leagues of several.

Each seed is played twice with the sides swapped, so that neither luck nor the starting place favours a side. A win is
the better final ranking, whatever the margin; allies have no opponents, so each brain plays the seeds alone, on all
four seats, and the better ranking wins. The interval is Wilson's for the share of wins (Wilson, J. Am. Stat.
Assoc. 22, 1927, 209-212). All pairs of a league play the same seeds.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from math import sqrt
from time import perf_counter
from typing import NamedTuple

from pigaming_app.ai.brain_files import is_path, stem_of
from pigaming_app.ai.learning.ratings import Rating, ratings
from pigaming_app.ai.learning.rollout import Batch, rehearse
from pigaming_app.ai.plugin_faults import bound, check
from pigaming_app.ai.registry import BRAINS, find_brain, known_brains
from pigaming_app.games.game import ALLIES, PAIRS, Setup, Variant
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, longest, make_setup, require_game, require_one_of
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import ROBOTS

MAX_MATCHES = 100_000  # in a duel; all are in memory at once
MIN_COMPILED_MATCHES = 300_000  # ticks; below this compiling takes longer than interpreted play


@dataclass(frozen=True)
class Duel:
    """Result of `left` against `right`. Scores are means per match."""

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
    """Result of one brain over all its matches of a league."""

    brain: str
    rating: Rating
    wins: int
    ties: int
    losses: int
    wilson95: tuple[float, float]
    mean_score: float


@dataclass(frozen=True)
class League:
    """Result of a round robin: the standings, best first, and every pair's duel."""

    game: str
    arena: str
    minutes: float
    variant: str
    matches: int  # per pair
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

    In a game of two pairs each brain drives both robots of its team, among allies all four. `fast`: compiled; None:
    compiled if numba is installed and there are enough ticks to repay compiling.
    """
    return play_duel(_setups(game, left, right, matches, seed, minutes, arena, variant, goal), left, right, fast)[0]


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
    progress: Callable[[int, int, str, str], None] | None = None,
) -> League:
    """Play a duel of `matches` matches between every two brains. Raises ChoiceError or ArenaError.

    `progress(number, count, left, right)` is called before each duel; `number` counts from 0.
    """
    require_game(game)
    check_brains(game, brains)
    began = perf_counter()
    duels, shares = [], {}
    pairs = list(combinations(range(len(brains)), 2))
    for number, (i, j) in enumerate(pairs):
        left, right = brains[i], brains[j]
        setups = _setups(game, left, right, matches, seed, minutes, arena, variant, goal)
        if progress:
            progress(number, len(pairs), left, right)
        result, ends = play_duel(setups, left, right, fast)
        duels.append(result)
        shares[i, j] = [_points(ends[k : k + 2]) for k in range(0, matches, 2)]
    rated, shown = ratings(len(brains), shares, seed), names(brains)
    duels = [replace(duel, left=shown[duel.left], right=shown[duel.right]) for duel in duels]
    rows = [_row(shown[brain], rating, duels) for brain, rating in zip(brains, rated, strict=True)]
    rows.sort(key=lambda row: -row.rating.rating)
    setup = setups[0]
    options = game, setup.arena, setup.minutes, setup.variant, matches, seed
    return League(*options, tuple(rows), tuple(duels), perf_counter() - began)


def check_brains(game: str, brains: Sequence[str]) -> None:
    """Check the entrants of a league. Raises ChoiceError for unknown, repeated or too few brains."""
    for brain in brains:
        find_brain(game, brain)
        if brains.count(brain) > 1:
            raise ChoiceError(f"brain '{brain}' is named twice; in a league each plays once against each other")
    if len(brains) < 2:
        raise ChoiceError(f"a league needs two brains or more; {game} has {', '.join(BRAINS[game])}")


def names(brains: Sequence[str]) -> dict[str, str]:
    """The name of each entrant in results: of a file its stem, or its path if another entrant has that name."""
    stems = {brain: stem_of(brain) if is_path(brain) else brain for brain in brains}
    return {brain: stem if [*stems.values()].count(stem) == 1 else brain for brain, stem in stems.items()}


class DuelEnd(NamedTuple):
    """End of one match of a duel: ranking key (higher is better) and score of each side."""

    left: float
    right: float
    left_score: int
    right_score: int


def play_duel(setups: Sequence[Setup], left: str, right: str, fast: bool | None) -> tuple[Duel, list[DuelEnd]]:
    """Play these matches, every other one with the sides swapped; returns the duel and each match's end, in order.

    Allies play each match twice, once with either brain.
    """
    game, matches = setups[0].game, len(setups)
    variant = games()[game].variants[setups[0].variant]
    allies = variant.team_mode == ALLIES
    ticks = longest(setups[0])
    if fast is None:
        fast = can_compile() and matches * ticks > MIN_COMPILED_MATCHES
    kinds = {name: find_brain(game, name) for name in (left, right)}
    fast = fast and not any(kind.plain for kind in kinds.values())
    began = perf_counter()
    if allies:
        halves = [(setups, [name] * ROBOTS) for name in (left, right)]
    else:
        halves = [*_both_ways(setups, _line_up(variant, left, right))]
    if fast:
        rehearse(setups[0], [kinds[name] for name in halves[0][1]])
    batches: list[Batch] = []
    for half, order in halves:
        twin = batches[0] if batches and half == halves[0][0][: len(half)] else None
        batches.append(Batch(half, [kinds[name] for name in order], fast, twin=twin))
    for batch in batches:
        batch.play(bound(game, ticks))
    seconds = perf_counter() - began
    ends = [DuelEnd(0.0, 0.0, 0, 0)] * matches
    if allies:
        ends = [*_allied_ends(game, *batches)]
    else:
        for side, batch in enumerate(batches):
            ends[side::2] = _ends(game, batch, swapped=side == 1)
    wins = sum(end.left > end.right for end in ends)
    ties = sum(end.left == end.right for end in ends)
    result = Duel(
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
        ticks_per_second=sum(batch.ticks() for batch in batches) / seconds,
    )
    return result, ends


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
    """Setups of a duel, two per seed; among allies, one. Raises ChoiceError or ArenaError."""
    require_game(game)
    if not 1 <= matches <= MAX_MATCHES:
        raise ChoiceError(f"--matches: {matches}; possible are 1 to {MAX_MATCHES}")
    if seed < 0:
        raise ChoiceError(f"--seed: {seed} is of a training; seeds of measurements begin at 0")
    variants = games()[game].variants
    variant = games()[game].default.name if variant is None else variant
    require_one_of("variant", variant, list(variants))
    brains, kinds = _line_up(variants[variant], left, right), known_brains(game, [left, right])
    each = 1 if variants[variant].team_mode == ALLIES else 2
    first = make_setup(game, brains, arena, minutes, seed, variant, None, kinds, goal)
    return [replace(first, seed=seed + i // each) for i in range(matches)]


def _line_up(variant: Variant, left: str, right: str) -> list[str]:
    """The brain of each seat; in a game of two pairs each brain has a whole team, among allies `left` has all seats."""
    if variant.team_mode == ALLIES:
        return [left] * ROBOTS
    return [left, right, left, right] if variant.team_mode == PAIRS else [left, right]


def _both_ways(setups: Sequence[Setup], brains: list[str]) -> Iterator[tuple[Sequence[Setup], list[str]]]:
    """The even setups with the brains in order and the odd ones with the sides swapped; teams alternate by seat."""
    swapped = [brains[i ^ 1] for i in range(len(brains))]
    for half, order in ((setups[::2], brains), (setups[1::2], swapped)):
        if half:
            yield half, order


def _ends(game: str, batch: Batch, swapped: bool) -> Iterator[DuelEnd]:
    """End of every match, as seen by `left`."""
    rules, states = games()[game], batch.ended()
    check(game, states)
    for state in states:
        left, right = ((rules.ranking_key(state, seat), _score(state, seat)) for seat in (0, 1))
        if swapped:
            left, right = right, left
        yield DuelEnd(left[0], right[0], left[1], right[1])


def _allied_ends(game: str, lefts: Batch, rights: Batch) -> Iterator[DuelEnd]:
    """End of every match of allies, played by `left` and by `right`."""
    rules, states = games()[game], (lefts.ended(), rights.ended())
    check(game, [*states[0], *states[1]])
    for left, right in zip(*states, strict=True):
        keys = rules.ranking_key(left, 0), rules.ranking_key(right, 0)
        yield DuelEnd(*keys, _score(left, 0), _score(right, 0))


def _score(state: MatchState, seat: int) -> int:
    """Score of the seat's team."""
    team = state.robots[seat].team
    return sum(robot.score for robot in state.robots if robot.present and robot.team == team)


def wilson(wins: float, matches: int, z: float = 1.959964) -> tuple[float, float]:
    """Wilson score interval for a share, given `wins` out of `matches`, ties perhaps for half; 95 % by default."""
    share = wins / matches
    centre = share + z * z / (2 * matches)
    spread = z * sqrt(share * (1 - share) / matches + z * z / (4 * matches * matches))
    whole = 1 + z * z / matches
    return max(0.0, (centre - spread) / whole), min(1.0, (centre + spread) / whole)


def _points(ends: Sequence[DuelEnd]) -> tuple[float, float]:
    """Points of both sides over these matches: 1 for a win, 1/2 for a tie."""
    won = sum(1.0 if end.left > end.right else 0.5 if end.left == end.right else 0.0 for end in ends)
    return won, len(ends) - won


def _row(brain: str, rating: Rating, duels: Sequence[Duel]) -> LeagueRow:
    """Sum of a brain's duels."""
    wins = ties = losses = 0
    score = 0.0
    for met in duels:
        if brain in (met.left, met.right):
            left = brain == met.left
            wins, losses = wins + (met.wins if left else met.losses), losses + (met.losses if left else met.wins)
            ties, score = ties + met.ties, score + met.matches * (met.mean_score_left if left else met.mean_score_right)
    played = wins + ties + losses
    return LeagueRow(brain, rating, wins, ties, losses, wilson(wins, played), score / played)
