"""From words that a person typed to a checked setup."""

from collections.abc import Sequence

from pigaming_app.games import GAMES
from pigaming_app.games.game import Seat, Setup
from pigaming_app.sim.world import ROBOTS

PEOPLE = ("human", "off")
LEAST_MINUTES, MOST_MINUTES = 0.05, 60.0


class ChoiceError(ValueError):
    """Something that was asked for and is not there, in one line."""


def choose(
    game: str,
    brains: Sequence[str],
    arena: str,
    minutes: float | None,
    seed: int,
    variant: str | None,
    teams: Sequence[int] | None,
    known: Sequence[str],
) -> Setup:
    """A setup of what was asked for; `known` are the names of the game's brains. Raises ChoiceError."""
    one_of("game", game, list(GAMES))
    rules = GAMES[game]
    for brain in brains:
        one_of("seat", brain, [*PEOPLE, *known])
    if len(brains) > ROBOTS:
        raise ChoiceError(f"--seats names {len(brains)} seats, but there are {ROBOTS}")
    brains = [*brains, *["off"] * (ROBOTS - len(brains))]
    teams = list(range(ROBOTS)) if teams is None else list(teams)
    if len(teams) != ROBOTS:
        raise ChoiceError(f"--teams needs {ROBOTS} numbers, one for each seat")
    playing = [team for brain, team in zip(brains, teams, strict=True) if brain != "off"]
    if len(playing) < 2:
        raise ChoiceError("at least two seats must be taken")
    if len(set(playing)) < 2:
        raise ChoiceError("there must be at least two teams")
    minutes = float(rules.default_minutes if minutes is None else minutes)
    if not LEAST_MINUTES <= minutes <= MOST_MINUTES:
        raise ChoiceError(f"{minutes:g} minutes; possible are {LEAST_MINUTES:g} to {MOST_MINUTES:g}")
    variant = rules.variants[0] if variant is None else variant
    one_of("variant", variant, rules.variants)
    one, two, three, four = (Seat(brain, team) for brain, team in zip(brains, teams, strict=True))
    return Setup(game, arena, (one, two, three, four), minutes, seed, variant)


def one_of(what: str, name: str, there: Sequence[str]) -> None:
    """Raises ChoiceError unless `name` is there."""
    if name not in there:
        raise ChoiceError(f"no {what} '{name}'; there are {', '.join(there)}")
