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
from pigaming_app.gym.wrappers import FunctionReward, Lidar, OwnPicture

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


def test_a_picture_turns_with_the_robot():
    """By turning the places of things into the frame of the robot, not pixels into that of the arena."""
    pixels, scale = 64, 50.0
    options = {"variant": "pickups", "teams": (0, 0, 1, 1), "opponents": ("level3",) * 3}
    plain = gymnasium.make("PiTanks-v0", compiled=False, **options)
    env = OwnPicture(plain, pixels, scale)
    env.reset(seed=2)
    middle, counts = 0.5 * (pixels - 1), np.zeros(4)
    for _ in range(60):
        seen = env.step(env.action_space.sample())[0]
        assert seen in env.observation_space
        state = env.unwrapped.matches.state(0)
        me = state.robots[0]

        def place(x, y, me=me):
            turned = complex(x - me.x, y - me.y) / complex(np.cos(me.heading), np.sin(me.heading))
            row, column = middle - turned.real / scale, middle + turned.imag / scale
            inside = min(row, column) >= 0.0 and max(row, column) <= pixels - 1
            return (round(row), round(column)) if inside else None

        for k in range(1, 4):
            if spot := place(state.robots[k].x, state.robots[k].y):
                assert seen[1 if k == 1 else 2][spot] == 255
                counts[1 if k == 1 else 2] += 1
        for bullet in state.bullets:
            if bullet.alive and (spot := place(bullet.x, bullet.y)):
                assert seen[3][spot] == 255
                counts[3] += 1
        for x, y in ((-40.0, 450.0), (1640.0, 450.0), (800.0, -40.0), (800.0, 940.0)):
            if spot := place(x, y):
                assert seen[0][spot] == 255
                counts[0] += 1
        assert not seen[0][round(middle), round(middle)]
        assert (seen[1:3] > 0).sum() <= 3 * 4  # pixels that a robot's circle may hold
    assert (counts > 0).all()
    rows, columns = np.indices((pixels, pixels))
    z = complex(me.x, me.y) + scale * (middle - rows + 1j * (columns - middle)) * np.exp(1j * me.heading)
    gap = np.minimum(np.minimum(z.real, 1600.0 - z.real), np.minimum(z.imag, 900.0 - z.imag))
    for wall in state.walls[: state.wall_count]:
        for point in np.linspace(complex(wall.ax, wall.ay), complex(wall.bx, wall.by), 500):
            gap = np.minimum(gap, np.abs(z - point) - wall.half) if wall.health else gap
    sure = np.abs(gap) > 0.5
    assert np.array_equal(seen[0][sure] > 0, gap[sure] < 0.0)
    assert ((gap < 0.0) & (z.real > 0.0) & (z.real < 1600.0) & (z.imag > 0.0) & (z.imag < 900.0)).any()
    for wrong, reason in ({"pixels": 1}, "pixels: a whole number from 2"), ({"scale": 0.0}, "scale: a number from 1"):
        with pytest.raises(OptionError, match=reason):
            OwnPicture(plain, **wrong)


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


@pytest.mark.parametrize(("given", "wrong"), [(None, "nan"), (float("-inf"), "-inf")])
def test_a_reward_of_a_wrapper_is_a_finite_number(given, wrong):
    env = FunctionReward(gymnasium.make("PiTanks-v0", **SHORT), lambda before, after: given)
    env.reset(seed=1)
    with pytest.raises(ValueError, match=f"^reward <lambda>: a finite number is needed, not {wrong}$"):
        env.step([0, 0, 0, 0])
