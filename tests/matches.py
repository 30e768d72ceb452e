"""Matches for tests, before their first tick; and players for their seats."""

from collections.abc import Sequence
from math import inf
from typing import Any

from pigaming_app.ai.registry import new_match
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.sim.action import set_action
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import ROBOTS


def setup_of(
    game: str,
    brains: str | Sequence[str],
    arena: str = "",
    minutes: float = 5.0,
    seed: int = 1,
    variant: str = "",
    goal: int | None = None,
    teams: Sequence[int] = (),
) -> Setup:
    """A setup, unchecked. `brains`: by seat, also as words of one text; the other seats are off."""
    rules = games()[game].variants[variant or games()[game].default.name]
    names = brains.split() if isinstance(brains, str) else brains
    names = [*names, *["off"] * (ROBOTS - len(names))]
    one, two, three, four = map(Seat, names, teams or rules.teams)
    chosen = rules.default_goal if goal is None else goal
    return Setup(game, arena or arenas(game)[0], (one, two, three, four), minutes, seed, rules.name, chosen)


def match_of(game: str, brains: str | Sequence[str], arena: str | Arena = "", *more: Any, **named: Any) -> Match:
    """A match of a setup as above, with an AI on every seat that names a brain."""
    name, given = (arena, None) if isinstance(arena, str) else (arena.name, arena)
    return new_match(setup_of(game, brains, name, *more, **named), arena=given)


def run(match: Match, ticks: int) -> Match:
    """The match after so many more ticks."""
    for _ in range(ticks):
        match.tick()
    return match


def finished(match: Match, seconds: float = inf) -> Match:
    """The match at its end, or after so much of its time."""
    while not match.over and match.seconds < seconds:
        match.tick()
    return match


def player_of(match: Match, seat: int = 0) -> Any:
    """The player on a seat, of any class."""
    return match.brains[seat]


def mind_of(match: Match, seat: int = 0) -> Any:
    """The mind of the AI on a seat."""
    return player_of(match, seat).mind


class Stick:
    """A player with a constant stick and buttons."""

    def __init__(self, linear: float = 1.0, angular: float = 0.0, turbo: int = 0, fire: int = 0) -> None:
        self.linear, self.angular, self.turbo, self.fire = linear, angular, turbo, fire

    def think(self, state: Any, seat: int) -> None:
        """Hold them."""
        set_action(state.actions[seat], self.linear, self.angular, self.fire, self.turbo)
