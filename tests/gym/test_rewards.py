"""Rewards as code: a line means what the weights mean, a function what the line means, and each quantity its event."""

import pickle
from collections.abc import Callable
from math import atan2, cos, hypot
from typing import Any

import gymnasium
import numpy as np
import pytest

import pigaming_app.gym
from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.ai.reward_line import parsed
from pigaming_app.gym.options import OptionError
from pigaming_app.gym.rewards import TALLIES, names_of
from pigaming_app.scenes.lab.scene import FIRST
from pigaming_app.scenes.lab.trainer import Trainer
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.sweep import offset_from_wall

GAMES = {"pitanks": "PiTanks-v0", "race": "RobotRace-v0", "factory": "RobotFactory-v0"}
SHORT: dict[str, Any] = {"minutes": 0.2, "compiled": False}
needs_numba = pytest.mark.skipif(not can_compile(), reason="numba is not installed")
assert pigaming_app.gym


def rewards_of(game: str, steps: int, seed: int = 3, **options: Any) -> Any:
    """The rewards of random play in two environments, over ends of episodes."""
    envs = gymnasium.make_vec(GAMES[game], num_envs=2, **{**SHORT, **options})
    envs.reset(seed=seed)
    envs.action_space.seed(seed)
    found = [envs.step(envs.action_space.sample())[1] for _ in range(steps)]
    envs.close()
    return np.array(found)


def in_proportion(hits: float, taken: float, win: float) -> float:
    return hits - taken + 5 * win


@pytest.mark.parametrize("game", GAMES)
@pytest.mark.parametrize("mode", list(gymnasium.vector.AutoresetMode)[:2])
def test_a_line_over_tallies_is_the_weighted_reward(game: str, mode: gymnasium.vector.AutoresetMode) -> None:
    weights = TALLIES[game].weights
    line = " + ".join(f"{weight}*{name}" for name, weight in weights.items())
    usual = rewards_of(game, 150, autoreset_mode=mode)
    assert rewards_of(game, 150, autoreset_mode=mode, reward=line) == pytest.approx(usual, abs=1e-12)
    assert usual.any()


@pytest.mark.parametrize("reward", [in_proportion, lambda hits, taken, win: hits - taken + 5 * win])
@pytest.mark.parametrize(
    "compiled",
    [False, pytest.param(True, marks=[pytest.mark.long, pytest.mark.again, needs_numba])],
)
def test_a_function_is_the_same_as_its_line(reward: Callable[..., float], compiled: bool) -> None:
    by_line = rewards_of("pitanks", 150, reward="hits - taken + 5*win", compiled=compiled)
    assert (rewards_of("pitanks", 150, reward=reward, compiled=compiled) == by_line).all()
    assert by_line.any()


def test_a_function_that_numba_cannot_compile_runs_as_python() -> None:
    seen: list[float] = []

    def reward(distance: float) -> float:
        seen.append(float(str(distance)))  # neither list nor str(float) of the outside in numba
        return seen[-1]

    found = rewards_of("pitanks", 3, reward=reward, minutes=0.5)
    assert seen[-2:] == pytest.approx(found[-1].tolist())


QUANTITIES = ("still", "turned", "fired", "miss", "behind", "distance", "hit", "taken")


def hidden(state: Any, me: Any, other: Any) -> bool:
    """Whether a wall is in a bullet's way from one robot to another, by small steps."""
    radius = state.rules.bullet_radius
    for share in np.linspace(0.0, 1.0, 600):
        x, y = me.x + share * (other.x - me.x), me.y + share * (other.y - me.y)
        for wall in state.walls[: state.wall_count]:
            if wall.health and hypot(*offset_from_wall(wall, x, y)) < wall.half + radius:
                return True
    return False


@pytest.mark.parametrize("continuous", [False, True])
def test_every_quantity_is_what_the_match_shows(continuous: bool) -> None:
    """One environment for each quantity, in step; the truth comes from the plain record of the match."""
    options: dict[str, Any] = dict(SHORT, opponents=("level2",), variant="party", continuous=continuous, minutes=0.5)
    envs = {name: gymnasium.make(GAMES["pitanks"], reward=f"0.5*{name}", **options) for name in QUANTITIES}
    for env in envs.values():
        env.reset(seed=5)
    first = envs["still"]
    first.action_space.seed(5)
    counts = dict.fromkeys(QUANTITIES, 0.0)
    for decision in range(110):
        state: Any = first.unwrapped.matches.state(0)
        me, other, tank = state.robots[0], state.robots[1], state.tanks[0]
        distance = hypot(other.x - me.x, other.y - me.y)
        ahead = cos(atan2(other.y - me.y, other.x - me.x) - me.heading)
        loaded = tank.cooldown < 0.15 * state.rules.cooldown
        before, open_way = (tank.hits, tank.taken), not hidden(state, me, other)
        action = first.action_space.sample()
        if continuous and decision % 3 == 0:
            action[:2] = 0.0
        found = {name: 2 * float(env.step(action)[1]) for name, env in envs.items()}
        state = first.unwrapped.matches.state(0)
        drive, turn = action[:2] if continuous else action[:2] - np.array([1, 3])
        fire = action[2] > 0.5
        assert found["still"] == (drive == 0)
        assert found["turned"] == (turn != 0)
        assert found["fired"] == (fire and loaded)
        assert found["hit"] == state.tanks[0].hits - before[0]
        assert found["taken"] == state.tanks[0].taken - before[1]
        assert found["distance"] == pytest.approx(min(distance, 1600.0), abs=800.0 / UNIT + 1.0)
        if abs(ahead) > 0.02:
            assert found["behind"] == (ahead < 0)
        assert found["miss"] == (found["fired"] and not open_way)
        for name, value in found.items():
            counts[name] += value
    assert all(count for name, count in counts.items() if name not in ("hit", "taken")), counts
    assert continuous or counts["hit"] + counts["taken"] > 0


def test_the_lines_of_the_lab_are_rewards_of_the_environment() -> None:
    line = Trainer(FIRST, 1, fast=False).line
    assert parsed(line, names_of("pitanks"))
    assert rewards_of("pitanks", 20, reward=line).any()


def test_a_pickled_environment_goes_on_with_its_reward() -> None:
    envs = gymnasium.make_vec(GAMES["pitanks"], num_envs=2, reward="distance + behind", **SHORT)
    envs.reset(seed=1)
    envs.action_space.seed(1)
    actions = [envs.action_space.sample() for _ in range(20)]
    for action in actions[:10]:
        envs.step(action)
    again = pickle.loads(pickle.dumps(envs))
    for action in actions[10:]:
        assert (envs.step(action)[1] == again.step(action)[1]).all()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"reward": "hitz"}, "'hitz' is unknown; there are hits, taken"),
        ({"reward": ""}, "no reward in the line"),
        ({"reward": "open('x')"}, "cannot be understood"),
        ({"reward": "hits", "rewards": {"hits": 1.0}}, "one of them is enough"),
        ({"reward": 5}, "a line of code or a function"),
        ({"reward": lambda hit, foe: 0.0}, "parameter 'foe'"),
        ({"reward": lambda: 0.0}, "without parameters"),
    ],
)
def test_what_is_no_reward_is_refused_in_one_line(options: dict[str, Any], message: str) -> None:
    with pytest.raises(OptionError, match=message) as found:
        gymnasium.make(GAMES["pitanks"], **SHORT, **options)
    assert "\n" not in str(found.value)
