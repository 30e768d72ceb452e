"""The parameters of a network as NumPy matrices, and its forward pass in NumPy."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from pigaming_app.ai.networks.encoding import UNIT

LOGIT = 1.0 / (UNIT * UNIT)  # 1 in sums
EXACT = 2.0**24  # up to here single-precision floats hold every whole number


class Layers:
    """Two hidden layers and an output layer of whole numbers in units of 1/UNIT.

    `matrices`: (inputs, units) each; `biases`: (units,) each.
    """

    def __init__(self, matrices: Sequence[Any], biases: Sequence[Any]) -> None:
        self.matrices = [np.asarray(matrix, float) for matrix in matrices]
        self.biases = [np.asarray(bias, float) * UNIT for bias in biases]

    @property
    def units(self) -> int:
        """Units of each hidden layer."""
        return int(self.matrices[0].shape[1])

    def logits(self, inputs: Sequence[float]) -> list[float]:
        """The outputs, as sums: in units of LOGIT."""
        logits: list[float] = self._sums(inputs).tolist()
        return logits

    def logits_of(self, rows: Sequence[Sequence[float]]) -> list[list[float]]:
        """The outputs for several rows of inputs at once."""
        logits: list[list[float]] = self._sums(rows).tolist()
        return logits

    def _sums(self, inputs: Sequence[Any]) -> Any:
        (first, second, last), (first_bias, second_bias, last_bias) = self.matrices, self.biases
        x = np.array(inputs) @ first
        x += first_bias
        x = squash_all(x) @ second
        x += second_bias
        x = squash_all(x) @ last
        x += last_bias
        return x

    def largest_sum(self) -> float:
        """The largest number that any sum, also a part of one, can reach; must be below EXACT."""
        sums = zip(self.matrices, self.biases, strict=True)
        return max(float((UNIT * np.abs(matrix).sum(axis=0) + np.abs(bias)).max()) for matrix, bias in sums)


def squash_all(x: np.ndarray) -> Any:
    """`policy.squash` of an array, in place: the same operations in the same order."""
    x *= LOGIT / 3.0
    np.minimum(x, 1.0, out=x)
    np.maximum(x, -1.0, out=x)
    square = x * x
    above = square + 3.0
    above *= x
    square *= 3.0 / UNIT
    square += 1.0 / UNIT
    above /= square
    above += 0.5
    return np.floor(above, out=above)
