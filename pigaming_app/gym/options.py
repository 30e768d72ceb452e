"""The options of an environment, checked, as a task: who plays what, and for which reward."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from math import ceil, inf, isfinite
from pathlib import Path
from typing import Any

import numpy as np
from gymnasium.spaces import Box, MultiDiscrete

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.networks.encoding import PERIOD
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.ai.ppo.task_file import require_trainable
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.game import ALLIES, Setup
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, make_setup
from pigaming_app.gym.rewards import TALLIES, CodedReward
from pigaming_app.gym.robots import read_robots
from pigaming_app.links import installing
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.drivetrain import Drivetrain, DrivetrainError
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.rng import SEEDS, training_seed
from pigaming_app.sim.world import HZ, ROBOTS
from pigaming_app.storage.parsing import ParseError, describe_error

OPPONENT = "level3"  # unless others are named
STARTS = 128  # different matches that an environment plays, unless another number is named
LEARNER = "human"  # in a setup: a seat without a brain


class OptionError(ValueError):
    """An option of an environment is wrong: the reason in one line."""


@dataclass(frozen=True)
class EnvironmentTask:
    """What an environment plays."""

    setup: Setup  # with seed 0
    arenas: tuple[str, ...]
    learners: int  # on the first seats
    opponents: tuple[BrainKind, ...]  # on the seats after them
    ticks: int  # a decision
    continuous: bool
    weights: tuple[float, ...]  # of the game's tallies
    reward: CodedReward | None  # instead of the weights
    starts: int
    fast: bool
    robots: tuple[Drivetrain, ...]  # measured ones, within whose range the robots of an episode are drawn
    options: Mapping[str, Any] = field(default_factory=dict, compare=False)  # of `task_of`, from which it follows

    def __reduce__(self) -> Any:
        return partial(task_of, **self.options), (self.game, self.learners)

    @property
    def game(self) -> str:
        return self.setup.game

    @property
    def decisions_a_second(self) -> float:
        """Of the match's time."""
        return HZ / self.ticks

    @property
    def decisions(self) -> int:
        """Of a match that lasts to the end of its time."""
        return ceil(self.setup.minutes * 60.0 * self.decisions_a_second)

    def setup_of(self, start: int) -> Setup:
        """The setup of one of the matches: arena and seed follow from its number."""
        return replace(self.setup, arena=self.arenas[start % len(self.arenas)], seed=training_seed(start))


def task_of(game: str, learners: int, **options: Any) -> EnvironmentTask:
    """A task from the options of an environment (see `pigaming_app.gym`). Raises OptionError."""
    return replace(_task(game, learners, **options), options=options)


def _task(
    game: str,
    learners: int,
    *,
    opponents: str | Sequence[str] | None = None,
    arena: str | Sequence[str] | None = None,
    variant: str | None = None,
    minutes: float | None = None,
    goal: int | None = None,
    teams: Sequence[int] | None = None,
    ticks: int = PERIOD,
    continuous: bool = False,
    rewards: Mapping[str, float] | None = None,
    reward: str | Callable[..., float] | None = None,
    starts: int = STARTS,
    compiled: bool | None = None,
    robots: str | Path | None = None,
    **unknown: Any,
) -> EnvironmentTask:
    if unknown:
        raise OptionError(f"no option '{next(iter(unknown))}' here; see help(pigaming_app.gym)")
    if game not in ENCODINGS:
        raise OptionError(f"no game '{game}'; there are {', '.join(ENCODINGS)}")
    rules = games()[game].variants.get(variant or "", games()[game].default)
    if opponents is None:
        opponents = () if learners > 1 or rules.team_mode == ALLIES else (OPPONENT,)
    names = words("opponents", opponents)
    learners = number("agents", learners, least=1)
    ticks = number("ticks", ticks, least=1)
    starts = number("starts", starts, least=1)
    if starts > SEEDS:
        raise OptionError(f"starts: {starts} is more than {SEEDS}")
    if learners + len(names) > ROBOTS:
        raise OptionError(f"{learners} agents and {len(names)} opponents, but there are {ROBOTS} seats")
    minutes = None if minutes is None else number("minutes", minutes, (int, float))
    goal = None if goal is None else number("goal", goal)
    if not isinstance(teams, Sequence | np.ndarray | None):
        raise OptionError(f"teams: a number for each seat is needed, not {teams!r}")
    teams = None if teams is None else [number("teams", team) for team in teams]
    found = arenas_of(game, arena)
    players = [LEARNER] * learners + list(names)
    try:
        kinds = tuple(find_brain(game, name) for name in names)
        setup = make_setup(game, players, found[0], minutes, 0, variant, teams, names, goal)
    except ChoiceError as error:
        raise OptionError(str(error).removeprefix("--")) from None
    weights = weights_of(game, rewards)
    continuous = boolean("continuous", continuous)
    compiled = None if compiled is None else boolean("compiled", compiled)
    may_compile = can_compile() and not any(kind.plain for kind in kinds)
    if compiled and not may_compile:
        reason = "an opponent runs only uncompiled" if can_compile() else f"numba is missing: {installing('train')}"
        raise OptionError(f"compiled: {reason}")
    fast = may_compile if compiled is None else compiled
    play = continuous, weights, coded(game, reward, rewards, fast), starts, fast, measured(robots)
    return EnvironmentTask(setup, found, learners, kinds, ticks, *play)


def arenas_of(game: str, arena: str | Sequence[str] | None) -> tuple[str, ...]:
    """Arenas by name or path, several, or "all"; None: the game's first. Raises OptionError."""
    if arena is None or arena == "all":
        return tuple(arenas(game)[: 1 if arena is None else None])
    names = words("arena", arena)
    if not names:
        raise OptionError("arena: none is named")
    try:
        for name in names:
            require_trainable(name)
            load(game, name)
    except (ArenaError, ChoiceError) as error:
        raise OptionError(str(error)) from None
    return names


def measured(robots: str | Path | None) -> tuple[Drivetrain, ...]:
    """The robots of a file; none without one. Raises OptionError."""
    if not isinstance(robots, str | Path | None):
        raise OptionError(f"robots: the path of a file is needed, not {robots!r}")
    try:
        return () if robots is None else read_robots(robots)
    except (OSError, ParseError) as error:
        raise OptionError(f"robots: {robots}: {describe_error(error)}") from None
    except DrivetrainError as error:
        raise OptionError(f"robots: {error}") from None


def weights_of(game: str, rewards: Mapping[str, float] | None) -> tuple[float, ...]:
    """The weights of a game's tallies, its default ones if None. Raises OptionError."""
    tallies = TALLIES[game]
    named = tallies.weights if rewards is None else rewards
    if not isinstance(named, Mapping):
        raise OptionError(f"rewards: weights by name are needed, not {named!r}")
    for name in named:
        if name not in tallies.names:
            raise OptionError(f"no reward '{name}' in {game}; there are {', '.join(tallies.names)}")
    return tuple(float(number(f"rewards, {name}", named.get(name, 0.0), (int, float))) for name in tallies.names)


def coded(game: str, reward: Any, rewards: Any, fast: bool) -> CodedReward | None:
    """A reward as code; None without one. Raises OptionError."""
    if reward is None:
        return None
    if rewards is not None:
        raise OptionError("reward and rewards: one of them is enough")
    if not isinstance(reward, str) and not callable(reward):
        raise OptionError(f"reward: a line of code or a function is needed, not {reward!r}")
    try:
        return CodedReward(game, reward, fast)
    except ValueError as error:
        raise OptionError(f"reward: {error}") from None


def words(name: str, value: Any) -> tuple[str, ...]:
    """One word or several. Raises OptionError."""
    found = (value,) if isinstance(value, str) else tuple(value) if isinstance(value, Sequence) else (value,)
    if not all(isinstance(word, str) for word in found):
        raise OptionError(f"{name}: names are needed, not {value!r}")
    return found


def number(name: str, value: Any, kinds: Any = int, least: float = -inf) -> Any:
    """A finite number, by default a whole one, of at least `least`; those of NumPy as Python's. Raises OptionError."""
    found = value.item() if isinstance(value, np.generic) else value
    if isinstance(found, bool) or not isinstance(found, kinds) or not isfinite(found) or found < least:
        noun = "whole number" if kinds is int else "number"
        raise OptionError(f"{name}: a {noun}{f' from {least:g}' if least > -inf else ''} is needed, not {found!r}")
    return found


def boolean(name: str, value: Any) -> bool:
    """True or False. Raises OptionError."""
    if not isinstance(value, bool | np.bool_):
        raise OptionError(f"{name}: True or False is needed, not {value!r}")
    return bool(value)


def observation_space(task: EnvironmentTask) -> Box:
    """The inputs of the game's networks, in units of 1."""
    return Box(-1.0, 1.0, (ENCODINGS[task.game].size,), np.float32)


def action_space(task: EnvironmentTask) -> Any:
    """A choice for each of the game's heads; or, continuous, linear and angular stick, fire and turbo."""
    if task.continuous:
        return Box(np.array([-1.0, -1.0, 0.0, 0.0]), np.ones(4), dtype=np.float64)
    return MultiDiscrete([choices for _, choices in ENCODINGS[task.game].heads])
