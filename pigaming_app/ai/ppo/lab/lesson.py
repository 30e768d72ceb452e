"""The training of the Lab's network, step by step: updates, measured win rates, and its habits by direction."""

from concurrent.futures import Executor
from copy import deepcopy
from math import log
from time import monotonic
from typing import Any

import numpy as np

from pigaming_app.ai.networks.encoding import PERIOD, UNIT
from pigaming_app.ai.networks.pitanks import ENCODING, GUN, OTHERS, TURNS
from pigaming_app.ai.networks.policy import packed_layers
from pigaming_app.ai.ppo.lab.messages import UNTRAINED, Begin, Habit, Report, State, Weights
from pigaming_app.ai.ppo.lab.task import HYPER, MINUTES, RELOADED, RIVAL, STAND, TASK, NetworkRecipe, task_of
from pigaming_app.ai.ppo.training import Training, in_threads
from pigaming_app.ai.ppo.win_rates import win_rates
from pigaming_app.sim.world import HZ

LESSON = HYPER.decisions * PERIOD / HZ  # s of every match in an update
SECTORS = 16
ACTIONS = ("shoot", "turn_left", "turn_right", "ahead", "behind", "stay")
CHANCES = np.array([1 / 2, 3 / 7, 3 / 7, 1 / 3, 1 / 3, 1 / 21])  # of the actions in random play
CLEAR = 0.15  # excess over random play, relative to certainty, that counts as a preference
MEMORY = 300.0  # decisions of each direction that count
HELD = 20  # updates in which a network from a file is not changed, while its value function is learned
MATCHES = 20  # in a measurement
GRAIN, INTERVAL = 25, 0.5  # measurements over the length of the curve, about; s between two of them at least
MOST = sum(log(choices) for _, choices in ENCODING.heads)  # entropy of random play


class Lesson:
    """One training of the Lab's network."""

    def __init__(self, begin: Begin, threads: Executor) -> None:
        """Raises ImportError without numba."""
        self.number, self.threads = begin.number, threads
        self.training = Training(TASK, begin.seed, updates=2**31, hyper=HYPER)
        self.before = begin.state
        self.opened = self._restored(begin.state) if begin.state else None
        self.habits = Habits()
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
        training.task = task_of(recipe)
        training.update(self._gather, self.threads)
        self.entropy += 0.1 * (training.entropy - self.entropy)
        if self.opened and training.updates <= HELD:
            training.learner.policy = deepcopy(self.opened)

    def report(self, measured: bool = True) -> Report:
        """The state, with a measurement if one is due. `measured`: it may be."""
        before = self.before or UNTRAINED
        updates, decisions = before.updates + self.training.updates, before.decisions + self.training.decisions
        state = State(self._weights(), updates, decisions, self.matches)
        share = self._share() if measured and self._due() else None
        return Report(self.number, state, 1.0 - self.entropy / MOST, self.habits.summary(), share)

    def _due(self) -> bool:
        since = self.matches - self._measured
        return since >= max(1.0, self.matches / GRAIN) and monotonic() - self._measured_at >= INTERVAL

    def _share(self) -> float:
        self._measured = self.matches
        row = packed_layers(self.training.layers())
        wins, ties, _ = win_rates(TASK, row, MATCHES, self.threads)[RIVAL]
        self._measured_at = monotonic()
        return (wins + 0.5 * ties) / MATCHES

    def _gather(self, policy: Any, pool: Any, decisions: int) -> Any:
        experiences = self._play(policy, pool, decisions)
        for experience in experiences:
            inputs = experience.inputs[:-1][experience.valid]
            values = self.training.learner.value.forward(inputs)[0][0]
            self.habits.add(inputs, experience.choices[experience.valid], values)
        return experiences

    def _weights(self) -> Weights:
        layers = self.training.layers()
        return Weights(
            tuple(matrix.astype("<i2") for matrix in layers.matrices),
            tuple((bias / UNIT).astype("<i2") for bias in layers.biases),
        )

    def _restored(self, state: State) -> Any:
        """Take over a network; returns a copy of it."""
        policy = self.training.learner.policy
        for own, matrix, bias in zip(policy.weights, state.weights.matrices, state.weights.biases, strict=True):
            own[:-1], own[-1] = matrix / UNIT, bias / UNIT
        return deepcopy(policy)


class Habits:
    """What the network does, and the value it expects, by direction of the opponent. Old decisions fade."""

    def __init__(self) -> None:
        self.seen, self.values = np.zeros(SECTORS), np.zeros(SECTORS)
        self.ready, self.actions = np.zeros(SECTORS), np.zeros((SECTORS, len(ACTIONS)))

    def add(self, inputs: Any, choices: Any, values: Any) -> None:
        """Add decisions: inputs (n, inputs), choices (n, heads), values (n,)."""
        angles = np.arctan2(inputs[:, OTHERS + 5], inputs[:, OTHERS + 4])
        sectors = np.rint(angles * (SECTORS / (2.0 * np.pi))).astype(int) % SECTORS
        ready = inputs[:, GUN] < RELOADED
        drive, turn, fire = choices[:, 0], choices[:, 1], choices[:, 2]
        left, right = turn < len(TURNS) // 2, turn > len(TURNS) // 2
        stays = (drive == STAND) & ~left & ~right
        done = np.column_stack([ready & (fire == 1), left, right, drive > STAND, drive < STAND, stays])
        for sums, parts in ((self.seen, 1.0), (self.values, values), (self.ready, ready), (self.actions, done)):
            np.add.at(sums, sectors, parts)
        kept = np.minimum(1.0, MEMORY / np.maximum(self.seen, 1.0))
        for sums in (self.seen, self.values, self.ready, self.actions.T):
            sums *= kept

    def summary(self) -> tuple[Habit | None, ...]:
        """The habit of each direction."""
        result: list[Habit | None] = []
        values = self.values / np.maximum(self.seen, 1.0)
        usual = values[self.seen >= 1.0].mean() if (self.seen >= 1.0).any() else 0.0
        for sector in range(SECTORS):
            seen = self.seen[sector]
            if seen < 1.0:
                result.append(None)
                continue
            counts = np.array([max(self.ready[sector], 1.0), *[seen] * (len(ACTIONS) - 1)])
            excess = (self.actions[sector] / counts - CHANCES) / (1.0 - CHANCES)
            best = int(excess.argmax())
            action = ACTIONS[best] if excess[best] > CLEAR else "unknown"
            result.append(Habit(float(values[sector] - usual), action))
        return tuple(result)
