"""The vector for Stable-Baselines3 does what DummyVecEnv does with single environments.

Stable-Baselines3 comes with PyTorch, a gigabyte in which no job of the arcade has a part. What it asks of a vector is
proved everywhere on a stand-in of its base class; `test --long` compares with its own classes where it is installed.
"""

import importlib
import subprocess
import sys
from functools import partial
from importlib.util import find_spec
from types import ModuleType

import gymnasium
import numpy as np
import pytest

import pigaming_app.gym

SHORT = {"compiled": False, "minutes": 0.05, "opponents": ("level1",)}  # 30 decisions
COUNT = 3
where_it_is = pytest.mark.skipif(not find_spec("stable_baselines3"), reason="Stable-Baselines3 is not installed")


class StandIn:
    """Of VecEnv: what its documentation gives to derived classes."""

    def __init__(self, num_envs, observation_space, action_space):
        self.num_envs, self.observation_space, self.action_space = num_envs, observation_space, action_space
        self._reset_seeds()

    def _reset_seeds(self):
        self._seeds = [None] * self.num_envs

    def _reset_options(self):
        pass

    def seed(self, seed):
        self._seeds = [seed + i for i in range(self.num_envs)]

    def _get_indices(self, indices):
        return range(self.num_envs) if indices is None else [indices] if isinstance(indices, int) else indices

    def step(self, actions):
        self.step_async(actions)
        return self.step_wait()

    def step_async(self, actions):
        raise NotImplementedError

    def step_wait(self):
        raise NotImplementedError


@pytest.fixture
def vec_env(monkeypatch):
    """SeatVecEnv on the stand-in."""
    names = "stable_baselines3", "stable_baselines3.common", "stable_baselines3.common.vec_env"
    for name in names:
        monkeypatch.setitem(sys.modules, name, ModuleType(name))
    monkeypatch.setattr(sys.modules[names[-1]], "VecEnv", StandIn, raising=False)
    monkeypatch.delitem(sys.modules, "pigaming_app.gym.sb3", raising=False)
    yield importlib.import_module("pigaming_app.gym.sb3").SeatVecEnv
    sys.modules.pop("pigaming_app.gym.sb3")


def by_hand(envs, actions):
    """A step of single environments, as the documentation of VecEnv describes it."""
    rows = []
    for env, action in zip(envs, actions, strict=True):
        observation, reward, terminated, truncated, tallies = env.step(action)
        info = {"TimeLimit.truncated": truncated and not terminated}
        if terminated or truncated:
            info |= {**tallies, "terminal_observation": observation}
            observation, _ = env.reset()
        rows.append((observation, reward, terminated or truncated, info))
    observations, rewards, ended, infos = zip(*rows, strict=True)
    return np.stack(observations), np.array(rewards, np.float32), np.array(ended), infos


def check_step(found, expected):
    for mine, other in zip(found[:3], expected[:3], strict=True):
        assert np.array_equal(mine, other)
        assert mine.dtype == other.dtype
    for mine, other in zip(found[3], expected[3], strict=True):
        assert repr(mine.pop("terminal_observation", None)) == repr(other.pop("terminal_observation", None))
        assert mine == other


@pytest.mark.parametrize("limit", [None, 7])
@pytest.mark.parametrize("continuous", [False, True])
def test_it_keeps_what_is_asked_of_a_vector(vec_env, continuous, limit):
    options = {**SHORT, "max_episode_steps": limit, "continuous": continuous, "variant": "pickups"}
    env, alone = (
        vec_env("PiTanks-v0", COUNT, **options),
        [gymnasium.make("PiTanks-v0", **options) for _ in range(COUNT)],
    )
    env.seed(4)
    assert np.array_equal(env.reset(), np.stack([one.reset(seed=4 + i)[0] for i, one in enumerate(alone)]))
    env.action_space.seed(1)
    ends = 0
    for _ in range(70):
        action = [env.action_space.sample() for _ in range(COUNT)]
        found = env.step(np.array(action))
        ends += found[2].sum()
        check_step(found, by_hand(alone, action))
    assert ends >= COUNT
    assert np.array_equal(env.reset(), np.stack([one.reset()[0] for one in alone]))


def test_observations_are_not_copied(vec_env):
    env = vec_env("PiTanks-v0", COUNT, **SHORT)
    env.reset()
    for _ in range(35):
        seen = env.step(np.ones((COUNT, 4), int))[0]
        assert np.shares_memory(seen, env.envs.unwrapped._seen)


def test_attributes_and_methods_are_those_of_all_matches(vec_env):
    env = vec_env("RobotFactory-v0", 4, agents=2, compiled=False, opponents=())
    env.seed(3)
    pairs = gymnasium.make_vec("RobotFactory-v0", 4, agents=2, compiled=False, opponents=())
    assert np.array_equal(env.reset(), pairs.reset(seed=3)[0])
    assert env.get_attr("num_envs", [0, 2]) == [4, 4]
    env.set_attr("mark", 5)
    assert env.get_attr("mark", 1) == [5]
    with pytest.raises(ValueError, match="they are one environment"):
        env.set_attr("mark", 6, indices=[0, 1])
    env.envs.numbers = lambda plus: [i + plus for i in range(4)]
    assert env.env_method("numbers", 10, indices=[3, 1]) == [13, 11]
    assert env.env_is_wrapped(gymnasium.Wrapper) == [False] * 4
    assert env.get_images() == ()
    env.close()


def test_without_it_one_line_says_how_to_install_it():
    code = "import sys; sys.modules['stable_baselines3'] = None; import pigaming_app.gym.sb3"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    line = "ImportError: pigaming_app.gym.sb3 needs Stable-Baselines3: pip install stable-baselines3"
    assert done.stderr.splitlines()[-1] == line


@where_it_is
@pytest.mark.long
@pytest.mark.again  # `.ci/run` has no PyTorch
@pytest.mark.parametrize("limit", [None, 11])
@pytest.mark.parametrize("name", pigaming_app.gym.ENVIRONMENTS)
def test_it_is_a_dummy_vec_env_of_single_environments(name, limit):
    from stable_baselines3.common.vec_env import DummyVecEnv, VecMonitor

    from pigaming_app.gym.sb3 import SeatVecEnv

    options = {
        **SHORT,
        "max_episode_steps": limit,
        "variant": "pickups" if name == "PiTanks-v0" else None,
    }  # no overtime
    ours = VecMonitor(SeatVecEnv(name, COUNT, **options), info_keywords=("win",))
    theirs = VecMonitor(DummyVecEnv([partial(gymnasium.make, name, **options)] * COUNT), info_keywords=("win",))
    for env in (ours, theirs):
        env.seed(2)
        env.action_space.seed(3)
    assert np.array_equal(ours.reset(), theirs.reset())
    ends = 0
    for _ in range(100):
        action = np.array([ours.action_space.sample() for _ in range(COUNT)])
        found, expected = ours.step(action), theirs.step(action)
        for i, ended in enumerate(found[2]):
            if ended:
                mine, other = (infos[i].pop("episode") for infos in (found[3], expected[3]))
                assert [mine[key] for key in ("r", "l", "win")] == [other[key] for key in ("r", "l", "win")]
                ends += 1
            else:  # single environments tell their tallies at every step
                expected[3][i] = {"TimeLimit.truncated": False}
        check_step(found, expected)
    assert ends >= COUNT or name == "Football-v0"


@where_it_is
@pytest.mark.long
@pytest.mark.again
@pytest.mark.parametrize("continuous", [False, True])
def test_its_algorithms_learn_on_it(continuous):
    """In a race without opponents: where progress leads, in a thousand decisions of each seat."""
    import torch
    from stable_baselines3 import PPO
    from stable_baselines3.common.vec_env import VecMonitor, VecNormalize

    from pigaming_app.gym.sb3 import SeatVecEnv

    torch.set_num_threads(1)
    options = {"opponents": (), "agents": 1, "max_episode_steps": 50, "continuous": continuous}
    env = VecNormalize(VecMonitor(SeatVecEnv("RobotRace-v0", 32, **options)), norm_obs=False)
    model = PPO("MlpPolicy", env, n_steps=50, batch_size=400, n_epochs=6, learning_rate=1e-3, seed=1, device="cpu")
    model.learn(1600)
    before = np.mean([episode["r"] for episode in model.ep_info_buffer])
    model.learn(32000, reset_num_timesteps=False)
    assert np.mean([episode["r"] for episode in model.ep_info_buffer]) > before + 1.0
