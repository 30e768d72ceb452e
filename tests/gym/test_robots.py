"""Robots drawn from measured ones drive as those of the arcade's own plant with the same numbers."""

import copy
import pickle

import gymnasium
import numpy as np
import pytest

from pigaming_app.games.match import Match
from pigaming_app.gym import ENVIRONMENTS, OptionError
from pigaming_app.gym.robots import PARAMETERS, drawn_robots
from pigaming_app.sim.action import set_action
from pigaming_app.sim.drivetrain import Drivetrain, Wheel, to_toml
from pigaming_app.sim.plant import SimPlant
from pigaming_app.sim.world import ROBOTS

SLOW = Drivetrain(Wheel(290.0, 0.05), Wheel(240.0, 0.0), 70.0, 0.15, 0.12)
QUICK = Drivetrain(Wheel(800.0, 0.02), Wheel(760.0, 0.03), 62.0, 0.06, 0.0)
SHORT = {"compiled": False, "minutes": 0.05}


class Stick:
    """A brain that does as it was told."""

    def __init__(self):
        self.action = []

    def think(self, match, seat):
        set_action(match.actions[seat], *self.action)


def file_of(folder, *robots):
    path = folder / "robots.toml"
    path.write_text(to_toml(robots))
    return str(path)


@pytest.mark.parametrize("robot", [SLOW, QUICK])
@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_a_measured_robot_drives_as_in_the_arcade(name, robot, tmp_path):
    """With one robot in the file nothing is drawn. Both play the same match, with the same sticks."""
    options = {**SHORT, "continuous": True, "opponents": ("idle",), "robots": file_of(tmp_path, robot)}
    env = gymnasium.make(name, **options).unwrapped
    env.reset(seed=3)
    env.action_space.seed(4)
    plants = []

    def plant(state):
        plants.append(SimPlant(state, (robot,) * ROBOTS))
        return plants[0]

    match = Match(env.task.setup_of(int(env.matches.start_of[0])), plant)
    stick = match.brains[0] = Stick()
    for _ in range(29):
        action = env.action_space.sample()
        stick.action = [*map(float, action[:2]), int(action[2] > 0.5), int(action[3] > 0.5)]
        env.step(action)
        for _ in range(5):
            match.tick()
        for mine, other in zip(env.matches.states[0].robots, match.state.robots, strict=True):
            assert [mine.x, mine.y, mine.heading, mine.linear] == [other.x, other.y, other.heading, other.linear]
    nominal = gymnasium.make(name, **{**options, "robots": None}).unwrapped
    nominal.reset(seed=3)
    nominal.action_space.seed(4)
    for _ in range(29):
        nominal.step(nominal.action_space.sample())
    assert nominal.matches.states[0].robots[0].x != env.matches.states[0].robots[0].x


def test_robots_lie_between_the_measured_ones_and_follow_from_the_seed(tmp_path):
    rows = np.stack([drawn_robots((SLOW, QUICK), np.random.default_rng(seed)) for seed in range(200)])
    assert rows.shape == (200, ROBOTS, PARAMETERS)
    left, _, _, deadband, base, gain, ticks = rows.reshape(-1, PARAMETERS).T
    for values, least, most in (
        (left, 290.0, 800.0),
        (deadband, 0.0, 0.03),
        (base, 62.0, 70.0),
        (gain, 1.0 - np.exp(-0.02 / 0.15), 1.0 - np.exp(-0.02 / 0.06)),
        (ticks, 0.0, 6.0),
    ):
        near = 0.05 * (most - least)
        assert least <= values.min() <= least + near
        assert most - near <= values.max() <= most
    assert set(ticks) == set(range(7))

    options = {**SHORT, "robots": file_of(tmp_path, SLOW, QUICK), "max_episode_steps": 9}
    one, same, other = (gymnasium.make_vec("PiTanks-v0", 3, **options) for _ in range(3))
    seeds = {one: 1, same: 1, other: 7}
    for env, seed in seeds.items():
        env.reset(seed=seed)
        env.action_space.seed(1)
    for k in range(25):
        action = one.action_space.sample()
        if k == 13:
            same = pickle.loads(pickle.dumps(same))
            twin = copy.deepcopy(same)
        found = one.step(action)[0]
        assert np.array_equal(found, same.step(action)[0])
        assert k < 13 or np.array_equal(found, twin.step(action)[0])
        assert not np.array_equal(found, other.step(action)[0])


@pytest.mark.again
@pytest.mark.long
def test_both_bodies_have_the_same_robots(tmp_path):
    options = {"agents": 2, "opponents": ("random",), "arena": "all"}  # compiled once, with test_environments.py
    robots = file_of(tmp_path, SLOW, QUICK)
    plain, fast = (gymnasium.make_vec("PiTanks-v0", 6, robots=robots, compiled=c, **options) for c in (False, True))
    plain.action_space.seed(1)
    assert np.array_equal(plain.reset(seed=2)[0], fast.reset(seed=2)[0])
    for _ in range(80):
        action = plain.action_space.sample()
        assert np.array_equal(plain.step(action)[0], fast.step(action)[0])
    assert plain.matches.__getstate__()["records"] == fast.matches.__getstate__()["records"]


@pytest.mark.parametrize(
    ("text", "reason"),
    [(None, "robots: .*: No such file"), ("[[robot]]\nleft = 3\n", "robots: .*left"), ("", "robots: .*0 robots")],
)
def test_a_wrong_file_is_one_line(text, reason, tmp_path):
    path = tmp_path / "robots.toml"
    if text is not None:
        path.write_text(text)
    with pytest.raises(OptionError, match=reason) as caught:
        gymnasium.make("PiTanks-v0", robots=str(path), **SHORT)
    assert "\n" not in str(caught.value)
