"""Four equal AIs: ties, wins by seat (in a game of teams by team) and arena, and what a lead is worth."""

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from statistics import mean, median

from pigaming_app.ai.learning.league import wilson
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import find_brain, known_brains
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import ALLIES
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, make_setup, require_game, require_one_of
from pigaming_app.jobs.balance.leads import LEVEL, Lead, leads
from pigaming_app.jobs.terminal.options import JsonOption, SeedOption, argument, games_and, integer, option
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require_for_brains
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import ROBOTS

ALL = "all"


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
