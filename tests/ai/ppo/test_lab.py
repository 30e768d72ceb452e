"""The Lab's network: rewards that visitors change, training step by step, continuing from a file."""

from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from pigaming_app.ai.networks.pitanks import GUN, OTHERS, SIZE
from pigaming_app.ai.networks.policy import packed_layers
from pigaming_app.ai.ppo.lab import lesson
from pigaming_app.ai.ppo.lab.lesson import SECTORS, LabTraining, Situations
from pigaming_app.ai.ppo.lab.messages import UNTRAINED, Begin
from pigaming_app.ai.ppo.lab.task import HYPER, RIVAL, TASK, NetworkRecipe, reward_of
from pigaming_app.ai.ppo.learner import PolicyNetwork
from pigaming_app.ai.ppo.win_rates import win_rates
from pigaming_app.ai.reward_quantities import WEIGHTED
from pigaming_app.sim.kernel import can_compile
from tests.scenes.lab.plain_process import shrink

NOTHING = NetworkRecipe(**dict.fromkeys(WEIGHTED, 0.0), rest="")


@pytest.fixture
def threads(monkeypatch):
    shrink(monkeypatch)
    with ThreadPoolExecutor(1) as threads:
        yield threads


@pytest.mark.parametrize(
    ("knob", "gains", "inputs", "choices"),
    [
        ("hit", {0: 1.0}, {}, {}),
        ("miss", {}, {GUN: 0.0}, {2: 1}),
        ("behind", {}, {OTHERS + 4: -0.5}, {}),
        ("still", {}, {}, {0: 1}),
    ],
)
def test_each_knob_rewards_its_own_event_only(knob, gains, inputs, choices):
    gained, seen, chosen = np.zeros((1, 2, 3)), np.zeros((1, 2, SIZE + 1)), np.zeros((1, 2, 4), int)
    seen[..., GUN] = 1.0
    for array, changes in ((gained, gains), (seen, inputs), (chosen, choices)):
        for k, value in changes.items():
            array[0, 0, k] = value

    def reward(**knobs):
        return reward_of(NetworkRecipe(**{**vars(NOTHING), **knobs}))(gained, seen, chosen, 0.0)[0]

    assert reward(**{knob: 10.0}) - reward() == pytest.approx([max(reward(**{knob: 10.0})), 0.0])
    assert reward(**{knob: 10.0})[0] > 0.1
    assert reward(**{knob: -10.0})[0] == pytest.approx(-reward(**{knob: 10.0})[0])
    assert reward(**{other: 10.0 for other in WEIGHTED if other != knob}) == pytest.approx([0.0, 0.0])
    assert reward(rest=f"10*{knob}") == pytest.approx(reward(**{knob: 10.0})), "a term of the line is a knob"


def test_it_learns_step_by_step_and_reports(threads: Executor):
    taught = LabTraining(Begin(7, 3), threads)
    first = taught.report()
    assert (first.number, first.state.updates, first.state.matches) == (7, 0, 0.0)
    assert first.share is not None
    assert first.knowing == pytest.approx(0.0, abs=0.01)
    for _ in range(3):
        taught.learn(NetworkRecipe())
    report = taught.report()
    assert report.state.updates == 3
    assert 3 * 4 * (6 + 2 * 2) / 2 < report.state.decisions <= 3 * 4 * (6 + 2 * 2), "less where matches ended"
    assert report.state.matches == pytest.approx(3 * 8 * 0.4 / (60 * 0.05))
    assert len(report.habits) == SECTORS
    assert any(report.habits)
    assert not np.array_equal(report.state.weights.matrices[0], first.state.weights.matrices[0])
    assert [array.shape for array in report.state.weights.matrices] == [
        array.shape for array in UNTRAINED.weights.matrices
    ]


def test_a_network_from_a_file_stays_as_it_is_until_its_value_function_is_learned(
    threads: Executor, monkeypatch: pytest.MonkeyPatch
):
    before = LabTraining(Begin(0, 3), threads)
    before.learn(NetworkRecipe())
    state = before.report().state._replace(matches=12.5, updates=40)
    monkeypatch.setattr(lesson, "HYPER", replace(HYPER, matches=8, decisions=4, held=3))
    taught = LabTraining(Begin(1, 4, state), threads)
    values = [matrix.copy() for matrix in taught.training.learner.value.weights]
    for _ in range(3):
        taught.learn(NetworkRecipe())
    held = taught.report(measured=False).state
    for one, other in zip(held.weights.matrices, state.weights.matrices, strict=True):
        assert np.array_equal(one, other)
    assert not np.array_equal(taught.training.learner.value.weights[0], values[0])
    assert held.updates == 40 + 3
    assert held.matches > 12.5
    taught.learn(NetworkRecipe())
    assert not np.array_equal(taught.report(measured=False).state.weights.matrices[0], state.weights.matrices[0])


def test_the_plan_tells_left_from_right():
    """A policy that turns towards the opponent, and a value that falls from ahead to behind."""
    random = np.random.default_rng(1)
    policy, value = PolicyNetwork(SIZE, 14, 0.01, random), PolicyNetwork(SIZE, 1, 1.0, random)
    for network in (policy, value):
        for matrix in network.weights:
            matrix[:] = 0.0
    policy.weights[0][OTHERS + 5, 0] = policy.weights[1][0, 0] = 3.0
    policy.weights[2][0, 9], policy.weights[2][0, 3] = 5.0, -5.0  # the outermost turns right and left
    value.weights[0][OTHERS + 4, 0] = value.weights[1][0, 0] = value.weights[2][0, 0] = 1.0
    angles = np.arange(SECTORS) * (2.0 * np.pi / SECTORS)
    inputs = np.zeros((SECTORS, SIZE + 1), np.float32)
    inputs[:, OTHERS + 4], inputs[:, OTHERS + 5] = np.cos(angles), np.sin(angles)
    situations = Situations()
    situations.add(np.delete(inputs, 8, axis=0))
    plan = {k: habit for k, habit in enumerate(situations.habits(policy, value)) if habit}
    assert plan.keys() == {*range(SECTORS)} - {8}
    assert [plan[k].action for k in (2, 4, 6)] == ["turn_right"] * 3
    assert [plan[k].action for k in (10, 12, 14)] == ["turn_left"] * 3
    assert plan[0].action == "unknown"
    assert plan[0].value > plan[4].value > plan[7].value
    assert plan[0].value > 0.0 > plan[7].value


@pytest.mark.long
@pytest.mark.again
@pytest.mark.skipif(not can_compile(), reason="numba is not installed")
def test_it_beats_the_hand_made_robot_within_a_minute_at_the_speed_of_real_matches():
    with ThreadPoolExecutor(1) as threads:
        taught = LabTraining(Begin(0, 3), threads)
        share = taught.report().share
        assert share is not None
        assert share < 0.2
        while taught.training.updates * lesson.LESSON < 60.0:
            taught.learn(NetworkRecipe())
        assert win_rates(TASK, packed_layers(taught.training.layers()), 50, threads)[RIVAL].wins >= 40
