"""The speed of the environments for learning libraries, in decisions of agents a second on one core.

Matches under the game's default rules in its first arena, in the middle of play; actions are random unless a network
decides. Time is that of the process, and of several runs the best counts.
"""

from collections.abc import Callable
from dataclasses import replace
from importlib.util import find_spec
from itertools import pairwise
from time import process_time
from typing import Any

from pigaming_app.ai.learning.batch import matches, step_all
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import HZ, ROBOTS

MATCHES = 4096
WARM_UP = 5 * HZ  # ticks before the first run
RUNS, STEPS = 5, 20  # of each figure, and steps in each of them
OPPONENT = "level3"
UNITS = 64  # of each hidden layer


def measure(game: str) -> dict[str, float | None]:
    """Decisions a second by kind; None without the extras `gym` and `train`, and for a game without environments.

    - `stepped`: actions for four seats, one tick a decision, no observation.
    - `observed`: the same with observations and rewards for all four.
    - `alone`: one seat against a robot that stands still, with observations, five ticks a decision.
    - `against_level3`: the same against that brain.
    - `by_network`: the same, and the seat's actions are those of a network of 64 by 64 units in NumPy.
    - `with_pictures`: a single match against that brain, with a picture for each decision.
    - `with_lidar`, `with_own_picture`: a single match as plain Python, seen through these wrappers.
    """
    names: tuple[str, ...] = "stepped", "observed", "alone", "against_level3", "by_network"
    names += "with_pictures", "with_lidar", "with_own_picture"
    if not (can_compile() and find_spec("gymnasium") and find_spec("pettingzoo")):
        return dict.fromkeys(names)
    from pigaming_app.gym import ENVIRONMENTS
    from pigaming_app.gym.wrappers import Lidar, OwnPicture

    if game not in ENVIRONMENTS.values():
        return dict.fromkeys(names)
    return {
        "stepped": _stepped(game),
        "observed": _environment(game, agents=ROBOTS, ticks=1, opponents=()),
        "alone": _environment(game, agents=1, ticks=5, opponents=("idle",)),
        "against_level3": _environment(game, agents=1, ticks=5, opponents=(OPPONENT,)),
        "by_network": _by_network(game),
        "with_pictures": _single(game, lambda env: env, render_mode="rgb_array"),
        "with_lidar": _single(game, Lidar, compiled=False),
        "with_own_picture": _single(game, OwnPicture, compiled=False),
    }


def _stepped(game: str) -> float:
    import numpy as np

    rules, random = games()[game].default, np.random.default_rng(1)
    one, two, three, four = (Seat("random", team) for team in rules.teams)
    setup = Setup(game, arenas(game)[0], (one, two, three, four), rules.default_minutes, 1, rules.name)
    setup = replace(setup, goal=max(rules.goals, default=0))
    rows = np.concatenate([matches([setup])] * MATCHES)
    rows["random"] = random.integers(0, 2**31, MATCHES)
    actions = random.uniform(-1.0, 1.0, (MATCHES, ROBOTS, 4))
    for _ in range(WARM_UP):
        step_all(rows, actions)
    return MATCHES * ROBOTS / _seconds(lambda: step_all(rows, actions))


def _environment(game: str, agents: int, ticks: int, opponents: tuple[str, ...]) -> float:
    env, actions = _vector(game, agents, ticks, opponents)
    return float(env.num_envs / _seconds(lambda: env.step(actions)))


def _vector(game: str, agents: int, ticks: int, opponents: tuple[str, ...]) -> tuple[Any, Any]:
    """An environment in the middle of play, and random actions."""
    from pigaming_app.gym.vector import SeatVectorEnv

    goal = max(games()[game].default.goals, default=0)
    env = SeatVectorEnv(game, MATCHES * agents, agents, ticks=ticks, opponents=opponents, goal=goal)
    env.reset(seed=1)
    env.action_space.seed(1)
    actions = env.action_space.sample()
    for _ in range(WARM_UP // ticks):
        env.step(actions)
    return env, actions


def _by_network(game: str) -> float:
    import numpy as np

    env, actions = _vector(game, agents=1, ticks=5, opponents=(OPPONENT,))
    choices, random = env.single_action_space.nvec, np.random.default_rng(1)
    sizes = env.single_observation_space.shape[0], UNITS, UNITS, int(choices.sum())
    first, second, last = (random.normal(0.0, 0.1, size).astype(np.float32) for size in pairwise(sizes))
    ends = np.cumsum(choices)[:-1]
    seen = env.step(actions)[0]

    def step() -> None:
        nonlocal seen
        logits = np.tanh(np.tanh(seen @ first) @ second) @ last
        chosen = [head.argmax(1) for head in np.split(logits, ends, axis=1)]
        seen = env.step(np.stack(chosen, 1))[0]

    return float(env.num_envs / _seconds(step))


def _single(game: str, wrapped: Callable[[Any], Any], **options: Any) -> float:
    from pigaming_app.gym.environment import SeatEnv

    env = wrapped(SeatEnv(game, opponents=(OPPONENT,), **options))
    env.action_space.seed(1)
    env.reset(seed=1)
    env.render()

    def step() -> None:
        if env.step(env.action_space.sample())[2]:
            env.reset()
        env.render()

    return 1.0 / _seconds(step)


def _seconds(step: Callable[[], Any]) -> float:
    """Of the process, for a step."""
    best = float("inf")
    for _ in range(RUNS):
        began = process_time()
        for _ in range(STEPS):
            step()
        best = min(best, process_time() - began)
    return best / STEPS
