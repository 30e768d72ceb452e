"""The options of an environment, checked, as a task: who plays what, and for which reward."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.networks.encoding import PERIOD
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.game import ALLIES, Setup
from pigaming_app.games.registry import games
from pigaming_app.games.setup import make_setup
from pigaming_app.gym.rewards import TALLIES
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import HZ, ROBOTS

OPPONENT = "level3"  # unless others are named
STARTS = 128  # different matches that an environment plays, unless another number is named
LEARNER = "human"  # in a setup: a seat without a brain


class OptionError(ValueError):
    """An option of an environment is wrong: the reason in one line."""


@dataclass(frozen=True)
class Task:
    """What an environment plays."""

    setup: Setup  # with seed 0
    arenas: tuple[str, ...]
    learners: int  # on the first seats
    opponents: tuple[BrainKind, ...]  # on the seats after them
    ticks: int  # a decision
    continuous: bool
    weights: tuple[float, ...]  # of the game's tallies
    starts: int
    fast: bool

    @property
    def game(self) -> str:
        return self.setup.game

    @property
    def decisions_a_second(self) -> float:
        """Of the match's time."""
        return HZ / self.ticks

    def setup_of(self, start: int) -> Setup:
        """The setup of one of the matches: arena and seed follow from its number."""
        return replace(self.setup, arena=self.arenas[start % len(self.arenas)], seed=start)


def task_of(
    game: str,
    learners: int,
    *,
    opponents: Sequence[str] | None = None,
    arena: str | Sequence[str] | None = None,
    variant: str | None = None,
    minutes: float | None = None,
    goal: int | None = None,
    teams: Sequence[int] | None = None,
    ticks: int = PERIOD,
    continuous: bool = False,
    rewards: Mapping[str, float] | None = None,
    starts: int = STARTS,
    compiled: bool | None = None,
) -> Task:
    """A task from the options of an environment (see `pigaming_app.gym`). Raises OptionError."""
    if game not in ENCODINGS:
        raise OptionError(f"no game '{game}'; there are {', '.join(ENCODINGS)}")
    rules = games()[game].variants.get(variant or games()[game].default.name, games()[game].default)
    if opponents is None:
        opponents = () if learners > 1 or rules.team_mode == ALLIES else (OPPONENT,)
    names = (opponents,) if isinstance(opponents, str) else tuple(opponents)
    number_from("agents", learners, 1)
    number_from("ticks", ticks, 1)
    number_from("starts", starts, 1)
    if learners + len(names) > ROBOTS:
        raise OptionError(f"{learners} agents and {len(names)} opponents, but there are {ROBOTS} seats")
    kinds = tuple(brain_of(game, name) for name in names)
    if compiled and not can_compile():
        raise OptionError("compiled: numba is not installed: pip install 'pigaming-app[train]'")
    found = arenas_of(game, arena)
    try:
        setup = make_setup(game, [LEARNER] * learners + list(names), found[0], minutes, 0, variant, teams, names, goal)
    except ValueError as error:
        raise OptionError(str(error)) from None
    weights = weights_of(game, rewards)
    fast = can_compile() if compiled is None else bool(compiled)
    return Task(setup, found, learners, kinds, ticks, bool(continuous), weights, starts, fast)


def brain_of(game: str, name: str) -> BrainKind:
    """The brain of a game with a name. Raises OptionError."""
    if name not in BRAINS[game]:
        raise OptionError(f"no opponent '{name}'; there are {', '.join(BRAINS[game])}")
    return BRAINS[game][name]


def arenas_of(game: str, arena: str | Sequence[str] | None) -> tuple[str, ...]:
    """Arenas by name or path, several, or "all"; None: the game's first. Raises OptionError."""
    if arena == "all":
        return tuple(arenas(game))
    names = tuple(arenas(game)[:1] if arena is None else [arena] if isinstance(arena, str) else arena)
    if not names:
        raise OptionError("arena: none is named")
    try:
        for name in names:
            load(game, name)
    except ArenaError as error:
        raise OptionError(str(error)) from None
    return names


def weights_of(game: str, rewards: Mapping[str, float] | None) -> tuple[float, ...]:
    """The weights of a game's tallies, its default ones if None. Raises OptionError."""
    tallies = TALLIES[game]
    named = tallies.weights if rewards is None else rewards
    for name, weight in named.items():
        if name not in tallies.names:
            raise OptionError(f"no reward '{name}' in {game}; there are {', '.join(tallies.names)}")
        if not isinstance(weight, (int, float)) or not isfinite(weight):
            raise OptionError(f"rewards: the weight of {name} is no number: {weight!r}")
    return tuple(float(named.get(name, 0.0)) for name in tallies.names)


def number_from(name: str, value: Any, least: int) -> None:
    """Raises OptionError unless a value is a whole number of at least `least`."""
    if isinstance(value, bool) or not isinstance(value, int) or value < least:
        raise OptionError(f"{name}: a whole number from {least} is needed, not {value!r}")
