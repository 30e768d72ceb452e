"""A training by PPO: shards gather experience, the learner improves the network, and so on.

The result depends on the seed and the number of updates only, not on the threads or machines that play the shards.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from typing import Any

import numpy as np

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.ai.networks.layers import EXACT, Layers
from pigaming_app.ai.networks.policy import Policy, network_brain, packed_layers
from pigaming_app.ai.ppo.learner import STANDARD, Hyper, Learner, advantages
from pigaming_app.ai.ppo.shard import Experience, Shard
from pigaming_app.ai.ppo.task import LineUp, Task

SHARDS = 4
POOL, POOLED_EVERY = 40, 15  # earlier copies at most, and updates between two of them
LARGEST = 32767  # of a 16-bit weight
Gather = Callable[[Sequence[Any], Any, int], list[Experience]]  # policy, pool, decisions


class Training:
    """A network in training."""

    def __init__(self, task: Task, seed: int, updates: int, hyper: Hyper = STANDARD) -> None:
        """`updates`: of the whole training, over which hyper-parameters change. Raises ImportError without numba."""
        self.task, self.seed, self.planned, self.hyper = task, seed, updates, hyper
        sequence = np.random.SeedSequence(abs(seed))
        seeds = sequence.generate_state(SHARDS + 1, np.uint64).tolist()
        self.shards = [Shard(task, line_ups, seeds[k]) for k, line_ups in enumerate(_dealt(task, hyper.matches))]
        counts = [choices for _, choices in task.encoding.heads]
        self.learner = Learner(task.encoding.size, counts, hyper, np.random.default_rng(seeds[-1]))
        self.pool: Any = packed_layers(self.layers())
        self.updates, self.decisions, self.entropy = 0, 0, 0.0

    def update(self, gather: Gather, threads: Executor, share: float | None = None) -> None:
        """Gather experience and learn from it. `share`: of the training so far; None: by the planned updates."""
        share = min(1.0, self.updates / self.planned) if share is None else share
        experiences = gather(self.learner.policy.weights, self.pool, self.hyper.decisions)
        data = [self._digested(experience, share) for experience in experiences]
        joined = [np.concatenate(parts) for parts in zip(*data, strict=True)]
        self.entropy = self.learner.update(joined, share, threads)
        self.updates += 1
        self.decisions += len(joined[0])
        if self.updates % POOLED_EVERY == 0:
            self.pool = np.concatenate([self.pool, packed_layers(self.layers())])[-POOL:]

    def _digested(self, experience: Experience, share: float) -> tuple[Any, ...]:
        """Inputs, choices, log odds, advantages and returns of the valid decisions."""
        inputs, choices, log_odds, gauges, valid, over, results = experience
        gains = np.diff(gauges, axis=0)
        rewards = np.where(valid, self.task.reward(gains, inputs[:-1], choices, share), np.float32(0))
        last = np.maximum(valid.sum(0) - 1, 0)
        rewards[last, np.arange(len(last))] += np.where(over, results, np.float32(0))
        values = self.learner.value.forward(inputs.reshape(-1, inputs.shape[-1]))[:, 0].reshape(inputs.shape[:2])
        gained = advantages(rewards, values, valid, over, self.hyper.discount, self.hyper.trace)
        returns = gained + values[:-1]
        return inputs[:-1][valid], choices[valid], log_odds[valid], gained[valid], returns[valid]

    def layers(self) -> Layers:
        """The policy in whole numbers."""
        return whole_layers(self.learner.policy.weights)

    def brain(self, name: str = "network") -> BrainKind:
        """A brain that plays by the present policy."""
        return network_brain(name, self.task.encoding, Policy(self.layers()))

    def state(self) -> dict[str, Any]:
        """Everything that changes, for `restore`."""
        return {
            "policy": self.learner.policy.state(),
            "value": self.learner.value.state(),
            "random": self.learner.random.bit_generator.state,
            "shards": [shard.state() for shard in self.shards],
            "pool": self.pool,
            "updates": self.updates,
            "decisions": self.decisions,
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from the result of `state`, bit for bit."""
        self.learner.policy.restore(state["policy"])
        self.learner.value.restore(state["value"])
        self.learner.random.bit_generator.state = state["random"]
        for shard, one in zip(self.shards, state["shards"], strict=True):
            shard.restore(one)
        self.pool, self.updates, self.decisions = state["pool"], state["updates"], state["decisions"]


def in_threads(training: Training, threads: Executor) -> Gather:
    """Gather experience in the threads of this process."""

    def gather(policy: Sequence[Any], pool: Any, decisions: int) -> list[Experience]:
        return list(threads.map(lambda shard: shard.collect(policy, pool, decisions), training.shards))

    return gather


def whole_layers(weights: Sequence[Any]) -> Layers:
    """Matrices whose last rows are the biases, rounded to whole units. Raises ValueError if they are too large."""
    rounded = [np.clip(np.rint(matrix * UNIT), -LARGEST, LARGEST) for matrix in weights]
    layers = Layers([matrix[:-1] for matrix in rounded], [matrix[-1] for matrix in rounded])
    if layers.largest_sum() >= EXACT:
        raise ValueError("the weights are too large for exact sums")
    return layers


def _dealt(task: Task, matches: int) -> list[list[LineUp]]:
    """The line-ups of every shard: each in proportion to its share, dealt out evenly."""
    total = sum(line_up.share for line_up in task.line_ups)
    every = [line_up for line_up in task.line_ups for _ in range(round(matches * line_up.share / total))]
    return [every[k::SHARDS] for k in range(SHARDS)]
