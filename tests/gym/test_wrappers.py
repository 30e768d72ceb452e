"""A lidar by small steps, and rewards by hand."""

import pickle
import warnings
from functools import partial
from math import hypot

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import SyncVectorEnv

from pigaming_app.gym import ENVIRONMENTS, OptionError
from pigaming_app.gym.wrappers import FunctionReward, Lidar

SHORT = {"compiled": False, "minutes": 0.05}
STEP = 0.25  # px


def by_steps(state, rays, reach):
    """Distances to the first point, of many on each ray, that lies in a wall, beyond the rim, or in a robot."""
    me = state.robots[0]
    way = np.arange(0.0, reach, STEP)
    angles = me.heading + np.arange(rays) * (2.0 * np.pi / rays)
    x, y = me.x + np.outer(np.cos(angles), way), me.y + np.outer(np.sin(angles), way)
    solid = (x <= 0.0) | (y <= 0.0) | (x >= 1600.0) | (y >= 900.0)
    for wall in state.walls[: state.wall_count]:
        if wall.health:
            ex, ey = wall.bx - wall.ax, wall.by - wall.ay
            length = hypot(ex, ey)
            ex, ey = (ex / length, ey / length) if length else (1.0, 0.0)
            along = np.clip((x - wall.ax) * ex + (y - wall.ay) * ey, 0.0, length)
            solid |= np.hypot(x - wall.ax - along * ex, y - wall.ay - along * ey) < wall.half
    bodies = np.zeros_like(solid)
    for robot in state.robots[1:]:
        bodies |= np.hypot(x - robot.x, y - robot.y) < 36.0 if robot.present else False
    return [np.where(hit.any(1), way[hit.argmax(1)], reach) for hit in (solid, bodies)]


@pytest.mark.parametrize(("name", "game"), ENVIRONMENTS.items())
def test_a_lidar_measures_what_small_steps_find(name, game):
    chance = np.random.default_rng(1)
    rays, reach = 24, 700.0
    env = Lidar(gymnasium.make(name, arena="all", opponents=("random",) * 2, **SHORT), rays, reach)
    near = [0, 0]
    for k in range(5):
        seen, _ = env.reset(seed=k)
        for _ in range(int(chance.integers(1, 12))):
            seen = env.step([2, *(chance.integers(n) for n in env.action_space.nvec[1:])])[0]
        state = env.unwrapped.matches.state(0)
        if k == 4:  # a wall that bullets have broken
            for wall in state.walls[::2]:
                wall.health = 0
            seen = env.observation(None)
        assert seen in env.observation_space
        for kind, distances in enumerate(by_steps(state, rays, reach)):
            assert np.abs(reach * seen[kind] - distances).max() < 4.0 * STEP  # a ray may graze
            near[kind] += (distances < reach).sum()
    assert near[0] > 20
    assert near[1] > 1


def test_a_lidar_is_an_environment_of_its_own():
    env = Lidar(gymnasium.make("PiTanks-v0", **SHORT), 7)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", ".*is different from the unwrapped version")
        check_env(env, skip_render_check=True)
    assert env.observation_space.shape == (2, 7)
    many = SyncVectorEnv([partial(pickle.loads, pickle.dumps(env))] * 2)
    assert many.reset(seed=1)[0].shape == (2, 2, 7)
    for wrong, reason in ({"rays": 0}, "rays: a whole number from 1"), ({"reach": 3}, "reach: a number from 36"):
        with pytest.raises(OptionError, match=reason):
            Lidar(gymnasium.make("PiTanks-v0", **SHORT), **wrong)


def shots_and_way(before, after):
    """A reward by hand."""
    moved = hypot(after.seen.x - before.seen.x, after.seen.y - before.seen.y)
    return moved - 3.0 * (after.tallies["shots"] - before.tallies["shots"]) + 100.0 * after.over


def test_a_function_is_a_reward():
    env = FunctionReward(gymnasium.make("PiTanks-v0", variant="pickups", **SHORT), shots_and_way)
    twin = gymnasium.make("PiTanks-v0", variant="pickups", rewards={"shots": 1.0}, **SHORT)
    env.action_space.seed(1)
    for episode in range(2):
        one, other = env.reset(seed=episode)[0], twin.reset(seed=episode)[0]
        assert np.array_equal(one, other)
        over, shots = False, 0.0
        while not over:
            robot = twin.unwrapped.matches.state(0).robots[0]
            x, y, action = robot.x, robot.y, env.action_space.sample()
            one, reward, over, *_ = env.step(action)
            other, fired, ended, *_ = twin.step(action)
            robot = twin.unwrapped.matches.state(0).robots[0]
            assert np.array_equal(one, other)
            assert over == ended
            assert reward == pytest.approx(hypot(robot.x - x, robot.y - y) - 3.0 * fired + 100.0 * over)
            shots += fired
        assert shots
