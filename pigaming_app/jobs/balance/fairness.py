"""Wins by seat and arena, and ties, of four equal AIs; in a game of teams, wins by team."""

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from pigaming_app.ai.learning.league import wilson
from pigaming_app.ai.learning.line_ups import LineUps
from pigaming_app.ai.registry import known_brains
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import ALLIES
from pigaming_app.games.match import standings
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, make_setup, require_game, require_one_of
from pigaming_app.jobs.terminal.options import JsonOption, SeedOption, argument, games_and, integer, option
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require_for_brains
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import ROBOTS


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
    """Results in one arena. `wins`: by seat, or by team in a game of teams; ties are not among them."""

    arena: str
    matches: int
    ties: int
    wins: tuple[int, ...]

    @property
    def shares(self) -> list[float]:
        """Wins as shares of the decided matches."""
        return [won / max(1, sum(self.wins)) for won in self.wins]


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
    """Results in each arena. Raises ChoiceError or ArenaError."""
    line_ups = LineUps(options.game, [options.seats], can_compile())
    names = [options.arena] if options.arena else arenas(options.game)
    return [_in_arena(options, name, teams, line_ups) for name in names]


def _in_arena(options: FairnessOptions, arena: str, teams: Sequence[int], line_ups: LineUps) -> Fairness:
    game, brains = games()[options.game], [options.seats] * ROBOTS
    known = known_brains(options.game, brains)
    seeds = range(options.seed, options.seed + options.matches)
    setups = [
        make_setup(options.game, brains, arena, options.minutes, seed, options.variant, None, known) for seed in seeds
    ]
    winners = [standings(game, end)[1] for end in line_ups.played(setups)]
    won = [teams[found[0]] for found in winners if found]
    return Fairness(arena, len(setups), len(setups) - len(won), tuple(won.count(team) for team in sorted(set(teams))))


def table(found: Sequence[Fairness], noun: str) -> Iterator[str]:
    """A line for each arena: shares of the decided matches with their intervals, in %."""
    width = max(len(one.arena) for one in found) + 2
    yield f"{'':{width}}{'ties':>8}" + "".join(f"{f'{noun} {i + 1}':>16}" for i in range(len(found[0].wins)))
    for one in found:
        decided = max(1, sum(one.wins))
        cells = (f"{100 * won / decided:.1f} {_interval(won, decided)}" for won in one.wins)
        yield f"{one.arena:{width}}{100 * one.ties / one.matches:6.1f} %" + "".join(f"{text:>16}" for text in cells)


def _interval(won: int, of: int) -> str:
    low, high = wilson(won, of)
    return f"[{100 * low:.0f}, {100 * high:.0f}]"
