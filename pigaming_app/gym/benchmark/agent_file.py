"""An agent of another library as a file: a network of two hidden layers with tanh, in whole numbers."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.ai.networks.files import TrainedNetwork, encode
from pigaming_app.storage.safe_files import write_atomic

LARGEST = 32767  # of a 16-bit weight, in units of 1/256


def save_agent(
    path: Path, game: str, layers: Sequence[tuple[Any, Any]], learner: str, seed: int, decisions: int
) -> None:
    """Write a network. Raises NetworkError, NotSaved.

    `layers`: the three matrices (inputs, n), (n, n), (n, choices) with their biases, as floats; n is 8, 16, … 128. Its
    inputs are an environment's observation, its outputs are logits, the heads one after the other. They are rounded to
    1/256. `decisions`: of the training.
    """
    whole = [
        [np.clip(np.rint(UNIT * np.asarray(part)), -LARGEST, LARGEST).astype("<i2") for part in layer]
        for layer in layers
    ]
    matrices, biases = zip(*whole, strict=True)
    network = TrainedNetwork(path.stem, game, matrices, biases, {"learner": learner}, seed, 0, decisions)
    write_atomic(path, encode(network))
