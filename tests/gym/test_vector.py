"""A vector does what Gymnasium's own SyncVectorEnv does with our single environments, in all modes of autoreset."""

import copy
import pickle
from functools import partial

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.vector import AsyncVectorEnv, AutoresetMode, SyncVectorEnv

from pigaming_app.games.arenas import arenas
from pigaming_app.gym import ENVIRONMENTS, OptionError, parallel_env
from tests.cases import one_in, repeated

GAMES = sorted(ENVIRONMENTS)
MODES = list(AutoresetMode)
COUNT = 3
SHORT = {"compiled": False, "minutes": 0.05, "opponents": ("level1",), "starts": 7}  # 30 decisions


def one_of(name, limit, **options):
    return partial(gymnasium.make, name, max_episode_steps=limit, **{**SHORT, **options})


def both(name, mode, limit=None, **options):
    """Our vector, and Gymnasium's over single environments."""
    ours = gymnasium.make_vec(name, COUNT, autoreset_mode=mode, max_episode_steps=limit, **{**SHORT, **options})
    return ours, SyncVectorEnv([one_of(name, limit, **options)] * COUNT, autoreset_mode=mode)


def compared(ours, theirs, mode):
    """Steps of both. Single environments tell their tallies at every step, a vector at the end of an episode."""
    seen, rewards, terminated, truncated, infos = ours
    expected, their_rewards, their_terminated, late, their_infos = theirs
    assert np.array_equal(seen, expected)
    assert seen.dtype == expected.dtype
    assert np.abs(seen).max() <= 1.0
    assert np.array_equal(rewards, their_rewards)
    assert np.array_equal(terminated, their_terminated)
    assert np.array_equal(truncated, late & ~their_terminated)  # TimeLimit calls an episode both
    ended = terminated | truncated
    if not ended.any():
        assert infos == {}
        return ended
    if mode is AutoresetMode.SAME_STEP:
        for name in ("_final_obs", "_final_info"):
            assert np.array_equal(infos[name], their_infos[name])
        for mine, other in zip(infos["final_obs"], their_infos["final_obs"], strict=True):
            assert (mine is None) == (other is None)
            assert mine is None or np.array_equal(mine, other)
        infos, their_infos = infos["final_info"], their_infos["final_info"]
    assert infos.keys() == their_infos.keys()
    for name in infos:
        assert np.array_equal(infos[name], ended) if name[0] == "_" else True
        assert np.array_equal(infos[name][ended], their_infos[name][ended])
    return ended


def played(name, mode, steps, chance, **options):
    """Play both side by side with random actions, resets of some and of all, and seeds. The number of ends."""
    ours, theirs = both(name, mode, **options)
    assert ours.metadata["autoreset_mode"] is theirs.metadata["autoreset_mode"] is mode
    assert ours.single_observation_space == theirs.single_observation_space
    assert ours.action_space == theirs.action_space
    ours.action_space.seed(int(chance.integers(1000)))
    ended, ends = np.ones(COUNT, bool), 0

    def reset(mask, seeds):
        found = [
            env.reset(seed=copy.copy(seeds), options=None if mask is None else {"reset_mask": mask.copy()})
            for env in (ours, theirs)
        ]
        assert np.array_equal(found[0][0], found[1][0])
        assert found[0][1] == found[1][1] == {}

    reset(None, int(chance.integers(1000)))
    for _ in range(steps):
        action = ours.action_space.sample()
        found = ours.step(action)
        ended = compared(found, theirs.step(action), mode)
        if mode is AutoresetMode.DISABLED:
            found[0][:] = 9.0  # they belong to whoever got them
        ends += ended.sum()
        some, rare = chance.random(COUNT) < 0.4, chance.random() < 0.06
        seeds = [int(chance.integers(99)) if chance.random() < 0.5 else None for _ in range(COUNT)]
        if mode is AutoresetMode.DISABLED and ended.any():
            with pytest.raises(ResetNeeded, match=rf"\[{', '.join(map(str, np.flatnonzero(ended)))}\]"):
                ours.step(action)
            reset(ended | (some & rare), seeds if rare else None)
        elif rare:
            reset(some if some.any() else None, seeds if chance.random() < 0.5 else int(chance.integers(99)))
    return ends


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("name", GAMES)
def test_a_vector_is_a_sync_vector_env_of_single_environments(name, mode):
    chance = np.random.default_rng([*name.encode(), MODES.index(mode)])
    assert played(name, mode, 60, chance, limit=11, arena=arenas(ENVIRONMENTS[name])[:2]) >= 3 * COUNT
    if name == "PiTanks-v0":
        assert played(name, mode, 100, chance, variant="pickups") >= COUNT


@pytest.mark.long
@pytest.mark.parametrize(("name", "mode"), repeated([(name, mode) for name in GAMES for mode in MODES]))
def test_a_long_run_is_that_of_a_sync_vector_env(name, mode):
    chance = np.random.default_rng([1, *name.encode(), MODES.index(mode)])
    assert played(name, mode, 1000, chance, limit=23, arena="all", minutes=0.06) > 50


@pytest.mark.parametrize("mode", MODES)
def test_agents_of_a_match_end_and_begin_together(mode):
    """Two vectors with the same actions: pairs of learners, and the PettingZoo match of each pair."""
    options = {**SHORT, "agents": 2, "max_episode_steps": 9}
    pairs = gymnasium.make_vec("RobotFactory-v0", 4, autoreset_mode=mode, **options)
    matches = [parallel_env("factory", **options) for _ in range(2)]
    pairs.action_space.seed(1)
    first = pairs.reset(seed=5)[0]
    alone = np.concatenate([np.stack([*match.reset(seed=5 + i)[0].values()]) for i, match in enumerate(matches)])
    assert np.array_equal(first, alone)
    for _ in range(9):
        action = pairs.action_space.sample()
        seen, _, _, late, infos = pairs.step(action)
        rows = [m.step(dict(zip(m.possible_agents, action[2 * i :], strict=False)))[0] for i, m in enumerate(matches)]
        alone = np.concatenate([np.stack([*row.values()]) for row in rows])
        assert np.array_equal(np.stack(infos["final_obs"]) if "final_obs" in infos else seen, alone)
    assert late.all()
    again = np.concatenate([np.stack([*match.reset()[0].values()]) for match in matches])
    if mode is AutoresetMode.SAME_STEP:
        assert np.array_equal(seen, again)
    if mode is AutoresetMode.DISABLED:
        with pytest.raises(ValueError, match="begin the next one together"):
            pairs.reset(options={"reset_mask": np.array([True, True, True, False])})
        seen = pairs.reset(options={"reset_mask": np.array([False, False, True, True])})[0]
        assert np.array_equal(seen, np.concatenate([alone[:2], again[2:]]))


@pytest.mark.parametrize(
    ("mask", "reason"),
    [
        ([True, False], "an array of 2 bools"),
        (np.ones(3, bool), "an array of 2 bools"),
        (np.ones(2), "an array of 2 bools"),
        (np.zeros(2, bool), "no environment is selected"),
    ],
)
def test_a_wrong_mask_is_one_line(mask, reason):
    env = gymnasium.make_vec("PiTanks-v0", 2, autoreset_mode="Disabled", **SHORT)
    with pytest.raises(ResetNeeded, match="all matches begin"):
        env.reset(options={"reset_mask": np.ones(2, bool)})
    env.reset(seed=1)
    with pytest.raises(ValueError, match=reason):
        env.reset(options={"reset_mask": mask})
    with pytest.raises(OptionError, match="no autoreset mode 'Always'; there are NextStep, SameStep, Disabled"):
        gymnasium.make_vec("PiTanks-v0", 2, autoreset_mode="Always", **SHORT)
    with pytest.raises(OptionError, match=r"^stagger: True or False is needed, not 'yes'$"):
        gymnasium.make_vec("PiTanks-v0", 2, stagger="yes", **SHORT)


def test_observations_that_were_handed_out_never_change():
    for mode in MODES:
        env = gymnasium.make_vec("PiTanks-v0", 2, autoreset_mode=mode, max_episode_steps=2, **SHORT)
        seen = [env.reset(seed=1)[0]]
        for k in range(8):
            if mode is AutoresetMode.DISABLED and k % 2 == 0 and k:
                seen.append(env.reset(options={"reset_mask": np.ones(2, bool)})[0])
            seen.append(env.step(env.action_space.sample())[0])
            if k % 2 == 0:
                seen.append(env.reset(options={"reset_mask": np.array([True, False])})[0])
            before = [one.copy() for one in seen]
        assert all(np.array_equal(one, other) for one, other in zip(seen, before, strict=True))
        assert not any(np.shares_memory(one, other) for i, one in enumerate(seen) for other in seen[:i])


def ends_of(stagger, seed, steps=65, count=16, limit=None):
    """Of truncation and termination, by step and match."""
    options = {**SHORT, "variant": "pickups", "opponents": ("idle",), "max_episode_steps": limit}
    env = gymnasium.make_vec("PiTanks-v0", count, stagger=stagger, **options)
    env.reset(seed=seed)
    env.action_space.seed(1)
    steps = [env.step(env.action_space.sample())[:4] for _ in range(steps)]
    return [np.stack(parts) for parts in zip(*steps, strict=True)]


def test_staggered_matches_do_not_all_end_in_one_step():
    seen, _, terminated, truncated = ends_of(True, 3)
    plain, _, all_terminated, none = ends_of(False, 3)
    assert all_terminated.sum(1).max() == 16
    assert not none.any()
    assert (terminated | truncated).sum(1).max() < 6
    assert (truncated.sum(0) <= 1).all()  # the first episodes alone, or all but those that drew a whole match
    assert truncated.sum() >= 14
    cut = truncated.argmax(0)
    assert cut.min() < 5
    assert cut.max() > 20
    for match, step in enumerate(cut):  # until then nothing differs
        assert np.array_equal(seen[:step, match], plain[:step, match])
    again, other = ends_of(True, 3, 32), ends_of(True, 4, 32)
    assert np.array_equal(again[3], truncated[:32])
    assert not np.array_equal(other[3], truncated[:32])


def test_staggered_matches_spread_over_episodes_that_are_shorter_than_a_match():
    limit = 12
    truncated = ends_of(True, 3, 3 * limit, 24, limit)[3]
    assert truncated.sum(1).max() <= 6  # 24 matches over 12 steps
    for match in truncated.T:
        first, second, *_ = np.flatnonzero(match)
        assert first < limit
        assert second == first + 1 + limit  # one step is the first observation
    assert len({*truncated.argmax(0)}) > limit / 2


def went_on(env, step, count):
    """All that an environment gives in the next steps, as text of full precision."""
    with np.printoptions(threshold=10**6, floatmode="unique"):
        return [repr(step(env)) for _ in range(count)]


def step_of_vector(env):
    return env.step(env.action_space.sample())


def step_of_match(env):
    found = env.step({agent: env.action_space(agent).sample() for agent in env.possible_agents})
    return (found, env.state()) if env.agents else (found, env.reset())


def step_of_one(env):
    found = env.step(env.action_space.sample())
    return (found, env.reset()) if found[2] else found


@pytest.mark.parametrize("name", one_in(len(GAMES), ["RobotRace-v0", *sorted({*GAMES} - {"RobotRace-v0"})]))
def test_a_pickle_in_the_middle_of_a_match_goes_on_identically(name):
    game = ENVIRONMENTS[name]
    vector = gymnasium.make_vec(name, 3, stagger=True, max_episode_steps=12, **SHORT)
    for env, step in (
        (vector, step_of_vector),
        (gymnasium.make(name, **SHORT), step_of_one),
        (parallel_env(game, agents=2, **SHORT), step_of_match),
    ):
        for i, space in enumerate(getattr(env, "action_spaces", {"": env.action_space}).values()):
            space.seed(i)
        unborn = pickle.loads(pickle.dumps(env))
        for one in (env, unborn):
            one.reset(seed=3)
        assert went_on(unborn, step, 2) == went_on(env, step, 2)
        went_on(env, step, 6)
        twins = [pickle.loads(pickle.dumps(env)), copy.deepcopy(env)]
        expected = went_on(env, step, 25)
        assert all(went_on(twin, step, 25) == expected for twin in twins)
        assert expected[:12] != expected[12:24]


@pytest.mark.long
def test_a_pickle_is_the_same_for_both_bodies():
    options = {**SHORT, "agents": 2, "opponents": ("random",)}  # compiled once, with test_environments.py
    plain, fast = (gymnasium.make_vec("PiTanks-v0", 6, **{**options, "compiled": c}) for c in (False, True))
    for env in (plain, fast):
        env.reset(seed=3)
        env.action_space.seed(4)
        went_on(env, step_of_vector, 6)
    assert plain.matches.__getstate__()["records"] == fast.matches.__getstate__()["records"]
    twin = pickle.loads(pickle.dumps(fast))
    expected = went_on(plain, step_of_vector, 60)
    assert went_on(twin, step_of_vector, 60) == went_on(fast, step_of_vector, 60) == expected


def the_same(env):
    """A function for a process of its own."""
    return env


def test_environments_play_in_processes_of_their_own():
    """Started anew, so that nothing but the pickle gets there: in the middle of a match, with its wrappers."""
    envs = [gymnasium.make("PiTanks-v0", **SHORT) for _ in range(2)]
    for i, env in enumerate(envs):
        env.reset(seed=i)
        env.step([1, 2, 0, 0])
    ended = np.zeros(2, bool)
    there = AsyncVectorEnv([partial(the_same, env) for env in envs], context="spawn")
    try:
        for _ in range(35):
            action = there.action_space.sample()
            seen, rewards, terminated, *_ = there.step(action)
            for i, env in enumerate(envs):
                if ended[i]:
                    found, reward, over = env.reset()[0], 0.0, False
                else:
                    found, reward, over, *_ = env.step(action[i])
                assert np.array_equal(seen[i], found)
                assert (rewards[i], terminated[i]) == (reward, over)
            ended = terminated
    finally:
        there.close()
