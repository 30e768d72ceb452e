"""The learner's network in single precision, in compiled code: layers, squashing, and draws of choices."""

from collections.abc import Callable
from math import exp, log

import numpy as np

from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.rng import Rng, uniform


def make_bend(units: int) -> Callable[[np.ndarray], None]:
    """A kernel for Padé's tanh in single precision."""

    def bend(values: np.ndarray) -> None:
        for i in range(units):
            y = min(max(values[i] * np.float32(1.0 / 3.0), np.float32(-1.0)), np.float32(1.0))
            square = y * y
            values[i] = y * (square + np.float32(3.0)) / (np.float32(3.0) * square + np.float32(1.0))

    return kernel(bend)


def make_layer(inputs: int, units: int) -> Callable[[np.ndarray, np.ndarray, np.ndarray], None]:
    """A kernel for out = x @ matrix[:-1] + matrix[-1]. Six times as fast as one that serves all sizes."""

    def layer(x: np.ndarray, matrix: np.ndarray, out: np.ndarray) -> None:
        for unit in range(units):
            out[unit] = matrix[inputs, unit]
        for i in range(inputs):
            value = x[i]
            if value != 0.0:
                for unit in range(units):
                    out[unit] += value * matrix[i, unit]

    return kernel(layer)


@kernel
def sample(logits: np.ndarray, first: int, count: int, mind: Rng) -> tuple[int, float]:
    """A choice of one head and the logarithm of its probability."""
    best = logits[first]
    for i in range(1, count):
        if logits[first + i] > best:
            best = logits[first + i]
    total = 0.0
    for i in range(count):
        total += exp(logits[first + i] - best)
    left, choice = uniform(mind) * total, count - 1
    for i in range(count):
        left -= exp(logits[first + i] - best)
        if left < 0.0:
            choice = i
            break
    return choice, logits[first + choice] - best - log(total)
