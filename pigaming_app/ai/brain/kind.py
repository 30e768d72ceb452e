"""What a brain is: a function that sees and decides, and a record of what it remembers; both work in both bodies.

What a brain has learned (a table, the weights of a network) may be big: it is one more record, which all seats share,
which no match copies, and which play never changes.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any, Protocol

from pigaming_app.ai.brain.thoughts import Thoughts
from pigaming_app.sim.action import set_action
from pigaming_app.sim.record import packed, record


@record
class NoWeights:
    """What a hand-written brain has learned."""

    nothing: int


@cache
def no_weights(fast: bool) -> Any:
    """Nothing learned, in either body."""
    return packed([NoWeights()]) if fast else [NoWeights()]


@dataclass(frozen=True)
class BrainKind:
    """A kind of brain: `think(match, seat, mind, weights)` sets the action of a seat, `reset(mind, seed)` fills a mind.

    `weights(fast)` gives what it has learned as a row of one record, a NumPy record (`fast`) or a plain one, always the
    same one; it may read a file when it is first asked. `explain`, of the same arguments as `think`, says what is on
    its mind at this moment, for people who watch; it only reads.
    """

    name: str
    mind: type
    think: Callable[[Any, int, Any, Any], None]
    reset: Callable[[Any, int], None]
    weights: Callable[[bool], Any] = no_weights
    explain: Callable[[Any, int, Any, Any], Thoughts] | None = None


class BrainPlayer:
    """A brain of some kind on a seat of a plain match."""

    def __init__(self, kind: BrainKind, seed: int) -> None:
        self.kind = kind
        self.mind = kind.mind()
        self.weights = kind.weights(False)[0]
        kind.reset(self.mind, seed)

    def think(self, state: Any, seat: int) -> None:
        """Set the seat's action for this tick."""
        self.kind.think(state, seat, self.mind, self.weights)

    def explain(self, state: Any, seat: int) -> Thoughts | None:
        """What is on its mind; None: this kind keeps that to itself."""
        return self.kind.explain(state, seat, self.mind, self.weights) if self.kind.explain else None


class Controller(Protocol):
    """Anything that is held like a pad: stick in [-1, 1], two buttons."""

    @property
    def linear(self) -> float: ...

    @property
    def angular(self) -> float: ...

    @property
    def fire(self) -> bool: ...

    @property
    def turbo(self) -> bool: ...


class HumanPlayer:
    """A person: `read` is called on the tick on which it acts."""

    def __init__(self, read: Callable[[], Controller]) -> None:
        self.read = read

    def think(self, state: Any, seat: int) -> None:
        """Set the seat's action from how the device is held right now."""
        held = self.read()
        set_action(state.actions[seat], held.linear, held.angular, int(held.fire), int(held.turbo))
