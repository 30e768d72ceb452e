"""Batches of whole matches with the brains inside the loop, plain or compiled.

A rollout is a closure over a game's rules and the families of brains that it can seat, so numba compiles it into a
single loop over NumPy records. The same closure runs uncompiled over plain records.
"""

from collections.abc import Callable, Iterable, Sequence
from functools import cache
from typing import Any

from pigaming_app.ai.brain.kind import IDLE, RANDOM, BrainKind
from pigaming_app.ai.learning.batch import initial_states
from pigaming_app.ai.learning.cast import Cast, Family, Think, dispatcher
from pigaming_app.ai.plugin_faults import bound, check
from pigaming_app.games.game import Setup
from pigaming_app.games.registry import games
from pigaming_app.games.setup import longest
from pigaming_app.sim.contact import drive
from pigaming_app.sim.kernel import compiled
from pigaming_app.sim.record import copy, packed, unpack
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.plugins.endless import overseer

Loop = Callable[[Any, Any, Any, int], None]


def make_rollout(judge: Callable[[Any], None], think: Think) -> Loop:
    """A loop over matches that advances each by `ticks` ticks, or to its end.

    `minds`: of each match and seat, (n, 4); `weights`: those of the cast.
    """

    def rollout(matches: Any, minds: Any, weights: Any, ticks: int) -> None:
        for i in range(len(matches)):
            match, seated = matches[i], minds[i]
            for _ in range(ticks):
                if match.over:
                    break
                for seat in range(ROBOTS):
                    think(match, seat, seated[seat], weights)
                judge(match)
                drive(match)

    return rollout


@cache
def plain_rollout(game: str, families: tuple[Family, ...]) -> Loop:
    """Rollout of a game over plain records, cached."""
    return make_rollout(games()[game].judge, dispatcher(families))


@cache
def compiled_rollout(game: str, families: tuple[Family, ...]) -> Loop:
    """Rollout of a game over NumPy records, cached. Raises ImportError without numba."""
    return compiled(make_rollout(games()[game].judge, dispatcher(families)))


def cast_with_baselines(kinds: Iterable[BrainKind], fast: bool) -> Cast:
    """A cast of these brains and the baselines, which cost little: a loop for each would take long to compile.

    They come first, so that the same brains have the same loop with a baseline on a seat and without.
    """
    return Cast([IDLE, RANDOM, *kinds], fast)


class Batch:
    """Many matches of one game with the same brains on their seats."""

    def __init__(
        self,
        setups: Sequence[Setup],
        kinds: Sequence[BrainKind | None],
        fast: bool,
        cast: Cast | None = None,
        twin: "Batch | None" = None,
    ) -> None:
        """One match per setup. `kinds`: brains by seat, idle where None or missing. `fast`: compiled; needs numba.

        `cast`: brains that share the compiled loop, among them `kinds`; None: `cast_with_baselines` of the seats'.
        `twin`: a batch not yet played whose setups begin with these; its matches are copied instead of made anew.
        """
        self.fast = fast
        self.kinds = tuple(kind or IDLE for kind in [*kinds, *[None] * (ROBOTS - len(kinds))])
        self.cast = cast or cast_with_baselines(self.kinds, fast)
        self.matches: Any
        if twin is None:
            states = initial_states(setups)
            self.matches = packed(states) if fast else states
        else:
            start = twin.matches[: len(setups)]
            self.matches = start.copy() if fast else [copy(state) for state in start]
        self.minds = self.cast.minds(
            [[(kind, setup.seed * ROBOTS + seat) for seat, kind in enumerate(self.kinds)] for setup in setups]
        )
        self.game = setups[0].game
        self.state = games()[self.game].state
        self.loop: Loop = (compiled_rollout if fast else plain_rollout)(self.game, self.cast.families)

    def play(self, ticks: int) -> None:
        """Advance every match by `ticks` ticks, or to its end."""
        overseer.run(self.game, self.ticks, self.loop, self.matches, self.minds, self.cast.weights, ticks)

    def scores(self) -> list[list[int]]:
        """Scores of the seats, by match."""
        if self.fast:
            return self.matches["robots"]["score"].tolist()  # type: ignore[no-any-return]
        return [[robot.score for robot in match.robots] for match in self.matches]

    def ticks(self) -> int:
        """Ticks played so far, summed over all matches."""
        return sum(self.matches["tick"].tolist() if self.fast else [match.tick for match in self.matches])

    def ended(self) -> list[Any]:
        """All matches as plain records."""
        return [unpack(self.state, row) for row in self.matches] if self.fast else list(self.matches)


def rehearse(setup: Setup, kinds: Sequence[BrainKind | None]) -> None:
    """Play a match of a plug-in plain, before others are compiled: these convert numbers that plain ones refuse.

    Raises GameFault, and whatever the plug-in raises.
    """
    if overseer.is_overseen(setup.game):
        batch = Batch([setup], kinds, fast=False)
        batch.play(bound(setup.game, longest(setup)))
        check(setup.game, batch.matches)
