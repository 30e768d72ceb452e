"""How often people, as models, win against the AIs: one of them against three, in teams with a mate of their kind.

`people fit FILES` finds the traits of people in replays.
"""

import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.people.matches import Place, Trial, places
from pigaming_app.ai.people.models import PEOPLE
from pigaming_app.ai.people.series import LEARNING, Series, series
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.game import ALLIES
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, require_game, require_one_of
from pigaming_app.jobs.terminal.options import AIS, JsonOption, SeedOption, argument, flag, games_and, integer, option
from pigaming_app.jobs.terminal.refusal import refused, require_for_brains
from pigaming_app.sim.arena import ArenaError

FIT = "fit"


@dataclass(frozen=True, kw_only=True)
class PeopleOptions(JsonOption, SeedOption):
    """The game, the people and their opponents; or `fit` and the files of replays."""

    game: str = argument(games_and(FIT), metavar="GAME | fit")
    levels: tuple[str, ...] = argument(
        f"opponents: {AIS}; default level1 to level5; after fit: replays", default=(), nargs="*", metavar="AI | FILE"
    )
    together: bool = flag("fit: the same seat is the same person in all files")
    people: tuple[str, ...] = option(
        f"masher, {', '.join(PEOPLE)}; also twice or more; default all", default=(), action="append", metavar="NAME"
    )
    matches: int = option("matches of each against each; default 400", integer(), 400, metavar="NUMBER")
    variant: str | None = option("set of rules; default: the game's first")
    scale: str | None = option("a trait of them and a factor, such as reaction=1.3", metavar="TRAIT=FACTOR")
    driving: str | None = option("driving style of beginner, player and expert: turn or point", metavar="STYLE")
    minutes: float | None = None
    auto: bool = flag("series of matches against Auto, from its weakest, a middle and its greatest strength")


def run(options: PeopleOptions) -> int:
    """Play and print the table, or fit. Raises Refusal."""
    if options.game == FIT:
        from pigaming_app.jobs.balance import fit  # needs NumPy

        return fit.run(options.levels, options.together, options.json)
    require_for_brains(options.levels)
    people, levels = options.people or ("masher", *PEOPLE), options.levels or LEVELS
    with refused(ChoiceError, ArenaError):
        require_game(options.game)
        rules = games()[options.game]
        if options.variant is not None:
            require_one_of("variant", options.variant, list(rules.variants))
        for level in levels:
            find_brain(options.game, level)
        trial = Trial(options.game, options.matches, options.seed, options.variant, options.minutes)
        if options.auto:
            played = series(trial, people, scale=options.scale, driving=options.driving)
            return _print_series(list(played), options.json)
        found = places(trial, people, levels, options.scale, options.driving)
    if options.json:
        rows = [{**asdict(place), "share": place.share, "wilson95": place.interval} for place in found]
        print(json.dumps({"game": options.game, "variant": options.variant or rules.default.name, "places": rows}))
    else:
        alone = trial.rules.team_mode == ALLIES
        print("\n".join(table(found, "points" if alone else "wins")))
    return 0


def _print_series(found: Sequence[Series], as_json: bool) -> int:
    """Wins after the first matches, and in each match, by person and first strength."""
    if as_json:
        rows = [{**asdict(one), "share": one.share, "wilson95": one.interval} for one in found]
        print(json.dumps({"series": rows}))
        return 0
    print(f"{'from':14}{f'wins after {LEARNING}':>20}   match by match")
    for one in found:
        low, high = one.interval
        after = f"{100 * one.share:.1f} [{100 * low:.0f}, {100 * high:.0f}]"
        print(f"{one.person:10}{one.first + 1:4}{after:>20}   {' '.join(f'{100 * won:.0f}' for won in one.wins)}")
    return 0


def table(found: Sequence[Place], measure: str) -> Iterator[str]:
    """A row for each of the people, a column for each opponent."""
    levels = list(dict.fromkeys(place.level for place in found))
    width = max(16, *(len(level) + 2 for level in levels))
    yield f"{measure:10}" + "".join(f"{level:>{width}}" for level in levels)
    for person in dict.fromkeys(place.person for place in found):
        cells = (cell(place, measure) for place in found if place.person == person)
        yield f"{person:10}" + "".join(f"{text:>{width}}" for text in cells)


def cell(place: Place, measure: str) -> str:
    """Share of the wins with its interval, in %; among allies their mean points."""
    if measure == "points":
        return f"{place.mean_score:.1f}"
    low, high = place.interval
    return f"{100 * place.share:.1f} [{100 * low:.0f}, {100 * high:.0f}]"
