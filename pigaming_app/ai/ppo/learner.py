"""Proximal policy optimisation (Schulman et al., arXiv:1707.06347, 2017) in NumPy, with generalised advantages
(arXiv:1506.02438). Policy and value function are separate networks with two hidden layers each.
"""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, fields, replace
from typing import Any, NamedTuple

import numpy as np

from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.ai.networks.layers import Layers
from pigaming_app.ai.networks.policy import HIDDEN

F = np.float32
SLOPE, SMOOTHNESS, TINY = F(0.1), F(0.001), F(1e-5)  # Adam: 1 - beta1, 1 - beta2, epsilon

Trail = list[tuple[Any, Any]]  # inputs of each layer, and its bends
LIMITS = {  # of hyper-parameters; the others are shares
    "matches": (1, 10_000),
    "decisions": (1, 1_000),
    "epochs": (1, 100),
    "minibatch": (1, 1_000_000),
    "steepest": (1e-6, 1e6),
    "held": (0, 10_000),
}


@dataclass(frozen=True)
class Hyper:
    """Hyper-parameters. Those that change in the course of a training are given for its begin and its end."""

    matches: int = 256
    decisions: int = 60  # of every stream between two updates
    epochs: int = 2
    minibatch: int = 2048
    rate: float = 1e-3
    last_rate: float = 1e-4
    entropy: float = 0.01
    last_entropy: float = 0.0015
    clip: float = 0.2
    discount: float = 0.99  # gamma
    trace: float = 0.95  # lambda
    steepest: float = 0.5  # limit of the gradient's norm
    held: int = 20  # updates in which a network that is continued stays as it is, while its value function is learned

    def __post_init__(self) -> None:
        for field in fields(self):
            low, high = LIMITS.get(field.name, (0.0, 1.0))
            if not low <= (value := getattr(self, field.name)) <= high:
                raise ValueError(f"{field.name} is {value:g}; possible are {low:g} to {high:g}")

    def rate_at(self, share: float) -> float:
        """The learning rate after a share of the training."""
        return self.rate + (self.last_rate - self.rate) * share

    def entropy_at(self, share: float) -> float:
        """The weight of the entropy after a share of the training."""
        return self.entropy + (self.last_entropy - self.entropy) * share

    @property
    def continued(self) -> "Hyper":
        """The same for a network that has been trained before: slower, and as certain as at the end."""
        return replace(self, rate=0.5 * self.rate, entropy=self.last_entropy)


STANDARD = Hyper()


class PolicyFigures(NamedTuple):
    """Means over some decisions."""

    entropy: float  # of the policy, nats
    kl: float  # divergence from the policy that made them: (r - 1) - log r for the ratio r of the probabilities
    clipped: float  # share of those whose ratio has left the limits


class LearnerFigures(NamedTuple):
    """An update of a learner. What changes in its course is a mean over the last epoch."""

    mean_return: float  # of the decisions, as the value function is to learn it
    kl: float  # see PolicyFigures
    clipped: float
    entropy: float
    value_loss: float  # half the mean squared error
    explained: float  # share of the variance of the returns that the value function knew before; NaN without any


class PolicyNetwork:
    """A network with two hidden layers, Padé's tanh, and Adam (arXiv:1412.6980).

    `weights`: three float32 matrices (inputs + 1, units); the last row holds the biases.
    """

    def __init__(
        self, inputs: int, outputs: int, gain: float, random: np.random.Generator, units: int = HIDDEN
    ) -> None:
        """Orthogonal weights; `units`: of each hidden layer; `gain`: of the last layer."""
        sizes = ((inputs, units, 1.4), (units, units, 1.4), (units, outputs, gain))
        self.weights = [_orthogonal(*size, random) for size in sizes]
        self.means = [np.zeros_like(matrix) for matrix in self.weights]
        self.squares = [np.zeros_like(matrix) for matrix in self.weights]
        self.steps = 0

    def forward(self, x: np.ndarray) -> tuple[Any, Trail]:
        """The outputs (outputs, n) for inputs (n, inputs + 1), whose last column is 1; and a trail for `gradient`.

        Activations lie in rows (units + 1, n), whose last is 1 for the biases.
        """
        trail: Trail = []
        x = x.T
        for matrix in self.weights[:-1]:
            y = np.empty((matrix.shape[1] + 1, x.shape[1]), x.dtype)
            y[-1] = 1
            z = np.matmul(matrix.T, x, out=y[:-1])
            np.clip(z, F(-3), F(3), out=z)
            bend = z * z  # tanh z = z (27 + z^2) / (27 + 9 z^2) = z (1/9 + 8/3 / (3 + z^2))
            bend += F(3)
            np.divide(F(8 / 3), bend, out=bend)
            bend += F(1 / 9)
            z *= bend
            trail.append((x, bend))
            x = y
        return self.weights[-1].T @ x, [*trail, (x, None)]

    def gradient(self, slopes: np.ndarray, trail: Trail) -> list[Any]:
        """The gradient of a loss by the weights, from its derivative by the outputs; overwrites both arguments."""
        gradients: list[Any] = []
        for matrix, (x, bend) in zip(reversed(self.weights), reversed(trail), strict=True):
            if bend is not None:
                bend *= F(-1.5)  # the derivative of tanh is ((1 - 3 bend) / 2)^2, and 0 where z is clipped
                bend += F(0.5)
                bend *= bend
                slopes *= bend
            gradients.append(x @ slopes.T)
            if len(gradients) < len(self.weights):
                slopes = matrix[:-1] @ slopes
        return gradients[::-1]

    def descend(self, gradients: Sequence[Any], rate: float, steepest: float) -> None:
        """One step of Adam."""
        norm = float(np.sqrt(sum(float((gradient * gradient).sum()) for gradient in gradients)))
        scale = F(min(1.0, steepest / (norm + 1e-8)))
        self.steps += 1
        step = F(rate * np.sqrt(1.0 - 0.999**self.steps) / (1.0 - 0.9**self.steps))
        for matrix, gradient, mean, square in zip(self.weights, gradients, self.means, self.squares, strict=True):
            gradient *= scale
            mean += SLOPE * (gradient - mean)
            square += SMOOTHNESS * (gradient * gradient - square)
            matrix -= step * mean / (np.sqrt(square) + TINY)

    def take_over(self, layers: Layers) -> None:
        """Go on from a trained network, which may be smaller: the outputs are the same, bit for bit.

        Units that it lacks keep their incoming weights from all units, and have none to its own units or the outputs.
        """
        old = layers.units
        new = [matrix.copy() for matrix in self.weights]
        new[1][old:-1, :old] = new[2][old:-1] = 0
        for own, matrix, bias in zip(new, layers.matrices, layers.biases, strict=True):
            own[: len(matrix), : len(bias)], own[-1, : len(bias)] = matrix / UNIT, bias / UNIT**2
        self.restart(new)

    def restart(self, weights: Sequence[Any]) -> None:
        """Go on from other weights, as if they were the first."""
        self.steps = 0
        for own, other, *moments in zip(self.weights, weights, self.means, self.squares, strict=True):
            own[:] = other
            for moment in moments:
                moment.fill(0)

    @property
    def arrays(self) -> list[Any]:
        """All that changes but `steps`: weights and moments."""
        return [*self.weights, *self.means, *self.squares]


def _orthogonal(inputs: int, outputs: int, gain: float, random: np.random.Generator) -> Any:
    square = np.linalg.qr(random.normal(size=(max(inputs, outputs), min(inputs, outputs))))[0]
    matrix = gain * (square if inputs >= outputs else square.T)
    return np.vstack([matrix, np.zeros((1, outputs))]).astype(F)


def advantages(
    rewards: np.ndarray, values: np.ndarray, valid: np.ndarray, over: np.ndarray, discount: float, trace: float
) -> Any:
    """Generalised advantages (T, S) of `rewards` (T, S); `values` (T + 1, S).

    A match that is `over` (S,) has no value after its last valid decision.
    """
    decisions = len(rewards)
    result, ahead = np.zeros_like(rewards), np.zeros_like(rewards[0])
    last = valid.sum(0) - 1
    for t in range(decisions - 1, -1, -1):
        goes_on = np.where(over & (last == t), F(0), F(1))
        surprise = rewards[t] + F(discount) * goes_on * values[t + 1] - values[t]
        ahead = np.where(valid[t], surprise + F(discount * trace) * goes_on * ahead, F(0))
        result[t] = ahead
    return result


def policy_slopes(
    logits: np.ndarray,
    counts: Sequence[int],
    choices: np.ndarray,
    before: np.ndarray,
    gains: np.ndarray,
    clip: float,
    entropy: float,
) -> tuple[Any, PolicyFigures]:
    """Derivative of the clipped objective less the entropy's share by the logits (outputs, n), and its figures.

    `choices`: (heads, n); `before`: (n,) log odds of the choices when they were made; `gains`: (n,) advantages.
    """
    n = logits.shape[1]
    columns, heads = np.arange(n), []
    odds, logs = np.empty_like(logits), np.empty_like(logits)
    for first, count in zip(np.cumsum([0, *counts]), counts, strict=False):
        head = slice(first, first + count)
        heads.append(head)
        np.subtract(logits[head], logits[head].max(0), out=logs[head])
        np.exp(logs[head], out=odds[head])
        sums = odds[head].sum(0)
        odds[head] /= sums
        logs[head] -= np.log(sums)
    rows = [head.start + choice for head, choice in zip(heads, choices, strict=True)]
    change = sum(logs[row, columns] for row in rows) - before
    ratio = np.exp(change)
    clipped = ((gains > 0) & (ratio > 1 + clip)) | ((gains < 0) & (ratio < 1 - clip))
    pull = np.where(clipped, F(0), gains * ratio / F(n))
    slopes, mean = pull * odds, 0.0
    for row, head in zip(rows, heads, strict=True):
        slopes[row, columns] -= pull
        part = odds[head] * logs[head]
        disorder = -part.sum(0)
        mean += float(disorder.mean())
        part += odds[head] * disorder
        part *= F(entropy / n)
        slopes[head] += part
    kl, left = (ratio - F(1) - change).mean(), (np.abs(ratio - F(1)) > clip).mean()
    return slopes, PolicyFigures(mean, float(kl), float(left))


class Learner:
    """Policy and value function, and their updates."""

    def __init__(
        self,
        inputs: int,
        counts: Sequence[int],
        hyper: Hyper,
        random: np.random.Generator,
        units: int = HIDDEN,
        views: int | None = None,
    ) -> None:
        """`views`: inputs of the value function, if it has others than the policy."""
        self.counts, self.hyper, self.random = tuple(counts), hyper, random
        self.policy = PolicyNetwork(inputs, sum(counts), 0.01, random, units)
        self.value = PolicyNetwork(views or inputs, 1, 1.0, random, units)

    def update(self, data: Sequence[Any], share: float, threads: Executor, held: bool = False) -> LearnerFigures:
        """Improve both networks on a set of decisions, or the value function alone, while the policy is `held`.

        `data`: inputs (n, inputs + 1), choices (n, heads), log odds (n,), advantages (n,), returns (n,); then, if the
        value function has its own, its inputs (n, views + 1).
        """
        orders = [self.random.permutation(len(data[0])) for _ in range(self.hyper.epochs)]
        data, views = data[:5], data[-1] if len(data) > 5 else data[0]
        estimating = threads.submit(self._estimate, views, data[4], orders, share)
        figures = self._improve(data, orders, share, held)
        _, _, _, gains, returns = data
        spread = float(returns.var(dtype=float))
        explained = 1.0 - float(gains.var(dtype=float)) / spread if spread else float("nan")
        mean_return, loss = float(returns.mean(dtype=float)), estimating.result()
        return LearnerFigures(mean_return, figures.kl, figures.clipped, figures.entropy, loss, explained)

    def _improve(self, data: Sequence[Any], orders: list[Any], share: float, held: bool) -> PolicyFigures:
        """Improve the policy unless it is held; returns the figures of the last epoch."""
        inputs, choices, before, gains, _ = data
        hyper, found, sizes = self.hyper, list[PolicyFigures](), list[int]()
        for order in orders:
            found, sizes = [], []
            for first in range(0, len(order), hyper.minibatch):
                rows = order[first : first + hyper.minibatch]
                gain = gains[rows]
                gain = (gain - gain.mean()) / (gain.std() + F(1e-8))
                logits, trail = self.policy.forward(inputs[rows])
                slopes, figures = policy_slopes(
                    logits,
                    self.counts,
                    choices[rows].T,
                    before[rows],
                    gain,
                    hyper.clip,
                    hyper.entropy_at(share),
                )
                found.append(figures)
                sizes.append(len(rows))
                if not held:
                    self.policy.descend(self.policy.gradient(slopes, trail), hyper.rate_at(share), hyper.steepest)
        return PolicyFigures(*np.average(found, axis=0, weights=sizes).tolist())

    def _estimate(self, inputs: np.ndarray, returns: np.ndarray, orders: list[Any], share: float) -> float:
        """Improve the value function; returns its loss in the last epoch."""
        squares = 0.0
        for order in orders:
            squares = 0.0
            for first in range(0, len(order), self.hyper.minibatch):
                rows = order[first : first + self.hyper.minibatch]
                errors, trail = self.value.forward(inputs[rows])
                errors -= returns[rows]
                squares += float(np.vdot(errors, errors))
                errors /= F(len(rows))
                self.value.descend(self.value.gradient(errors, trail), self.hyper.rate_at(share), self.hyper.steepest)
        return 0.5 * squares / len(returns)
