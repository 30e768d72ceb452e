"""The learner: gradients against finite differences, advantages by hand, and a game that it must solve."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from pigaming_app.ai.ppo.learner import Hyper, Learner, PolicyNetwork, advantages, policy_slopes

RANDOM = np.random.default_rng(1)


def numeric(function, array, index, step):
    """Slope of `function()` by one element of an array that it uses."""
    kept, ends = array[index], []
    for side in (1, -1):
        array[index] = kept + side * step
        ends.append(function())
    array[index] = kept
    return (ends[0] - ends[1]) / (2 * step)


def test_the_gradient_is_that_of_finite_differences():
    network = PolicyNetwork(7, 3, 1.0, RANDOM)
    network.weights = [matrix.astype(float) for matrix in network.weights]
    network.weights[0] *= 3.0  # some units saturate
    x, slopes = np.ones((20, 8)), RANDOM.normal(size=(3, 20))
    x[:, :7] = RANDOM.normal(size=(20, 7))
    gradients = network.gradient(slopes.copy(), network.forward(x)[1])
    for matrix, gradient in zip(network.weights, gradients, strict=True):
        for _ in range(12):
            index = tuple(RANDOM.integers(matrix.shape))
            expected = numeric(lambda: float((network.forward(x)[0] * slopes).sum()), matrix, index, 1e-6)
            assert gradient[index] == pytest.approx(expected, rel=1e-4, abs=1e-6)


def test_the_slopes_of_the_policy_are_those_of_the_clipped_objective():
    counts, n, clip, entropy = (3, 2), 40, 0.2, 0.05
    logits = RANDOM.normal(size=(5, n))
    choices = np.stack([RANDOM.integers(count, size=n) for count in counts])
    gains = RANDOM.normal(size=n)

    def logs():
        return [part - np.log(np.exp(part).sum(0)) for part in np.split(logits, [3])]

    def odds():
        return sum(log[choices[head], np.arange(n)] for head, log in enumerate(logs()))

    before = odds() + RANDOM.normal(size=n) * 0.3

    def loss():
        ratio = np.exp(odds() - before)
        objective = np.minimum(ratio * gains, np.clip(ratio, 1 - clip, 1 + clip) * gains).mean()
        return -objective - entropy * -sum((np.exp(log) * log).sum(0).mean() for log in logs())

    slopes, figures = policy_slopes(logits, counts, choices, before, gains, clip, entropy)
    assert figures.entropy == pytest.approx(-sum((np.exp(log) * log).sum(0).mean() for log in logs()), rel=1e-5)
    for _ in range(30):
        index = tuple(RANDOM.integers(logits.shape))
        assert slopes[index] == pytest.approx(numeric(loss, logits, index, 1e-6), rel=1e-3, abs=1e-6)


def test_advantages_stop_at_the_end_of_a_match_and_look_ahead_elsewhere():
    rewards = np.array([[1, 1], [2, 2], [4, 0]], np.float32)
    values = np.array([[10, 10], [20, 20], [30, 30], [40, 40]], np.float32)
    valid = np.array([[True, True], [True, True], [True, False]])
    found = advantages(rewards, values, valid, np.array([False, True]), discount=0.5, trace=0.5)
    last = 4 + 0.5 * 40 - 30
    middle = 2 + 0.5 * 30 - 20 + 0.25 * last
    first = 1 + 0.5 * 20 - 10 + 0.25 * middle
    ended = 2 - 20
    assert found.tolist() == [[first, 1 + 0.5 * 20 - 10 + 0.25 * ended], [middle, ended], [last, 0]]


def exact(weights, inputs):
    """The outputs (n, units) in double precision; tanh by Padé."""
    x = inputs.astype(float)
    for k, matrix in enumerate(weights):
        x = x @ matrix.astype(float)
        if k < 2:
            x = x.clip(-3, 3)
            x = np.hstack([x * (27 + x * x) / (27 + 9 * x * x), np.ones((len(x), 1))])
    return x


def test_telemetry_is_that_of_the_definitions_in_double_precision():
    """Of the second of two epochs, from the weights that a learner of the same seed has then; batches by their size."""
    random, n = np.random.default_rng(7), 300
    inputs = np.ones((n, 6), np.float32)
    inputs[:, :5] = random.normal(size=(n, 5))
    choices = np.stack([random.integers(count, size=n) for count in (3, 2)], axis=1)
    returns, gains = (random.normal(size=n).astype(np.float32) for _ in range(2))
    before = (np.log(1 / 6) + 0.3 * random.normal(size=n)).astype(np.float32)
    data = [inputs, choices, before, gains, returns]
    with ThreadPoolExecutor(1) as threads:

        def learned(epochs, minibatch=n, held=False):
            hyper = Hyper(epochs=epochs, minibatch=minibatch, rate=0.02, last_rate=0.02)
            learner = Learner(5, (3, 2), hyper, np.random.default_rng(2))
            learner.policy.weights[2] *= 50.0  # far from even choices
            return learner, learner.update(data, 0.0, threads, held)

        first, _ = learned(1)
        _, found = learned(2)
        (_, whole), (_, parted) = learned(1, held=True), learned(1, 200, held=True)
    logs = [
        part - np.log(np.exp(part).sum(1, keepdims=True))
        for part in np.split(exact(first.policy.weights, inputs), [3], 1)
    ]
    ratio = np.exp(sum(log[np.arange(n), choices[:, k]] for k, log in enumerate(logs)) - before)
    assert found.kl == pytest.approx((ratio - 1 - np.log(ratio)).mean(), rel=1e-4)
    assert found.kl > 0.01
    assert found.clipped == ((ratio < 0.8) | (ratio > 1.2)).mean()
    assert found.entropy == pytest.approx(-sum((np.exp(log) * log).sum(1).mean() for log in logs), rel=1e-5)
    errors = exact(first.value.weights, inputs)[:, 0] - returns
    assert found.value_loss == pytest.approx((errors**2).mean() / 2, rel=1e-4)
    known = returns.astype(float) - gains
    assert found.explained == pytest.approx(1 - (returns - known).var() / returns.astype(float).var(), rel=1e-6)
    assert found.mean_return == pytest.approx(returns.astype(float).mean(), rel=1e-6)
    assert parted[:4] == pytest.approx(whole[:4], rel=1e-5)
    assert whole.kl != pytest.approx(found.kl, rel=0.01)


def test_it_learns_to_do_as_it_is_told():
    """Each of two heads is rewarded for the choice that the inputs name."""
    counts, hyper = (3, 2), Hyper(epochs=2, minibatch=256, rate=5e-3, last_rate=5e-3, entropy=0.0, last_entropy=0.0)
    learner, rows = Learner(5, counts, hyper, np.random.default_rng(2)), np.arange(1024)
    right = 0.0
    with ThreadPoolExecutor(1) as threads:
        for _ in range(40):
            wanted = np.stack([RANDOM.integers(count, size=1024) for count in counts], axis=1)
            inputs = np.zeros((1024, 6), np.float32)
            inputs[:, 5] = 1.0
            inputs[rows, wanted[:, 0]] = inputs[rows, 3 + wanted[:, 1]] = 1.0
            logits, choices, odds = learner.policy.forward(inputs)[0], [], np.zeros(1024, np.float32)
            for part in np.split(logits, [3]):
                log = part - np.log(np.exp(part).sum(0))
                choices.append((np.exp(log).cumsum(0) < RANDOM.random(1024)).sum(0).clip(0, len(part) - 1))
                odds += log[choices[-1], rows]
            chosen = np.stack(choices, axis=1)
            gains = (chosen == wanted).mean(1).astype(np.float32)
            right = float(gains.mean())
            values = learner.value.forward(inputs)[0][0]
            learner.update([inputs, chosen, odds, gains - values, gains], 0.0, threads)
    assert right > 0.97
