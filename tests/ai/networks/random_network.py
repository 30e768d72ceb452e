"""Networks with random weights, for tests that do not need good ones."""

from itertools import pairwise

import numpy as np

from pigaming_app.ai.networks.files import TrainedNetwork, TrainingCurve, Values
from pigaming_app.ai.networks.policy import HIDDEN
from pigaming_app.ai.networks.registry import ENCODINGS

RECIPE: dict[str, Values] = {"rate": 1e-3, "opponents": ["hand1", "hand2"], "anneal": True, "rules": "pickups"}
CURVE = TrainingCurve(("updates", "wins"), ((1.0, 0.5), (2.0, 0.75)))


def random_network(seed=1, game="pitanks", name="mine", units=HIDDEN, recipe=RECIPE, **more):
    """A network whose hidden units are neither dead nor saturated."""
    rng, encoding = np.random.default_rng(seed), ENCODINGS[game]
    sizes = encoding.size, units, units, encoding.outputs
    matrices = [(rng.normal(size=(n, m)) * 300 / np.sqrt(n)).round().astype("<i2") for n, m in pairwise(sizes)]
    biases = [(rng.normal(size=m) * 20).round().astype("<i2") for m in sizes[1:]]
    return TrainedNetwork(name, game, matrices, biases, recipe, seed, 20, 1000, CURVE, **more)
