"""The brain contract: a decision function and a record for its memory (the mind).

Both work on plain records and, compiled, on NumPy records. Learned parameters (a Q-table, network weights) may be
large, so they live in a separate read-only record that all seats share and no match copies.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cache
from pathlib import Path
from typing import Any, Self

from pigaming_app.ai.brain.driving import Controller, Driving, turn_and_drive
from pigaming_app.ai.brain.thoughts import Thoughts
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import packed, record
from pigaming_app.sim.rng import seeded, uniform


@record
class NoWeights:
    """Placeholder parameters of a hand-written brain."""

    nothing: int


@cache
def no_weights(fast: bool) -> Any:
    """A row of one NoWeights, as a NumPy record (`fast`) or a plain one."""
    return packed([NoWeights()]) if fast else [NoWeights()]


def no_reset(mind: Any, seed: int) -> None:
    """A fresh mind as it is."""


@dataclass(frozen=True)
class BrainKind:
    """A brain as data and functions.

    - `think(match, seat, mind, weights)` sets the seat's action for this tick.
    - `reset(mind, seed)` initialises a fresh mind; its field `random`, if it has one, is the seeded generator already.
    - `weights(fast)` returns a row of one record with the learned parameters, a NumPy record (`fast`) or a plain one.
      Every call returns the same row; the first call may read a file.
    - `explain`, with the arguments of `think`, returns the brain's present reasoning for display. Read-only. Those of
      our own brains are in `ai/explanations/`.
    - `plain`: it cannot be compiled; `weights` has the same row for both values of `fast`.
    - `file`: that of its network, if it plays by one.
    """

    name: str
    mind: type
    think: Callable[[Any, int, Any, Any], None]
    reset: Callable[[Any, int], None] = no_reset
    weights: Callable[[bool], Any] = no_weights
    explain: Callable[[Any, int, Any, Any], Thoughts] | None = None
    plain: bool = False
    file: Path | None = None

    def begin(self, mind: Any, seed: int) -> None:
        """Initialise a fresh mind: its generator `random`, if it has one, and what `reset` adds."""
        if hasattr(mind, "random"):
            mind.random = seeded(seed)
        self.reset(mind, seed)


class BrainPlayer:
    """A brain playing one seat of a plain match."""

    def __init__(self, kind: BrainKind, seed: int) -> None:
        self.kind = kind
        self.mind = kind.mind()
        self.weights = kind.weights(False)[0]
        kind.begin(self.mind, seed)

    def think(self, state: MatchState, seat: int) -> None:
        """Set the seat's action for this tick."""
        self.kind.think(state, seat, self.mind, self.weights)


class HumanPlayer:
    """A person on a seat; `read` polls the input device on the tick that uses it."""

    def __init__(self, read: Callable[[], Controller], driving: Driving = turn_and_drive) -> None:
        self.read, self.driving = read, driving

    def think(self, state: MatchState, seat: int) -> None:
        """Set the seat's action from the device's present state."""
        device = self.read()
        linear, angular = self.driving(state, seat, device)
        set_action(state.actions[seat], linear, angular, int(device.fire), int(device.turbo))


class OneButtonPlayer:
    """A person with one button: an AI drives, and the button, FIRE or turbo, does the rest.

    `boosts`: the button is the turbo too, where there may be nothing to fire. Otherwise the AI uses the turbo.
    """

    def __init__(self, read: Callable[[], Controller], brain: BrainPlayer, boosts: bool) -> None:
        self.read, self.brain, self.boosts = read, brain, boosts
        self._buttons = 0, 0  # fire and turbo as the AI last set them: on most ticks it leaves its action as it was

    def think(self, state: MatchState, seat: int) -> None:
        """Set the seat's action: the AI's stick, and the button's present state."""
        device, action = self.read(), state.actions[seat]
        action.fire, action.turbo = self._buttons
        self.brain.think(state, seat)
        self._buttons = action.fire, action.turbo
        pressed = int(device.fire or device.turbo)
        action.fire, action.aim = pressed, 0
        if self.boosts:
            action.turbo = pressed


HOLD = 10  # ticks for which a random action is held


@record
class SimpleMind:
    """State of a private random generator, so that the match's generator is not advanced."""

    random: int


def reset(mind: SimpleMind, seed: int) -> None:
    mind.random = seeded(seed)


@kernel
def stand_still(match: MatchState, seat: int, mind: SimpleMind, weights: NoWeights) -> None:
    """Release stick and buttons."""
    set_action(match.actions[seat], 0.0, 0.0, 0, 0)


@kernel
def act_randomly(match: MatchState, seat: int, mind: SimpleMind, weights: NoWeights) -> None:
    """Draw one of the 3 x 3 x 2 x 2 actions every HOLD ticks (five times a second)."""
    if match.tick % HOLD == 0:
        linear = float(int(uniform(mind) * 3.0)) - 1.0
        angular = float(int(uniform(mind) * 3.0)) - 1.0
        fire = int(uniform(mind) * 2.0)
        set_action(match.actions[seat], linear, angular, fire, int(uniform(mind) * 2.0))


IDLE = BrainKind("idle", SimpleMind, stand_still, reset)
RANDOM = BrainKind("random", SimpleMind, act_randomly, reset)


@dataclass(frozen=True)
class Traits:
    """A kind of person. Sources of the numbers: docs/people.md."""

    reaction: float  # s, mean choice reaction time, by which others are perceived late
    spread: float  # standard deviation, from one person to another, of the logarithm of what makes one slow and coarse
    decisions: float  # per second
    timing: float  # s, standard deviation with which a press or release meets its moment
    aim: float  # rad, standard deviation of an estimated direction
    prediction: float  # share of the motion of others that aiming allows for
    lapses: float  # of attention, per minute
    lapse: float  # s, mean length of one
    stick: float  # rad, standard deviation of a stick's direction; 0: keys, with eight directions
    tactics: float  # knowledge of the game, 0..1
    turbo: bool  # uses it, and what else needs a second button or a rule that nobody explains

    def slower(self, factor: float) -> Self:
        """Somebody of the same kind who is slower and coarser by a factor."""
        return replace(
            self,
            reaction=factor * self.reaction,
            decisions=self.decisions / factor,
            timing=factor * self.timing,
            aim=factor * self.aim,
            lapses=factor * self.lapses,
            stick=factor * self.stick,
        )

    def scaled(self, field: str, factor: float) -> Self:
        """The same person with one number changed; shares stay within 1."""
        value = factor * getattr(self, field)
        return replace(self, **{field: min(1.0, value) if field in ("prediction", "tactics") else value})


NUMBERS = tuple(field.name for field in fields(Traits) if field.name != "turbo")
