"""Validation of a match setup from the words of the command line."""

from collections.abc import Sequence

from pigaming_app.games.arenas import arenas, default_goal
from pigaming_app.games.game import ALLIES, ALONE, PAIRS, Game, Seat, Setup, Variant
from pigaming_app.games.registry import games
from pigaming_app.sim.world import HZ, ROBOTS
from pigaming_app.storage.plugins.consent import is_on
from pigaming_app.storage.plugins.found import found

PEOPLE = ("human", "off")
MIN_MINUTES, MAX_MINUTES = 0.05, 60.0


class ChoiceError(ValueError):
    """A choice is not available: the reason in one line."""


def make_setup(
    game: str,
    brains: Sequence[str],
    arena: str | None,
    minutes: float | None,
    seed: int,
    variant: str | None,
    teams: Sequence[int] | None,
    known: Sequence[str],
    goal: int | None = None,
) -> Setup:
    """A validated setup; None selects the game's default. `known`: names of its brains. Raises ChoiceError."""
    require_game(game)
    rules = games()[game]
    for brain in brains:
        require_one_of("seat", brain, [*PEOPLE, *known])
    if len(brains) > ROBOTS:
        raise ChoiceError(f"--seats names {len(brains)} seats, but there are {ROBOTS}")
    brains = [*brains, *["off"] * (ROBOTS - len(brains))]
    variant = rules.default.name if variant is None else variant
    require_one_of("variant", variant, list(rules.variants))
    offered = rules.variants[variant]
    teams = list(offered.teams if teams is None else teams)
    if len(teams) != ROBOTS:
        raise ChoiceError(f"--teams needs {ROBOTS} numbers, one for each seat")
    if not {*teams} <= {*range(ROBOTS)}:
        raise ChoiceError(f"teams are numbers from 0 to {ROBOTS - 1}")
    check_teams(rules, offered, [team for brain, team in zip(brains, teams, strict=True) if brain != "off"])
    minutes = float(offered.default_minutes if minutes is None else minutes)
    if not MIN_MINUTES <= minutes <= MAX_MINUTES:
        raise ChoiceError(f"{minutes:g} minutes; possible are {MIN_MINUTES:g} to {MAX_MINUTES:g}")
    arena = arena or arenas(game)[0]
    goal = default_goal(game, variant, arena) if goal is None else goal
    if goal != offered.default_goal and goal not in offered.goals:
        possible = f"{offered.goals[0]} to {offered.goals[-1]} {rules.goal}" if offered.goals else "time alone"
        raise ChoiceError(f"a goal of {goal}; {game} is played for {possible}")
    one, two, three, four = (Seat(brain, team) for brain, team in zip(brains, teams, strict=True))
    return Setup(game, arena, (one, two, three, four), minutes, seed, variant, goal)


def check_teams(rules: Game, variant: Variant, playing: Sequence[int]) -> None:
    """Raises ChoiceError unless the variant of a game permits these teams, one for each robot that plays.

    A game that takes times can be played alone, against the clock.
    """
    if variant.team_mode == ALLIES:
        if not playing:
            raise ChoiceError("at least one seat must be taken")
        if {*playing} != {0}:
            raise ChoiceError(f"in {rules.name}, {variant.name}, all robots are in team 0")
        return
    if len(playing) == 1 and rules.timed:
        return
    if len(playing) < 2:
        raise ChoiceError("at least two seats must be taken")
    if len(set(playing)) < 2:
        raise ChoiceError("there must be at least two teams")
    if variant.team_mode == ALONE and len(set(playing)) < len(playing):
        raise ChoiceError(f"{rules.name} knows no teams")
    if variant.team_mode == PAIRS and (not {*playing} <= {0, 1} or max(playing.count(0), playing.count(1)) > 2):
        raise ChoiceError(f"{rules.name} is played by two teams, 0 and 1, of at most two robots each")


def require_game(name: str) -> None:
    """Raises ChoiceError for a game that there is not, or that the operator has not switched on."""
    if name in games():
        return
    if plugin := next((plugin for plugin in found() if plugin.name == name), None):
        state = {None: "is new, and runs code of its own", False: "is switched off", True: "is left out"}[is_on(plugin)]
        advice = "see above" if is_on(plugin) else f"main.py games on {name}"
        raise ChoiceError(f"the game {name} in {plugin.folder} {state}: {advice}")
    require_one_of("game", name, list(games()))


def require_one_of(noun: str, name: str, choices: Sequence[str]) -> None:
    """Raises ChoiceError, with the `noun`, unless `name` is one of the choices."""
    if name not in choices:
        raise ChoiceError(f"no {noun} '{name}'; there are {', '.join(choices)}")


def longest(setup: Setup) -> int:
    """Ticks after which a match is over."""
    return round((setup.minutes * 60 + games()[setup.game].variants[setup.variant].overtime) * HZ)
