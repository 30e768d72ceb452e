"""The environments pass the checkers of their libraries, and play the same matches in every face; an example."""

import os
import runpy
import subprocess
import sys
import warnings
from pathlib import Path

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.utils.env_checker import check_env

import pigaming_app.gym
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.gym import ENVIRONMENTS, OptionError, parallel_env
from pigaming_app.gym.rewards import TALLIES
from tests.cases import repeated

with warnings.catch_warnings():
    warnings.simplefilter("ignore", DeprecationWarning)  # of PettingZoo's own games, which its tests import
    from pettingzoo.test import parallel_api_test, parallel_seed_test
    from pettingzoo.test.state_test import state_test
    from pettingzoo.utils import parallel_to_aec

GAMES = list(ENVIRONMENTS.items())
SHORT = {"compiled": False, "minutes": 0.05}  # of pure Python: 30 decisions


def test_the_environments_leave_the_sound_of_the_program_as_it_was():
    assert os.environ["SDL_AUDIODRIVER"] == "dummy"


def played(env, seed, actions):
    """Observations, rewards and ends of an environment that is reset after the end of each episode."""
    found = [(*env.reset(seed=seed), 0.0, False)]
    for action in actions:
        observation, reward, terminated, truncated, info = env.step(action)
        found.append((observation, info, reward, terminated))
        assert not truncated
        if terminated:
            found.append((*env.reset(), 0.0, False))
    return found


@pytest.mark.parametrize(("name", "game"), GAMES)
def test_the_checkers_of_the_libraries_pass(name, game):
    check_env(gymnasium.make(name, **SHORT).unwrapped, skip_render_check=True)
    parallel_api_test(parallel_env(game, **SHORT), 100)
    parallel_seed_test(lambda: parallel_env(game, **SHORT), 30)
    state_test(parallel_to_aec(parallel_env(game, **SHORT)), parallel_env(game, **SHORT), 20)


@pytest.mark.long
@pytest.mark.parametrize(("name", "game"), repeated(GAMES))
def test_compiled_and_plain_play_agree_to_the_last_bit(name, game):
    options = {"num_envs": 6, "agents": 2, "opponents": ("random",), "arena": "all", "minutes": 0.2}
    for variant in ("party", None):
        plain, fast = (gymnasium.make_vec(name, compiled=c, variant=variant, **options) for c in (False, True))
        plain.action_space.seed(1)
        assert np.array_equal(plain.reset(seed=3)[0], fast.reset(seed=3)[0])
        for _ in range(130):
            assert np.array_equal(plain.action_masks(), fast.action_masks())
            action = plain.action_space.sample()
            expected, found = plain.step(action), fast.step(action)
            assert all(np.array_equal(a, b) for a, b in zip(expected[:4], found[:4], strict=True))
            assert str(expected[4]) == str(found[4])


@pytest.mark.parametrize(("name", "game"), GAMES)
def test_rewards_are_weighted_changes_of_the_tallies(name, game):
    names = TALLIES[game].names
    weights = {tally: 10.0**-k for k, tally in enumerate(names)}
    env = gymnasium.make(name, rewards=weights, opponents=("random",), **SHORT).unwrapped
    env.reset(seed=2)
    before = env.matches.result(0)
    env.action_space.seed(2)
    total, over = 0.0, False
    while not over:
        _, reward, over, _, info = env.step(env.action_space.sample())
        total += reward
    assert info == env.matches.result(0)
    assert info["win"] in (-1.0, 0.0, 1.0)
    assert total == pytest.approx(sum(weights[tally] * (info[tally] - before[tally]) for tally in names))


STEPS = 13


@pytest.mark.parametrize(("name", "game"), GAMES)
def test_truncated_episodes_carry_the_tallies_of_their_own_environment(name, game):
    """By the sum of its rewards: their weights are digits, so that it stands for all tallies of one environment."""
    weights = {tally: 10.0**-k for k, tally in enumerate(TALLIES[game].names)}
    options = {**SHORT, "rewards": weights, "max_episode_steps": STEPS}
    many = gymnasium.make_vec(name, num_envs=3, opponents=("random",), **options)
    one = gymnasium.make(name, opponents=("random",), **options)
    both = parallel_env(game, agents=2, **options)

    def worth(tallies):
        return sum(weights[tally] * tallies[tally] for tally in weights)

    for first in (True, False):
        many.reset(seed=5) if first else many.step(many.action_space.sample())
        one.reset(seed=5)
        both.reset(seed=5)
        began = [worth(many.unwrapped.matches.result(i)) for i in range(3)]
        began += [worth(one.unwrapped.matches.result(0)), *(worth(both.matches.result(0, i)) for i in range(2))]
        earned = np.zeros(6)
        for _ in range(STEPS):
            _, rewards, _, late, infos = many.step(many.action_space.sample())
            _, reward, _, cut, info = one.step(one.action_space.sample())
            _, of_both, _, ended, of_agents = both.step(
                {agent: both.action_space(agent).sample() for agent in both.agents}
            )
            earned += [*rewards, reward, *of_both.values()]
        assert [*late, cut, *ended.values()] == [True] * 6
        assert all(infos[f"_{tally}"].all() for tally in weights)
        told = [{tally: infos[tally][i] for tally in weights} for i in range(3)] + [info, *of_agents.values()]
        assert [worth(tallies) - at_first for tallies, at_first in zip(told, began, strict=True)] == pytest.approx(
            earned
        )
    many.close()


@pytest.mark.parametrize(("name", "game"), GAMES)
def test_no_episode_has_a_seed_that_is_played_or_measured(name, game):
    env = gymnasium.make(name, starts=3, **SHORT).unwrapped
    assert [env.task.setup_of(k).seed for k in range(3)] == [-1, -2, -3]


def test_continuous_actions_reach_the_same_states():
    positions = {"linear": (-1.0, 0.0, 1.0), "angular": (-1.0, -0.36, -0.11, 0.0, 0.11, 0.36, 1.0)}
    discrete, continuous = (gymnasium.make("PiTanks-v0", continuous=one, **SHORT) for one in (False, True))
    discrete.action_space.seed(4)
    actions = [discrete.action_space.sample() for _ in range(25)]
    sticks = [
        (positions["linear"][a], positions["angular"][b], float(fire), float(turbo)) for a, b, fire, turbo in actions
    ]
    for one, other in zip(played(discrete, 1, actions), played(continuous, 1, sticks), strict=True):
        assert np.array_equal(one[0], other[0])
        assert one[2:] == other[2:]
    assert continuous.action_space.contains(np.array(sticks[0]))


def test_episodes_are_truncated_and_agents_of_a_match_end_together():
    env = gymnasium.make_vec("RobotFactory-v0", num_envs=4, agents=2, max_episode_steps=5, compiled=False)
    env.reset(seed=1)
    ends = [env.step(np.ones((4, 4), int))[2:4] for _ in range(11)]
    assert [bool(truncated.all()) for _, truncated in ends] == [False] * 4 + [True] + [False] * 5 + [True]
    assert not any(terminated.any() for terminated, _ in ends)


@pytest.mark.parametrize(("name", "game"), GAMES)
def test_pictures_are_drawn_by_the_view_of_the_game(name, game):
    env = gymnasium.make(name, render_mode="rgb_array", **SHORT)
    env.reset(seed=1)
    first = env.render()
    env.step(env.action_space.sample())
    for _ in range(4):
        env.step([2, 3, 1, 0])
    second = env.render()
    assert first.shape == second.shape == (1080, 1920, 3)
    assert first.std() > 5.0
    assert 0.0 < (first != second).mean() < 0.2
    env.close()


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        ({"game": "chess"}, "no game 'chess'; there are pitanks, factory, race"),
        ({"speed": 2}, "no option 'speed'"),
        ({"opponents": ("stockfish",)}, "no brain 'stockfish'; there are idle, "),
        ({"opponents": ("lost.npz",)}, "lost.npz: "),
        ({"opponents": 3}, "opponents: names are needed, not 3"),
        ({"agents": 3, "opponents": ("level1", "level1")}, "3 agents and 2 opponents, but there are 4 seats"),
        ({"agents": 0}, "agents: a whole number from 1 is needed, not 0"),
        ({"arena": "moon"}, "moon: no such arena for pitanks"),
        ({"arena": ()}, "arena: none is named"),
        ({"variant": "quiet"}, "no variant 'quiet'"),
        ({"minutes": 0}, "0 minutes; possible are"),
        ({"minutes": "two"}, "minutes: a number is needed, not 'two'"),
        ({"teams": 3}, "teams: a number for each seat is needed, not 3"),
        ({"continuous": "no"}, "continuous: True or False is needed, not 'no'"),
        ({"compiled": "no"}, "compiled: True or False is needed, not 'no'"),
        ({"robots": 3}, "robots: the path of a file is needed, not 3"),
        ({"goal": 3}, "a goal of 3; pitanks is played for time alone"),
        ({"teams": (0, 0, 0, 0)}, "there must be at least two teams"),
        ({"ticks": 2.5}, "ticks: a whole number from 1 is needed, not 2.5"),
        ({"rewards": {"style": 1}}, "no reward 'style' in pitanks; there are hits, "),
        ({"rewards": {"hits": float("nan")}}, "rewards, hits: a number is needed, not nan"),
        ({"render_mode": "human"}, "no render mode 'human'; there is rgb_array"),
        ({"max_episode_steps": 0}, "max_episode_steps: a whole number from 1 is needed"),
    ],
)
def test_a_wrong_option_is_one_line(options, reason):
    with pytest.raises(OptionError) as caught:
        parallel_env(**{"game": "pitanks", "compiled": False, **options})
    assert str(caught.value).startswith(reason)
    assert "\n" not in str(caught.value)


FACES = {
    "one": lambda **options: gymnasium.make("PiTanks-v0", **options).unwrapped,
    "vector": lambda **options: gymnasium.make_vec("PiTanks-v0", num_envs=2, **options),
    "match": lambda **options: parallel_env("pitanks", **options),
}


@pytest.mark.parametrize("face", FACES)
@pytest.mark.parametrize(
    ("continuous", "action", "reason"),
    [
        (
            False,
            [0, 7, 0, 0],
            r"action \[0, 7, 0, 0\] of agent {last} lies outside the heads {{'drive': 3, 'turn': 7",
        ),
        (False, [-1, 0, 0, 0], r"action \[-1, 0, 0, 0\] of agent {last} lies outside"),
        (False, [0.5, 0, 0, 0], "actions are whole numbers"),
        (False, [1, 0, 0], "numbers are needed for each agent"),
        (True, [0.0, 1.01, 0.0, 0.0], r"of agent {last} lies outside sticks in \[-1, 1\], fire and turbo in \[0, 1\]"),
        (True, [0.0, 0.0, -0.5, 0.0], "of agent {last} lies outside sticks"),
        (True, [float("nan"), 0.0, 0.0, 0.0], "of agent {last} lies outside sticks"),
        (True, [0.0, 1.0], "numbers are needed for each agent"),
    ],
)
def test_actions_outside_the_space_are_refused_by_every_face(face, continuous, action, reason):
    env = FACES[face](continuous=continuous, **SHORT)
    last, good = 0 if face == "one" else 1, [0] * 4

    def step(action):
        mine = action if len(action) == 4 else [*action]
        other = good if len(action) == 4 else mine
        given = {"one": mine, "vector": [other, mine], "match": {"player_0": other, "player_1": mine}}
        return env.step(given[face])

    with pytest.raises(ResetNeeded, match=r"^step before reset: an episode begins with reset$"):
        step(good)
    env.reset(seed=1)
    with pytest.raises(ValueError, match=reason.format(last=last)) as caught:
        step(action)
    assert "\n" not in str(caught.value)
    if continuous:
        step(np.array([-1.0, 1.0, 0.0, 1.0], np.float32))
    else:
        step(np.array([2, 6, 1, 1], np.uint8))


@pytest.mark.parametrize("face", FACES)
def test_numbers_may_be_those_of_numpy(face):
    options = {"minutes": 0.05, "ticks": 4, "starts": 9, "teams": [0, 1, 1, 1], "compiled": False, "continuous": False}
    numpy = {name: np.array(value)[()] for name, value in options.items()}
    envs = [FACES[face](**options), FACES[face](**numpy)]
    seen = [str(env.reset(seed=seed)[0]) for env, seed in zip(envs, (5, np.uint32(5)), strict=True)]
    assert seen[0] == seen[1]
    assert envs[0].metadata["render_fps"] == envs[1].metadata["render_fps"] == 12.5
    many = [np.arange(5, 7), list(np.arange(5, 7)), (5, 6)]
    assert face != "vector" or all(str(envs[0].reset(seed=seeds)[0]) == seen[0] for seeds in many)


@pytest.mark.parametrize("face", FACES)
def test_a_seed_is_a_whole_number_from_0(face):
    env = FACES[face](**SHORT)
    wrong = [-1, np.int64(-1), 1.5, "3", np.float32(2.0)]
    for seed in [*wrong, *([one, 2] for one in wrong if face == "vector")]:
        with pytest.raises(ValueError, match=r"^seed: a whole number from 0 is needed, not "):
            env.reset(seed=seed)
    assert not env.matches.seeded


@pytest.mark.parametrize("compiled", [False, None])
@pytest.mark.parametrize("face", FACES)
def test_everything_about_a_match_needs_a_reset(face, compiled):
    env = FACES[face](**{**SHORT, "compiled": compiled, "render_mode": "rgb_array"})
    for name, call in {"step": lambda: env.step({}), "action_masks": env.action_masks, "render": env.render}.items():
        with pytest.raises(ResetNeeded, match=f"^{name} before reset: an episode begins with reset$"):
            call()


SAMPLE = np.array([[1, 2, 0, 1], [0, 1, 0, 0]])


@pytest.mark.parametrize(
    ("agents", "good", "bad"),
    [
        (1, [SAMPLE, SAMPLE[:, None]], [SAMPLE.T, SAMPLE.ravel(), SAMPLE[None], SAMPLE[0], [[1, 2, 0, 1], [0]]]),
        (2, [SAMPLE, SAMPLE[None]], [SAMPLE.T, SAMPLE.ravel(), SAMPLE[:, None]]),
    ],
)
def test_actions_have_the_shape_of_the_agents(agents, good, bad):
    first, *others = (gymnasium.make_vec("PiTanks-v0", 2, agents=agents, **SHORT) for _ in good)
    for env in (first, *others):
        env.reset(seed=1)
    for wrong in bad:
        with pytest.raises(ValueError, match=r"^actions .* 4 numbers are needed for each agent$"):
            first.step(wrong)
    seen = first.step(good[0])[0]
    assert all(np.array_equal(env.step(form)[0], seen) for env, form in zip(others, good[1:], strict=True))
    one = gymnasium.make("PiTanks-v0", **SHORT).unwrapped
    one.reset(seed=1)
    one.step(SAMPLE[0])
    with pytest.raises(ValueError, match="4 numbers are needed"):
        one.step(SAMPLE[0][:, None])


@pytest.mark.parametrize("kind", [bool, complex, object, str])
def test_sticks_are_numbers(kind):
    env = gymnasium.make_vec("PiTanks-v0", 2, continuous=True, **SHORT)
    env.reset(seed=1)
    sticks = np.array([[0, 1, 0, 1], [1, 0, 1, 0]])
    with pytest.raises(ValueError, match=r"^actions are numbers: two sticks, fire and turbo; not "):
        env.step(sticks.astype(kind))
    for good in (int, np.uint8, np.float16, np.float32):
        env.step(sticks.astype(good))


def test_every_agent_of_a_match_needs_an_action():
    match = parallel_env("pitanks", **SHORT)
    match.reset(seed=1)
    with pytest.raises(ValueError, match="player_1"):
        match.step({"player_0": (1, 3, 0, 0)})


@pytest.mark.parametrize("game", ENVIRONMENTS.values())
def test_the_state_is_what_all_agents_see(game):
    match = parallel_env(game, agents=2, **SHORT)
    seen, _ = match.reset(seed=1)
    while match.agents:
        assert np.array_equal(match.state(), np.concatenate([seen["player_0"], seen["player_1"]]))
        assert match.state() in match.state_space
        state, before = match.state(), match.state()
        seen = match.step({agent: match.action_space(agent).sample() for agent in match.agents})[0]
        assert np.array_equal(state, before)
        assert not np.array_equal(match.state(), before)


def test_without_the_extra_one_line_says_how_to_install_it():
    code = "import sys; sys.modules['pettingzoo'] = None; import pigaming_app.gym"
    done = subprocess.run([sys.executable, "-c", code], cwd=os.getcwd(), capture_output=True, text=True)
    assert (
        done.stderr.splitlines()[-1]
        == "ImportError: pigaming_app.gym needs pettingzoo: pip install '.[gym]' in the project's folder"
    )


def test_every_encoding_has_an_environment():
    assert set(ENVIRONMENTS.values()) == set(ENCODINGS) == set(TALLIES)
    assert pigaming_app.gym.__doc__


EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def test_the_tank_written_by_hand_beats_the_weakest_machine():
    agent = runpy.run_path(str(EXAMPLES / "hand_written_agent.py"))
    result = agent["play"](seed=1, minutes=0.5, compiled=False)
    assert result["win"] == 1.0
    assert result["lead"] > 10.0
    assert result["hits"] > result["taken"]
