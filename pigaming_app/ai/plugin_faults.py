"""Faults of plug-ins that show in our code: numbers of a match that are none, functions with unusable results."""

from collections import Counter
from collections.abc import Iterable, Iterator
from math import isfinite
from pathlib import Path
from traceback import extract_tb, walk_tb
from typing import Any

from pigaming_app.games.game import Setup
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.sim.record import fields_of
from pigaming_app.sim.world import HZ
from pigaming_app.storage.plugins import parts
from pigaming_app.storage.plugins.endless import overseer
from pigaming_app.storage.plugins.found import Plugin

TWICE = 2  # failures of our code with the same game until this is left out, in the arcade
LATE = 10  # s after its time, at which a match of a plug-in must be over
WHOLE = range(-(2**63), 2**63)
_failures: Counter[Plugin] = Counter()


class GameFault(Exception):
    """A plug-in's game has broken a rule of all games; the text is the reason."""

    def __init__(self, game: str, reason: str) -> None:
        super().__init__(reason)
        self.game = game


def late(game: str) -> GameFault:
    """The fault of a match that does not end."""
    return GameFault(game, f"its match is not over {LATE} s after its time")


def bound(game: str, ticks: int) -> int:
    """Ticks that a match is played at most, whose time is over after `ticks`."""
    return ticks + LATE * HZ if overseer.is_overseen(game) else ticks


def check(game: str, states: Iterable[Any], over: bool = True) -> None:
    """Check the plain states of matches of a plug-in that have been played to their bound, or (`over`) to their end.

    Raises GameFault for one that is not over, and for a number that is none.
    """
    for state in states if overseer.is_overseen(game) else ():
        if reason := next(wrong_numbers(state), ""):
            raise GameFault(game, reason)
        if over and not state.over:
            raise late(game)


def blame(error: BaseException) -> Plugin | None:
    """The plug-in that an error is due to, which is left out from here on: it arose in its code, or in ours from the
    state of one of its matches. None: neither.
    """
    if isinstance(error, GameFault):
        return next((parts.stop(one, str(error)) for one in parts.plugins() if one.name == error.game), None)
    if plugin := parts.blame(error):
        return plugin
    for state in _states(error):
        reason = next(wrong_numbers(state), "")
        for plugin in parts.plugins() if reason else ():
            if type(state).__module__.startswith(f"{plugin.module}."):
                return parts.stop(plugin, reason)
    return None


def suspect(error: BaseException, failures: int = TWICE) -> Plugin | None:
    """The plug-in whose game our code was showing or playing when an error arose, for the second time: it is left out.

    `failures`: the number of times. None: nobody is to blame, or not yet.
    """
    plugin = next(_concerned(error), None)
    if plugin is None:
        return None
    _failures[plugin] += 1
    if _failures[plugin] < failures:
        return None
    place = extract_tb(error.__traceback__)[-1]
    return parts.stop(plugin, f"{type(error).__name__}: {error} ({Path(place.filename).name}, line {place.lineno})")


def _concerned(error: BaseException) -> Iterator[Plugin]:
    """The plug-ins whose games are on the way of an error, from the innermost frame on: as `game`, or in a setup."""
    plugins = {plugin.name: plugin for plugin in parts.plugins()}
    for frame, _ in reversed([*walk_tb(error.__traceback__)]):
        setups = (vars(value).get("setup") for value in frame.f_locals.values() if hasattr(value, "__dict__"))
        for name in (frame.f_locals.get("game"), *(setup.game for setup in setups if isinstance(setup, Setup))):
            if isinstance(name, str) and name in plugins:
                yield plugins[name]


def wrong_numbers(state: Any) -> Iterator[str]:
    """Each number of a plain record that is not finite, or no whole number though it is declared as one."""
    for field in fields_of(type(state)):
        several = field.count is not None
        for i, value in enumerate(field.elements(state)):
            name = f"{type(state).__name__}.{field.name}" + (f"[{i}]" if several else "")
            if not field.code:
                yield from (f"{name}.{wrong.partition('.')[2]}" for wrong in wrong_numbers(value))
            elif field.kind is int and not hasattr(value, "__index__"):
                yield f"{name} is {value!r}, no whole number"
            elif field.kind is int and value not in WHOLE:
                yield f"{name} is {float(value):g}, beyond 64 bits"
            elif not hasattr(value, "__float__") or not isfinite(value):
                yield f"{name} is {value!r}, no number"


def _states(error: BaseException) -> Iterator[Any]:
    """The states of matches on the way of an error, from the innermost frame on."""
    kinds = {game.state for game in games().values()}
    for frame, _ in reversed([*walk_tb(error.__traceback__)]):
        for value in frame.f_locals.values():
            state = getattr(value, "state", None) if isinstance(value, Match) else value
            if type(state) in kinds:
                yield state
