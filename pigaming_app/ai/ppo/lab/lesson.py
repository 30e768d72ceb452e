"""The training of the Lab's network, step by step: updates, measured win rates, and its habits by direction."""

from concurrent.futures import Executor
from dataclasses import replace
from math import log
from time import monotonic
from typing import Any

import numpy as np

from pigaming_app.ai.networks.encoding import PERIOD, UNIT
from pigaming_app.ai.networks.layers import Layers
from pigaming_app.ai.networks.pitanks import ENCODING, GUN, OTHERS, TURNS
from pigaming_app.ai.networks.pitanks_rewards import RELOADED, STAND
from pigaming_app.ai.networks.policy import packed_layers
from pigaming_app.ai.ppo.lab.messages import UNTRAINED, Begin, Habit, Report, State, Weights
from pigaming_app.ai.ppo.lab.task import HYPER, MINUTES, RIVAL, TASK, NetworkRecipe, reward_of
from pigaming_app.ai.ppo.learner import PolicyNetwork
from pigaming_app.ai.ppo.training import Origin, Training, in_threads
from pigaming_app.ai.ppo.win_rates import win_rates
from pigaming_app.sim.world import HZ

LESSON = HYPER.decisions * PERIOD / HZ  # s of every match in an update
SECTORS = 16
ACTIONS = ("shoot", "turn_left", "turn_right", "ahead", "behind", "stay")
CHANCES = np.array([1 / 2, 3 / 7, 3 / 7, 1 / 3, 1 / 3, 1 / 21])  # of the actions in random play
CLEAR = 0.15  # excess over random play, relative to certainty, that counts as a preference
KEPT = 32  # situations of each direction
MATCHES = 20  # in a measurement
GRAIN, INTERVAL = 25, 0.5  # measurements over the length of the curve, about; s between two of them at least
MOST = sum(log(choices) for _, choices in ENCODING.heads)  # entropy of random play


class LabTraining:
    """One training of the Lab's network."""

    def __init__(self, begin: Begin, threads: Executor) -> None:
        """Raises ImportError without numba."""
        self.number, self.threads = begin.number, threads
        start = begin.state and Origin("", Layers(*begin.state.weights))
        self.training = Training(TASK, begin.seed, updates=2**31, hyper=HYPER, start=start)
        self.task = self.training.task
        self.before = begin.state
        self.situations = Situations()
        self.entropy = MOST
        self._measured, self._measured_at = -1.0, 0.0
        self._play = in_threads(self.training, threads)

    @property
    def matches(self) -> float:
        """Matches played so far, their parts included."""
        played = self.training.updates * HYPER.matches * LESSON / (60.0 * MINUTES)
        return played + (self.before or UNTRAINED).matches

    def learn(self, recipe: NetworkRecipe) -> None:
        """One update."""
        training = self.training
        training.task = replace(self.task, reward=reward_of(recipe))
        training.update(self._gather, self.threads)
        self.entropy += 0.1 * (training.entropy - self.entropy)

    def report(self, measured: bool = True) -> Report:
        """The state, with a measurement if one is due. `measured`: it may be."""
        before = self.before or UNTRAINED
        updates, decisions = before.updates + self.training.updates, before.decisions + self.training.decisions
        state = State(self._weights(), updates, decisions, self.matches)
        share = self._share() if measured and self._due() else None
        learner = self.training.learner
        habits = self.situations.habits(learner.policy, learner.value)
        return Report(self.number, state, 1.0 - self.entropy / MOST, habits, share)

    def _due(self) -> bool:
        since = self.matches - self._measured
        return since >= max(1.0, self.matches / GRAIN) and monotonic() - self._measured_at >= INTERVAL

    def _share(self) -> float:
        self._measured = self.matches
        row = packed_layers(self.training.layers())
        score = win_rates(self.task, row, MATCHES, self.threads)[RIVAL]
        self._measured_at = monotonic()
        return score.share

    def _gather(self, policy: Any, pool: Any, decisions: int) -> Any:
        experiences = self._play(policy, pool, decisions)
        for experience in experiences:
            self.situations.add(experience.inputs[:-1][experience.valid])
        return experiences

    def _weights(self) -> Weights:
        layers = self.training.layers()
        return Weights(
            tuple(matrix.astype("<i2") for matrix in layers.matrices),
            tuple((bias / UNIT).astype("<i2") for bias in layers.biases),
        )


class Situations:
    """The latest situations of the training by direction of the opponent, and how the network sees them now."""

    def __init__(self) -> None:
        self.known = [np.zeros((0, ENCODING.size + 1), np.float32) for _ in range(SECTORS)]

    def add(self, inputs: np.ndarray) -> None:
        """Add situations (n, inputs + 1); the last input is 1."""
        angles = np.arctan2(inputs[:, OTHERS + 5], inputs[:, OTHERS + 4])
        sectors = np.rint(angles * (SECTORS / (2.0 * np.pi))).astype(int) % SECTORS
        for sector in np.unique(sectors):
            self.known[sector] = np.concatenate([self.known[sector], inputs[sectors == sector]])[-KEPT:]

    def habits(self, policy: PolicyNetwork, value: PolicyNetwork) -> tuple[Habit | None, ...]:
        """What the network does with the opponent in each direction, and what it expects from it."""
        inputs = np.concatenate(self.known)
        values, chances = value.forward(inputs)[0][0], probabilities(policy.forward(inputs)[0].T)
        usual = float(np.mean([values[rows].mean() for rows in self._rows() if rows.stop > rows.start] or [0.0]))
        return tuple(
            Habit(float(values[rows].mean()) - usual, action_of(chances[rows], inputs[rows]))
            if rows.stop > rows.start
            else None
            for rows in self._rows()
        )

    def _rows(self) -> list[slice]:
        ends = np.cumsum([len(known) for known in self.known]).tolist()
        return [slice(end - len(known), end) for end, known in zip(ends, self.known, strict=True)]


def probabilities(logits: np.ndarray) -> Any:
    """Probabilities of the choices of all heads (n, outputs), from their logits."""
    parts = np.split(logits, np.cumsum([choices for _, choices in ENCODING.heads])[:-1], axis=1)
    powers = [np.exp(part - part.max(axis=1, keepdims=True)) for part in parts]
    return np.hstack([power / power.sum(axis=1, keepdims=True) for power in powers])


def action_of(chances: np.ndarray, inputs: np.ndarray) -> str:
    """The action that exceeds random play most, from probabilities (n, outputs) in situations (n, inputs)."""
    drive, turn, fire = chances[:, :3], chances[:, 3:10], chances[:, 10:12]
    loaded = inputs[:, GUN] < RELOADED
    middle = len(TURNS) // 2
    means = [
        fire[loaded, 1].mean() if loaded.any() else CHANCES[0],
        turn[:, :middle].sum(axis=1).mean(),
        turn[:, middle + 1 :].sum(axis=1).mean(),
        drive[:, STAND + 1].mean(),
        drive[:, STAND - 1].mean(),
        (drive[:, STAND] * turn[:, middle]).mean(),
    ]
    excess = (np.array(means) - CHANCES) / (1.0 - CHANCES)
    best = int(excess.argmax())
    return ACTIONS[best] if excess[best] > CLEAR else "unknown"
