"""Four equal AIs: ties, wins by seat (in a game of teams by team) and arena, and what a lead is worth."""

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, pairwise
from statistics import mean, median
from typing import Any

from pigaming_app.ai.learning.league import wilson
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import find_brain, known_brains
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import ALLIES, Setup
from pigaming_app.games.match import standings
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, longest, make_setup, require_game, require_one_of
from pigaming_app.games.simple import team_points
from pigaming_app.jobs.terminal.options import JsonOption, SeedOption, argument, games_and, integer, option
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require_for_brains
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import HZ, ROBOTS

ALL = "all"
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


@dataclass(frozen=True, kw_only=True)
class FairnessOptions(JsonOption, SeedOption):
    """The game and the AI on all seats."""

    game: str = argument(games_and(), metavar="GAME")
    seats: str = option("the AI on all four seats; default level3", default="level3", metavar="AI")
    matches: int = option("matches in each arena; default 800", integer(), 800, metavar="NUMBER")
    variant: str | None = option("set of rules; default: the game's first")
    arena: str | None = option("one arena; default: all of the game", default=None)
    minutes: float | None = None


@dataclass(frozen=True)
class Fairness:
    """Results in one arena, or in all. `wins`: by seat, or by team in a game of teams; ties are not among them.

    Of the decided matches with a leader at half time: `turned`, the share that another team won. Of those in which
    somebody led: `first`, the share that the first to lead won. `changes`: median number of changes of the lead.
    """

    arena: str
    matches: int
    ties: int
    wins: tuple[int, ...]
    turned: float
    first: float
    changes: float

    @property
    def shares(self) -> list[float]:
        """Wins as shares of the decided matches."""
        return [won / max(1, sum(self.wins)) for won in self.wins]


def fairness(arena: str, found: Sequence[Lead], teams: Sequence[int]) -> Fairness:
    """The figures of some matches among these teams."""
    decided = [one for one in found if one.winner != LEVEL]
    wins = tuple(sum(one.winner == team for one in decided) for team in teams)
    turned = mean([one.winner != one.half_time for one in decided if one.half_time != LEVEL] or [0])
    first = mean([one.winner == one.first for one in decided if one.first != LEVEL] or [0])
    changes = median([one.changes for one in found])
    return Fairness(arena, len(found), len(found) - len(decided), wins, float(turned), float(first), float(changes))


def run(options: FairnessOptions) -> int:
    """Play and print. Raises Refusal."""
    require_for_brains((options.seats,))
    with refused(ChoiceError, ArenaError):
        require_game(options.game)
        rules = games()[options.game]
        if options.variant is not None:
            require_one_of("variant", options.variant, list(rules.variants))
        variant = rules.variants[options.variant] if options.variant else rules.default
        if variant.team_mode == ALLIES:
            raise Refusal(f"--variant {variant.name}: all robots are in one team")
        found = measured(options, variant.teams)
    if options.json:
        rows = [{**vars(one), "shares": one.shares} for one in found]
        print(json.dumps({"game": options.game, "variant": variant.name, "seats": options.seats, "arenas": rows}))
    else:
        noun = "team" if len(set(variant.teams)) < ROBOTS else "seat"
        print("\n".join(table(found, noun)))
    return 0


def measured(options: FairnessOptions, teams: Sequence[int]) -> list[Fairness]:
    """Results in each arena, and in all. Raises ChoiceError or ArenaError."""
    names = [options.arena] if options.arena else arenas(options.game)
    found = {name: _in_arena(options, name, k) for k, name in enumerate(names)}
    numbers = sorted(set(teams))
    rows = [fairness(name, matches, numbers) for name, matches in found.items()]
    return rows if options.arena else [*rows, fairness(ALL, [*chain(*found.values())], numbers)]


def _in_arena(options: FairnessOptions, arena: str, k: int) -> list[Lead]:
    """Matches in the k-th arena; each has a seed of its own, which also determines the day of its AIs."""
    brains = [options.seats] * ROBOTS
    known = known_brains(options.game, brains)
    seeds = (options.seed + options.matches * k + i for i in range(options.matches))
    setups = [
        make_setup(options.game, brains, arena, options.minutes, seed, options.variant, None, known) for seed in seeds
    ]
    return leads(setups, Batch(setups, [find_brain(options.game, options.seats)] * ROBOTS, can_compile()))


def table(found: Sequence[Fairness], noun: str) -> Iterator[str]:
    """A line for each arena: shares of the decided matches with their intervals, in %, and the course of matches."""
    width = max(len(one.arena) for one in found) + 2
    seats = "".join(f"{f'{noun} {i + 1}':>16}" for i in range(len(found[0].wins)))
    yield f"{'':{width}}{'ties':>8}{seats}{'turned':>9}{'first':>9}{'changes':>9}"
    for one in found:
        cells = (interval(won, sum(one.wins)) for won in one.wins)
        course = f"{100 * one.turned:7.1f} %{100 * one.first:7.1f} %{one.changes:9g}"
        ties = f"{100 * one.ties / one.matches:6.1f} %"
        yield f"{one.arena:{width}}{ties}{''.join(f'{text:>16}' for text in cells)}{course}"


def interval(won: int, of: int) -> str:
    """A share and Wilson's interval, 95 %, in %."""
    low, high = wilson(won, max(1, of))
    return f"{100 * won / max(1, of):.1f} [{100 * low:.0f}, {100 * high:.0f}]"
