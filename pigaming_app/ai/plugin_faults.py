"""Faults of plug-ins that show in our code: a match whose numbers are none."""

from collections.abc import Iterator
from math import isfinite
from traceback import walk_tb
from typing import Any

from pigaming_app.games.match import Match
from pigaming_app.sim.record import fields_of
from pigaming_app.storage.plugins import parts
from pigaming_app.storage.plugins.found import Plugin


def blame(error: BaseException) -> Plugin | None:
    """The plug-in that an error is due to, which is left out from here on: it arose in its code, or in ours from the
    state of one of its matches. None: neither.
    """
    if plugin := parts.blame(error):
        return plugin
    for state in _states(error):
        reason = next(wrong_numbers(state), "")
        for plugin in parts.plugins() if reason else ():
            if type(state).__module__.startswith(f"{plugin.module}."):
                return parts.stop(plugin, reason)
    return None


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
            elif not hasattr(value, "__float__") or not isfinite(value):
                yield f"{name} is {value!r}, no number"


def _states(error: BaseException) -> Iterator[Any]:
    """The states of matches on the way of an error, from the innermost frame on."""
    for frame, _ in reversed([*walk_tb(error.__traceback__)]):
        for value in frame.f_locals.values():
            state = value.state if isinstance(value, Match) else value
            if hasattr(type(state), "_fields") and hasattr(state, "robots"):
                yield state
