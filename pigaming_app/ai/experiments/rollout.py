"""Batches of whole matches with the brains inside the loop, plain or compiled.

A rollout is a closure over a game's rules and the brains of its four seats, so numba compiles it into a single loop
over NumPy records. The same closure runs uncompiled over plain records.
"""

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from pigaming_app.ai.brain.baselines import IDLE
from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.games.batch import initial_states
from pigaming_app.games.game import Setup
from pigaming_app.games.registry import games
from pigaming_app.sim.contact import drive
from pigaming_app.sim.kernel import compiled
from pigaming_app.sim.record import packed, unpack
from pigaming_app.sim.world import ROBOTS

Loop = Callable[..., None]
Think = Callable[[Any, int, Any, Any], None]


def make_rollout(judge: Callable[[Any], None], think: tuple[Think, Think, Think, Think]) -> Loop:
    """A loop over matches that advances each by `ticks` ticks, or to its end.

    `ones` to `fours` hold the minds of seats 0 to 3, one per match; `rows_1` to `rows_4` their weights, rows of one.
    """
    first, second, third, fourth = think

    def rollout(
        matches: Any,
        ones: Any,
        twos: Any,
        threes: Any,
        fours: Any,
        rows_1: Any,
        rows_2: Any,
        rows_3: Any,
        rows_4: Any,
        ticks: int,
    ) -> None:
        weights_1, weights_2, weights_3, weights_4 = rows_1[0], rows_2[0], rows_3[0], rows_4[0]
        for i in range(len(matches)):
            match, one, two, three, four = matches[i], ones[i], twos[i], threes[i], fours[i]
            for _ in range(ticks):
                if match.over:
                    break
                first(match, 0, one, weights_1)
                second(match, 1, two, weights_2)
                third(match, 2, three, weights_3)
                fourth(match, 3, four, weights_4)
                judge(match)
                drive(match)

    return rollout


@cache
def plain_rollout(game: str, think: tuple[Think, Think, Think, Think]) -> Loop:
    """Rollout of a game over plain records, cached."""
    return make_rollout(games()[game].judge, think)


@cache
def compiled_rollout(game: str, think: tuple[Think, Think, Think, Think]) -> Loop:
    """Rollout of a game over NumPy records, cached. Raises ImportError without numba."""
    return compiled(make_rollout(games()[game].judge, think))


class Batch:
    """Many matches of one game with the same brains on their seats."""

    def __init__(self, setups: Sequence[Setup], kinds: Sequence[BrainKind | None], fast: bool) -> None:
        """One match per setup. `kinds`: brains by seat, idle where None or missing. `fast`: compiled; needs numba."""
        self.fast = fast
        self.kinds = tuple(kind or IDLE for kind in [*kinds, *[None] * (ROBOTS - len(kinds))])
        minds = [[fresh_mind(kind, setup.seed, seat) for seat, kind in enumerate(self.kinds)] for setup in setups]
        columns = [list(column) for column in zip(*minds, strict=True)]
        states = initial_states(setups)
        self.matches: Any = packed(states) if fast else states
        self.minds = [packed(column) for column in columns] if fast else columns
        self.weights = [kind.weights(fast) for kind in self.kinds]
        one, two, three, four = (kind.think for kind in self.kinds)
        think = one, two, three, four
        game = setups[0].game
        self.state = games()[game].state
        self.loop: Loop = compiled_rollout(game, think) if fast else plain_rollout(game, think)

    def play(self, ticks: int) -> None:
        """Advance every match by `ticks` ticks, or to its end."""
        self.loop(self.matches, *self.minds, *self.weights, ticks)

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


def fresh_mind(kind: BrainKind, seed: int, seat: int) -> Any:
    """A reset mind for a seat of the match with this seed."""
    mind = kind.mind()
    kind.reset(mind, seed * ROBOTS + seat)
    return mind
