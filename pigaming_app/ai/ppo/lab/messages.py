"""Messages between the arcade and the process in which the Lab's network learns."""

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from pigaming_app.ai.networks.pitanks import ENCODING
from pigaming_app.ai.networks.policy import HIDDEN
from pigaming_app.ai.ppo.lab.task import NetworkRecipe


class Weights(NamedTuple):
    """A network as in its file: int16 matrices (inputs, units) and biases (units,) in units of 1/256."""

    matrices: tuple[Any, ...]
    biases: tuple[Any, ...]


class State(NamedTuple):
    """A network and what it has gone through."""

    weights: Weights
    updates: int = 0
    decisions: int = 0
    matches: float = 0.0


def _untrained() -> State:
    sizes = (ENCODING.size, HIDDEN, HIDDEN, ENCODING.outputs)
    matrices = tuple(np.zeros(shape, "<i2") for shape in pairwise(sizes))
    return State(Weights(matrices, tuple(np.zeros(size, "<i2") for size in sizes[1:])))


UNTRAINED = _untrained()  # acts at random


class Begin(NamedTuple):
    """Begin another training."""

    number: int  # of the training, repeated in its reports
    seed: int
    state: State | None = None  # to continue from; None: a fresh network


class TrainingOrder(NamedTuple):
    """How to train, until the next order; void after `PATIENCE`."""

    recipe: NetworkRecipe = NetworkRecipe()
    pace: float = 0.0  # times real time; 0: pause


class Habit(NamedTuple):
    """The usual behaviour with the opponent in one direction."""

    value: float  # expected reward, less its mean over all directions
    action: str  # key of a sign


class Report(NamedTuple):
    """The state of a training."""

    number: int
    state: State
    knowing: float  # 0: every choice equally likely, 1: each of them certain
    habits: tuple[Habit | None, ...]  # by sixteenths of a turn, clockwise from ahead; None: never seen
    share: float | None = None  # of matches won against the hand-made robot, ties counting half; None: not measured now


PATIENCE = 2.0  # s after which an order is void, so that a page that has failed does not train on
