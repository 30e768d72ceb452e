"""Batches of matches for external policies: one call steps all matches, compiled.

rows = matches([setup_1, setup_2, ...])
while not rows["over"].all():
    step_all(rows, policy(rows), ticks=5)
"""

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from pigaming_app.games.arenas import load
from pigaming_app.games.game import Setup
from pigaming_app.games.registry import games
from pigaming_app.sim.action import set_action
from pigaming_app.sim.contact import drive
from pigaming_app.sim.kernel import compiled
from pigaming_app.sim.record import dtype, packed
from pigaming_app.sim.world import ROBOTS


def initial_states(setups: Sequence[Setup]) -> list[Any]:
    """A plain record for each setup, ready for its first tick. Raises ArenaError."""
    arenas = {(setup.game, setup.arena): load(setup.game, setup.arena) for setup in setups}
    states = []
    for setup in setups:
        state = games()[setup.game].state()
        games()[setup.game].start(state, arenas[setup.game, setup.arena], setup)
        states.append(state)
    return states


def matches(setups: Sequence[Setup]) -> Any:
    """A match for each setup, all of the same game, as a NumPy array (n,) of the game's record. Raises ArenaError."""
    return packed(initial_states(setups))


def step_all(matches: Any, actions: Any, ticks: int = 1) -> None:
    """Advance every match by `ticks` ticks: `matches` from `matches()`, `actions` a float array (n, 4, 4).

    The last axis is linear and angular in [-1, 1], fire and turbo as 0 or 1; all ticks have the same actions. The
    result is that of `ticks` calls, but a large batch is faster, since each match stays in the processor's cache.

    A list of plain records, with nested lists of actions, also works, uncompiled. Raises ImportError without numba,
    TypeError for records of no game.
    """
    if not len(matches):
        return
    for name, game in games().items():
        if isinstance(matches, list):
            if isinstance(matches[0], game.state):
                return make_step_all(game.judge)(matches, actions, ticks)
        elif matches.dtype is dtype(game.state) or matches.dtype == dtype(game.state):
            return _compiled_step(name)(matches, actions, ticks)
    raise TypeError("these are not matches of any game")


def make_step_all(judge: Callable[[Any], None]) -> Callable[[Any, Any, int], None]:
    """The loop over matches, plain or to be compiled."""

    def step(matches: Any, actions: Any, ticks: int) -> None:
        for i in range(len(matches)):
            match = matches[i]
            for seat in range(ROBOTS):
                action = actions[i][seat]
                set_action(match.actions[seat], action[0], action[1], int(action[2] > 0.5), int(action[3] > 0.5))
            for _ in range(ticks):
                judge(match)
                drive(match)

    return step


@cache
def _compiled_step(game: str) -> Callable[[Any, Any, int], None]:
    return compiled(make_step_all(games()[game].judge))
