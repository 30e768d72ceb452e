"""A team's critic: its value function sees what the mates see, its policy does not."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from pigaming_app.ai.learning.team_critic import team_views
from pigaming_app.ai.networks.files import decode, encode
from pigaming_app.ai.ppo import product
from pigaming_app.ai.ppo.population import Pool
from pigaming_app.ai.ppo.product import trained_network
from pigaming_app.ai.ppo.task import EXPLOITER, LEARNER, OFF, LineUp
from pigaming_app.ai.ppo.task_file import file_of, parse_task_file, text_of, with_file
from pigaming_app.ai.ppo.training import Training, in_threads
from tests.ai.ppo.plain import TASK, TINY, play_plain, same

SIDES = (0, 1, 0, 1)
LINE_UPS = (
    LineUp(1, (LEARNER, LEARNER, LEARNER, LEARNER), SIDES),
    LineUp(1, (LEARNER, EXPLOITER, LEARNER, EXPLOITER), SIDES),
    LineUp(1, (LEARNER, EXPLOITER, EXPLOITER, LEARNER), (0, 0, 1, 1)),
    LineUp(1, (LEARNER, "idle", "idle", "idle"), (0, 0, 0, 0)),
    LineUp(1, (LEARNER, LEARNER, LEARNER, LEARNER), (0, 0, 0, 0)),
    LineUp(1, (LEARNER, EXPLOITER, OFF, OFF)),
)
TEAMS = replace(TASK, line_ups=LINE_UPS, team_critic=True)
HYPER = replace(TINY, matches=6, decisions=1)


@pytest.fixture(autouse=True)
def _plain(monkeypatch):
    play_plain(monkeypatch)


def trained(training, updates, threads=1):
    with ThreadPoolExecutor(threads) as executor:
        for _ in range(updates):
            training.update(in_threads(training, executor), executor)
    return training


def test_it_sees_own_inputs_and_the_mean_of_the_mates():
    """Two decisions of four streams: two mates, one who has both others as mates, one who is alone."""
    inputs = np.arange(16, dtype=np.float32).reshape(2, 4, 2)
    inputs[..., 1] = 1.0
    mates = np.array([[1, -1, -1], [0, -1, -1], [0, 1, -1], [-1, -1, -1]])
    assert team_views(inputs, mates).tolist() == [
        [[0, 2, 1, 1], [2, 0, 1, 1], [4, 1, 1, 1], [6, 0, 0, 1]],
        [[8, 10, 1, 1], [10, 8, 1, 1], [12, 9, 1, 1], [14, 0, 0, 1]],
    ]


def collected(training, decisions=1):
    """What the shards of a training play, with who sat where: players, streams and teams by match and seat."""
    policies = [np.stack(layer) for layer in zip(*(one.policy.weights for one in training.learners), strict=True)]
    for shard in training.shards:
        streams, teams = shard.streams.tolist(), shard.matches["robots"]["team"].tolist()
        yield shard.collect(policies, Pool(np.concatenate(training.pools)), decisions), streams, teams


def test_mates_are_those_of_the_same_learner_in_the_same_team():
    """Of each match seat by seat."""
    seen = set()
    for found, streams, teams in collected(Training(TEAMS, 5, 4, HYPER)):
        for row, sides in zip(streams, teams, strict=True):
            seated = [(seat, stream) for seat, stream in enumerate(row) if stream >= 0]
            for seat, stream in seated:
                expected = [
                    other
                    for place, other in seated
                    if place != seat and sides[place] == sides[seat] and found.players[other] == found.players[stream]
                ]
                assert sorted(found.mates[stream].tolist()) == sorted([-1] * (3 - len(expected)) + expected)
                seen.add((int(found.players[stream]), len(expected)))
    assert seen == {(0, 0), (0, 1), (0, 3), (1, 0), (1, 1)}


def test_its_gradient_is_that_of_finite_differences():
    """Of half the mean squared error, by the weights of what the mates see, from matches of a training."""
    training = Training(TEAMS, 5, 4, HYPER)
    parts = [training._digested(0, found, 0.0) for found, *_ in collected(training, 2)]
    *_, returns, views = (np.concatenate(part).astype(float) for part in zip(*parts, strict=True))
    size, value = TEAMS.encoding.size, training.learner.value
    assert views.shape[1] == 2 * size + 2
    value.weights = [matrix.astype(float) for matrix in value.weights]

    def loss():
        return 0.5 * float(((value.forward(views)[0][0] - returns) ** 2).mean())

    outputs, trail = value.forward(views)
    gradient, matrix = value.gradient((outputs - returns) / len(views), trail)[0], value.weights[0]
    heard = np.flatnonzero(np.abs(views[:, size : 2 * size + 1]).max(0)) + size
    assert heard[-1] == 2 * size, "whether there is a mate is an input"
    for k in heard[::-9].tolist():
        before, ends = matrix[k, 3], []
        for side in (1, -1):
            matrix[k, 3] = before + side * 1e-5
            ends.append(loss())
        matrix[k, 3] = before
        assert gradient[k, 3] == pytest.approx((ends[0] - ends[1]) / 2e-5, rel=1e-4, abs=1e-9)
    assert np.abs(gradient[heard]).max() > 1e-4


def test_it_goes_on_from_a_checkpoint_bit_for_bit_and_its_network_is_like_any_other(tmp_path):
    halfway, path = trained(Training(TEAMS, 5, 4, HYPER), 1), tmp_path / "a.checkpoint.npz"
    path.write_bytes(product.encode(halfway))
    other = Training(TEAMS, 5, 4, HYPER)
    product.restore(other, path)
    assert same(trained(other, 1), trained(Training(TEAMS, 5, 4, HYPER), 2, threads=2))
    network = decode(encode(trained_network(halfway, "a")), "a.npz")
    assert network.matrices[0].shape[0] == TEAMS.encoding.size
    assert parse_task_file(str(network.recipe["task"])).critic == "team"


def test_a_task_file_names_it_and_says_nothing_without():
    text = text_of(file_of(TEAMS))
    assert with_file(TASK, parse_task_file(text)).team_critic
    assert "critic" not in text_of(file_of(TASK))
    assert not with_file(TASK, parse_task_file(text.replace('critic = "team"\n', ""))).team_critic
