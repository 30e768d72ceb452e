"""The speed of the environments for learning libraries, in decisions of agents a second on one core.

Matches under the game's default rules in its first arena, in the middle of play; actions are random. Time is that of
the process, and of several runs the best counts.
"""

from collections.abc import Callable
from dataclasses import replace
from importlib.util import find_spec
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


def measure(game: str) -> dict[str, float | None]:
    """Decisions a second by kind; None without the extras `gym` and `train`, and for a game without environments.

    - `stepped`: actions for four seats, one tick a decision, no observation.
    - `observed`: the same with observations and rewards for all four.
    - `against_level3`: one seat against that brain, with observations, five ticks a decision.
    """
    names = "stepped", "observed", "against_level3"
    if not (can_compile() and find_spec("gymnasium") and find_spec("pettingzoo")):
        return dict.fromkeys(names)
    from pigaming_app.gym import ENVIRONMENTS

    if game not in ENVIRONMENTS.values():
        return dict.fromkeys(names)
    return {
        "stepped": _stepped(game),
        "observed": _environment(game, agents=ROBOTS, ticks=1, opponents=()),
        "against_level3": _environment(game, agents=1, ticks=5, opponents=(OPPONENT,)),
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
    from pigaming_app.gym.vector import SeatVectorEnv

    goal = max(games()[game].default.goals, default=0)
    env = SeatVectorEnv(game, MATCHES * agents, agents, ticks=ticks, opponents=opponents, goal=goal)
    env.reset(seed=1)
    env.action_space.seed(1)
    actions = env.action_space.sample()
    for _ in range(WARM_UP // ticks):
        env.step(actions)
    return env.num_envs / _seconds(lambda: env.step(actions))


def _seconds(step: Callable[[], Any]) -> float:
    """Of the process, for a step."""
    best = float("inf")
    for _ in range(RUNS):
        began = process_time()
        for _ in range(STEPS):
            step()
        best = min(best, process_time() - began)
    return best / STEPS
