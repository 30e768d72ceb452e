"""Rewards as code: a line means what the weights mean, a function what the line means, and each quantity its event."""

import pickle
import re
from collections.abc import Callable
from functools import partial
from math import atan2, cos, hypot
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest

import pigaming_app.gym
from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.ai.reward_line import parsed, with_line
from pigaming_app.ai.reward_quantities import QUANTITIES as LAB_NAMES
from pigaming_app.ai.reward_quantities import WEIGHTED
from pigaming_app.gym.options import OptionError
from pigaming_app.gym.rewards import TALLIES, CodedReward, names_of
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


class Bonus:
    def __call__(self, hits: float, taken: float) -> float:
        return 2.0 * hits - taken


def scaled(factor: float, hits: float) -> float:
    return factor * hits


FORMS: dict[str, tuple[Any, Callable[[float, float], float]]] = {  # with what they give for hits and hits taken
    "plain": (lambda hits, taken: hits if hits > taken else 0.25, lambda hits, taken: hits if hits > taken else 0.25),
    "whole": (lambda hits: 1, lambda hits, taken: 1.0),
    "dict": (lambda hits: {0.0: 0.5}.get(hits, 1.0), lambda hits, taken: 1.0 if hits else 0.5),
    "object": (Bonus(), lambda hits, taken: 2.0 * hits - taken),
    "partial": (partial(scaled, 3.0), lambda hits, taken: 3.0 * hits),
}


@pytest.mark.parametrize("fast", [False, pytest.param(True, marks=needs_numba)])
@pytest.mark.parametrize("form", FORMS)
def test_whatever_can_be_called_is_a_reward(form: str, fast: bool) -> None:
    code, expected = FORMS[form]
    counts = [(0.0, 0.0), (1.0, 0.0), (2.0, 3.0)]
    rows = np.zeros((len(counts), 2, len(names_of("pitanks"))))
    rows[:, 0, :2] = rows[:, 1, :2] = counts
    found = CodedReward("pitanks", code, fast)(rows)
    assert found.dtype == float
    assert found.tolist() == [[expected(*pair)] * 2 for pair in counts]


@pytest.mark.parametrize("fast", [False, pytest.param(True, marks=needs_numba)])
@pytest.mark.parametrize(
    ("code", "wrong"),
    [(lambda hits: float("inf") if hits else 0.0, "inf"), (lambda hits: None, "nan"), (Bonus(), "nan")],
)
def test_a_reward_that_is_no_finite_number_is_refused_by_name(code: Any, wrong: str, fast: bool) -> None:
    rows = np.zeros((2, 1, len(names_of("pitanks"))))
    rows[1, 0, 0] = np.nan if wrong == "nan" else 1.0
    name = "Bonus" if isinstance(code, Bonus) else "<lambda>"
    with pytest.raises(ValueError, match=f"^reward {name}: a finite number is needed, not {wrong}$"):
        CodedReward("pitanks", code, fast)(rows)


@needs_numba
def test_a_division_by_zero_never_becomes_a_reward() -> None:
    rows = np.zeros((2, 1, len(names_of("pitanks"))))
    with pytest.raises(ZeroDivisionError):
        CodedReward("pitanks", lambda hits: hits / hits, False)(rows)
    with pytest.raises(ValueError, match="finite"):
        CodedReward("pitanks", lambda hits: hits / hits, True)(rows)
    assert not CodedReward("pitanks", "hits / hits", True)(rows).any()


def test_the_first_step_of_an_episode_asks_for_no_reward() -> None:
    """Its tallies fall back to zero, by changes that no decision has."""
    seen: list[float] = []

    def reward(shots: float) -> float:
        seen.append(shots)
        return shots

    found = rewards_of("pitanks", 36, reward=reward, max_episode_steps=8)
    assert min(seen) == 0.0
    assert sum(seen) == found.sum() > 0.0
    assert len(seen) >= 2 * 32  # four of 36 steps begin an episode
    assert not found[8::9].any()


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


def test_the_line_of_the_page_runs_in_the_lab_too() -> None:
    page = Path(__file__).resolve().parents[2] / "docs" / "gym.md"
    (line,) = re.findall(r'reward="(.*)"', page.read_text(encoding="utf-8"))
    assert Trainer(with_line(FIRST, line, LAB_NAMES, WEIGHTED), 1, fast=False).line == line
    assert parsed(line, names_of("pitanks"))


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
        ({"reward": lambda *, hits: hits}, "parameter 'hits' must be positional"),
        ({"reward": lambda *hits: 0.0}, "parameter 'hits' must be positional"),
        ({"reward": partial(scaled, factor=2.0)}, "parameter 'factor' must be positional"),
    ],
)
def test_what_is_no_reward_is_refused_in_one_line(options: dict[str, Any], message: str) -> None:
    with pytest.raises(OptionError, match=message) as found:
        gymnasium.make(GAMES["pitanks"], **SHORT, **options)
    assert "\n" not in str(found.value)
