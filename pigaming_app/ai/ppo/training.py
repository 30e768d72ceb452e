"""A training by PPO: shards gather experience, the learner improves the network, and so on.

With a planned number of updates the result depends on the seed only, not on the threads or machines that play the
shards. With a planned time it also depends on the speed of the machine.
"""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from pigaming_app.ai.brain.archive import BrainFileError, read
from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.brain_files import bare_name, stem_of
from pigaming_app.ai.learning.team_critic import team_views
from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.ai.networks.files import MAX_BYTES, decode
from pigaming_app.ai.networks.layers import EXACT, Layers
from pigaming_app.ai.networks.policy import Policy, network_brain, packed_layers
from pigaming_app.ai.ppo.learner import LIMITS, Hyper, Learner, LearnerFigures, PolicyNetwork, advantages
from pigaming_app.ai.ppo.population import SELF_EVERY, Pool, Population, restored
from pigaming_app.ai.ppo.shard import LEARNING, PLAYED, Experience, Shard, ShardState
from pigaming_app.ai.ppo.task import LEARNER, SHARDS, LineUp, Task
from pigaming_app.ai.ppo.task_file import TrainingHistory, history_of
from pigaming_app.ai.ppo.win_rates import DuelScore, win_rates
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.setup import ChoiceError

POOL = 40  # earlier copies of a learner at most
POOLED_EVERY = (15, 60)  # updates between two copies, by learner: the exploiter's finds must not be forgotten
LARGEST = 32767  # of a 16-bit weight
NUMBERS = ("updates", "decisions", "entropy", "seconds")  # counted by a training
Gather = Callable[[Sequence[Any], Pool, int], list[Experience]]  # policies, pool, decisions


class Diverged(ValueError):
    """The weights have grown beyond what a network can hold; the message is one line."""


class Origin(NamedTuple):
    """A trained network, to continue."""

    name: str
    layers: Layers
    history: TrainingHistory = TrainingHistory()


def start_of(game: str, name: str) -> Origin:
    """The network of a brain's name, or of the path of a file. Raises ChoiceError."""
    kind = find_brain(game, name)
    layers, file = kind.weights(False)[0], kind.file
    if not isinstance(layers, Layers):
        raise ChoiceError(f"{stem_of(name)} is not a network, which has weights to start from")
    try:
        history = history_of(decode(read(file, MAX_BYTES), file.name), file.parent) if file else TrainingHistory()
    except BrainFileError as error:
        raise ChoiceError(str(error)) from None
    return Origin(stem_of(name), layers, history)


class Training:
    """A network in training."""

    def __init__(
        self,
        task: Task,
        seed: int,
        updates: int,
        hyper: Hyper | None = None,
        minutes: float | None = None,
        start: Origin | None = None,
    ) -> None:
        """`updates`: of the whole training, unless its time, `minutes`, is planned.

        `hyper`: None for the task's, `continued` with a start. `start`: what it continues, with the rewards of the end
        of a training, and with more units if the task has more; None for a fresh network.
        Raises ImportError without numba, ValueError for too few matches.
        """
        if start and start.layers.units > task.units:
            task = replace(task, units=start.layers.units)
        self.filed = hyper or task.hyper  # the hyper-parameters as a task file has them
        hyper = hyper or (task.hyper.continued if start else task.hyper)
        self.task, self.seed, self.planned, self.minutes, self.hyper = task, seed, updates, minutes, hyper
        seeds = np.random.SeedSequence(abs(seed)).generate_state(SHARDS + 1, np.uint64).tolist()
        self.shards = [Shard(task, line_ups, seeds[k]) for k, line_ups in enumerate(dealt(task, hyper.matches))]
        counts = [choices for _, choices in task.encoding.heads]
        random = np.random.default_rng(seeds[-1])
        size = task.encoding.size
        views = 2 * size + 1 if task.team_critic else size
        self.learners = [Learner(size, counts, hyper, random, task.units, views) for _ in task.learners]
        self.start = start
        if start:
            self.learner.policy.take_over(start.layers)
        self.population = Population() if task.population else None
        if self.population:
            self._renew_exploiter()
        self.pools = [packed_layers(whole_layers(learner.policy.weights)) for learner in self.learners]
        if self.population:
            del self.pools[1:]
        self.updates, self.decisions, self.seconds = 0, 0, 0.0
        self.telemetry = dict[int, LearnerFigures]()  # of the last update, by learner
        self.entropy = float(np.log(counts).sum())  # of an even choice
        self.points: list[tuple[float, ...]] = []  # progress, by `columns`

    def _renew_exploiter(self) -> None:
        """Start an exploiter from the present weights. It keeps what the last one expected of the same matches."""
        self.learners[1].policy.restart(self.learner.policy.weights)

    @property
    def finished(self) -> bool:
        """True at the end of the plan."""
        return self.share >= 1.0

    @property
    def decisions_of_update(self) -> int:
        """Decisions of the network in one update; less where matches end."""
        return self.hyper.decisions * sum(int((shard.minds["family"] == LEARNING).sum()) for shard in self.shards)

    @property
    def share(self) -> float:
        """The part of the training that is done. Hyper-parameters change with it."""
        return self.updates / self.planned if self.minutes is None else self.seconds / (60.0 * self.minutes)

    @property
    def learner(self) -> Learner:
        """The learner whose network the training is for."""
        return self.learners[0]

    def update(self, gather: Gather, threads: Executor) -> None:
        """Gather experience and learn from it."""
        began, share = perf_counter(), min(1.0, self.share)
        policies = [np.stack(layer) for layer in zip(*(one.policy.weights for one in self.learners), strict=True)]
        chances = self.population.chances if self.population else None
        experiences = gather(policies, Pool(np.concatenate(self.pools), chances), self.hyper.decisions)
        for player in range(len(self.learners) - 1, -1, -1):
            self._learn(player, experiences, share, threads)
        self.entropy = self.telemetry[0].entropy
        self.updates += 1
        if self.population:
            self._renew(self.population, experiences)
        else:
            self._pool()
        self.seconds += perf_counter() - began

    def _renew(self, population: Population, experiences: Sequence[Experience]) -> None:
        """Note how matches ended, let copies join the population, and replace an exploiter that is done."""
        for experience in experiences:
            population.note(experience.outcomes.tolist())
        if self.updates % SELF_EVERY == 0:
            self._join(population, 0)
        if population.exploiter_is_done(self.updates):
            self._join(population, 1)
            population.next_exploiter(self.updates)
            self._renew_exploiter()

    def _join(self, population: Population, learner: int) -> None:
        """Let a copy of a learner join the population."""
        copy = packed_layers(whole_layers(self.learners[learner].policy.weights))
        place = population.place_of(learner, self.updates, POOL)
        (members,) = self.pools
        self.pools = [np.concatenate([members[:place], copy, members[place + 1 :]])]

    def _pool(self) -> None:
        """Add copies of the learners to their pools, now and then."""
        for k, (learner, every) in enumerate(zip(self.learners, POOLED_EVERY, strict=False)):
            if self.updates % every == 0:
                copy = packed_layers(whole_layers(learner.policy.weights))
                self.pools[k] = np.concatenate([self.pools[k], copy])[-POOL:]

    def _learn(self, player: int, experiences: Sequence[Experience], share: float, threads: Executor) -> None:
        """Improve one of the learners."""
        data = threads.map(lambda experience: self._digested(player, experience, share), experiences)
        joined = [np.concatenate(parts) for parts in zip(*data, strict=True)]
        held = self.start is not None and self.updates < self.hyper.held and (player == 0 or self.task.population)
        if player and self.population:
            share = 0.0  # each exploiter is at its begin
        self.telemetry[player] = self.learners[player].update(joined, share, threads, held)
        self.decisions += len(joined[0])

    def measure(self, matches: int, threads: Executor) -> dict[str, DuelScore]:
        """Play `matches` matches against each rival, and note the results."""
        scores = win_rates(self.task, packed_layers(self.layers()), matches, threads)
        ends = [count for score in scores.values() for count in score]
        if self.points and self.points[-1][0] == self.updates:
            self.points.pop()
        self.points.append((self.updates, self.decisions, round(self.seconds, 3), round(self.entropy, 4), *ends))
        return scores

    def _digested(self, player: int, experience: Experience, share: float) -> tuple[Any, ...]:
        """What a learner's valid decisions are to `Learner.update`."""
        learner, own = self.learners[player], experience.players == player
        views = team_views(experience.inputs, experience.mates)[:, own] if self.task.team_critic else None
        if len(self.learners) > 1:
            parts = (part[own] if part.ndim == 1 else part[:, own] for part in experience[:PLAYED])
            experience = Experience._make([*parts, *experience[PLAYED:]])
        inputs, choices, log_odds, gauges, valid, over, results, *_ = experience
        seen = inputs if views is None else views
        gains = np.diff(gauges, axis=0)
        rewards = self.task.reward(gains, inputs[:-1], choices, share if self.start is None else 1.0)
        rewards = np.where(valid, rewards, np.float32(0))
        last = np.maximum(valid.sum(0) - 1, 0)
        rewards[last, np.arange(len(last))] += np.where(over, results, np.float32(0))
        values = learner.value.forward(seen.reshape(-1, seen.shape[-1]))[0].reshape(seen.shape[:2])
        gained = advantages(rewards, values, valid, over, self.hyper.discount, self.hyper.trace)
        returns = gained + values[:-1]
        digested = inputs[:-1][valid], choices[valid], log_odds[valid], gained[valid], returns[valid]
        return digested if views is None else (*digested, views[:-1][valid])

    def layers(self) -> Layers:
        """The policy in whole numbers."""
        return whole_layers(self.learner.policy.weights)

    def brain(self, name: str = "network") -> BrainKind:
        """A brain that plays by the present policy."""
        return network_brain(name, self.task.encoding, Policy(self.layers()))

    def state(self) -> tuple[dict[str, Any], dict[str, Any]]:
        """Everything that changes, for `restore`: numbers, and arrays by name."""
        networks = self._networks()
        states = [shard.state() for shard in self.shards]
        numbers = {
            **{name: getattr(self, name) for name in NUMBERS},
            "steps": [network.steps for network in networks.values()],
            "random": [self.learner.random.bit_generator.state, *(state.random for state in states)],
            "points": self.points,
            "population": self.population and self.population.state(),
        }
        arrays = {f"{name}_{k}": one for name, network in networks.items() for k, one in enumerate(network.arrays)}
        for k, state in enumerate(states):
            arrays |= {f"matches{k}": state.matches, f"minds{k}": state.minds}
        return numbers, arrays | {f"pool{k}": pool for k, pool in enumerate(self.pools)}

    def _networks(self) -> dict[str, PolicyNetwork]:
        """All networks in training, by name."""
        policies = {f"policy{k}": learner.policy for k, learner in enumerate(self.learners)}
        return policies | {f"value{k}": learner.value for k, learner in enumerate(self.learners)}

    def restore(self, numbers: Mapping[str, Any], arrays: Mapping[str, Any]) -> None:
        """Continue from the result of `state`, bit for bit. Raises KeyError, TypeError or ValueError."""
        for name in NUMBERS:
            setattr(self, name, type(getattr(self, name))(numbers[name]))
        for (name, network), steps in zip(self._networks().items(), numbers["steps"], strict=True):
            network.steps = int(steps)
            for k, one in enumerate(network.arrays):
                one[:] = arrays[f"{name}_{k}"]
        own, *others = numbers["random"]
        self.learner.random.bit_generator.state = own
        for k, (shard, random) in enumerate(zip(self.shards, others, strict=True)):
            shard.restore(ShardState(arrays[f"matches{k}"], arrays[f"minds{k}"], random))
        self.pools = [arrays[f"pool{k}"] for k in range(len(self.pools))]
        self.points = [tuple(point) for point in numbers["points"]]
        if self.population:
            self.population = restored(numbers["population"])


def columns(task: Task) -> tuple[str, ...]:
    """The numbers of a training's points."""
    ends = (f"{bare_name(rival)}_{end}" for rival in task.rivals for end in DuelScore._fields)
    return "updates", "decisions", "seconds", "entropy", *ends


def scores_at(task: Task, point: Sequence[float]) -> dict[str, DuelScore]:
    """The scores of a training's point, by rival."""
    ends = [int(count) for count in point[-3 * len(task.rivals) :]]
    return {rival: DuelScore(*ends[3 * k : 3 * k + 3]) for k, rival in enumerate(task.rivals)}


def in_threads(training: Training, threads: Executor) -> Gather:
    """Gather experience in the threads of this process."""

    def gather(policies: Sequence[Any], pool: Pool, decisions: int) -> list[Experience]:
        return list(threads.map(lambda shard: shard.collect(policies, pool, decisions), training.shards))

    return gather


def whole_layers(weights: Sequence[Any]) -> Layers:
    """Matrices whose last rows are the biases, rounded to whole units. Raises Diverged."""
    rounded = [np.clip(np.rint(matrix * UNIT), -LARGEST, LARGEST) + 0.0 for matrix in weights]  # no -0.0
    layers = Layers([matrix[:-1] for matrix in rounded], [matrix[-1] for matrix in rounded])
    if not layers.largest_sum() < EXACT:  # nor NaN
        raise Diverged("the training has diverged: its weights are too large")
    return layers


def dealt(task: Task, matches: int) -> list[list[LineUp]]:
    """The line-ups of every shard, each in proportion to its share. Raises ValueError for too few matches."""
    hands = _hands(task, matches)
    if not _all_learn(hands):
        most = int(LIMITS["matches"][1])
        least = next((more for more in range(matches, most) if _all_learn(_hands(task, more))), most)
        raise ValueError(f"matches: {matches} are too few for these line-ups; possible are {least} to {most}")
    return hands


def _hands(task: Task, matches: int) -> list[list[LineUp]]:
    total = sum(line_up.share for line_up in task.line_ups)
    every = [line_up for line_up in task.line_ups for _ in range(round(matches * line_up.share / total))]
    return [every[k::SHARDS] for k in range(SHARDS)]


def _all_learn(hands: Sequence[Sequence[LineUp]]) -> bool:
    return all(any(LEARNER in line_up.seats for line_up in hand) for hand in hands)
