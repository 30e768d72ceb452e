"""Matches in which a network gathers experience, played by one compiled loop.

The matches of a training are divided into shards with random generators of their own. What a shard plays depends only
on its state and on the policy, so shards may be played in any order, in threads, processes or on other machines.
"""

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from pigaming_app.ai.learning.batch import matches as new_matches
from pigaming_app.ai.learning.cast import Cast, dispatcher, family_of
from pigaming_app.ai.learning.team_critic import mates_of
from pigaming_app.ai.networks.encoding import PERIOD, UNIT
from pigaming_app.ai.networks.layers import Layers
from pigaming_app.ai.networks.policy import Policy, network_brain
from pigaming_app.ai.plugin_faults import bound, late
from pigaming_app.ai.ppo.forward import make_bend, make_layer, sample
from pigaming_app.ai.ppo.population import EXPLOITED, Pool
from pigaming_app.ai.ppo.task import EXPLOITER, LEARNER, LEARNERS, OFF, POOL, LineUp, Task
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.sim.contact import drive
from pigaming_app.sim.kernel import compiled, compiled_before
from pigaming_app.sim.record import packed, unpack
from pigaming_app.sim.rng import SEEDS, seeded, training_seed
from pigaming_app.sim.world import HZ, ROBOTS
from pigaming_app.storage.plugins.endless import overseer

NOBODY, LEARNING = -1, -2  # families of a seat that no brain of the cast plays; each learner has its own, downwards
STARTS = 4  # prepared starts of every kind of match; all else that is random in it is drawn anew
MINDS = 8  # prepared minds of every brain


class Experience(NamedTuple):
    """What a shard has played: T decisions in S streams. A stream is a seat with a learner."""

    inputs: (
        np.ndarray
    )  # (T + 1, S, inputs + 1) float32; the last row is the situation after the last decision; see Network
    choices: np.ndarray  # (T, S, heads) int64
    log_odds: np.ndarray  # (T, S) float32, logarithm of the probability of the choices
    gauges: np.ndarray  # (T + 1, S, gauges) float32
    valid: np.ndarray  # (T, S) bool; False after the end of a match
    over: np.ndarray  # (S,) bool; the match has ended
    results: np.ndarray  # (S,) float32, reward of its end
    players: np.ndarray  # (S,) int64, the learner: its place in `Task.learners`
    mates: np.ndarray  # (S, 3) int64, streams of the same learner in the same team; -1 for those that there are not
    outcomes: np.ndarray  # (n, 2), ends of matches against a member of the population: its place, the learner's score


PLAYED = Experience._fields.index("mates")  # fields that the loop fills


class ShardState(NamedTuple):
    """All that changes in a shard."""

    matches: Any
    minds: Any
    random: Any  # state of the generator


def make_collect(task: Task, think: Callable[..., None], field: str) -> Callable[..., None]:
    """A loop in which the learners of all matches decide and the others think.

    `field`: that of the networks' minds in a seat's mind.
    """
    judge, encode, act = games()[task.game].judge, task.encoding.encode, task.encoding.act
    gauge, result = task.gauge, task.result
    size, outputs = task.encoding.size, task.encoding.outputs
    counts = tuple(choices for _, choices in task.encoding.heads)
    heads = len(counts)
    units = task.units
    first_layer, second_layer = make_layer(size, units), make_layer(units, units)
    last_layer, bend = make_layer(units, outputs), make_bend(units)

    def collect(
        matches: np.ndarray,
        minds: np.ndarray,
        weights: np.ndarray,
        streams: np.ndarray,
        first_matrices: np.ndarray,
        second_matrices: np.ndarray,
        last_matrices: np.ndarray,
        inputs: np.ndarray,
        choices: np.ndarray,
        log_odds: np.ndarray,
        gauges: np.ndarray,
        valid: np.ndarray,
        over: np.ndarray,
        results: np.ndarray,
        players: np.ndarray,
    ) -> None:
        one, two, logits = np.zeros(units, np.float32), np.zeros(units, np.float32), np.zeros(outputs, np.float32)
        decisions = len(choices)
        for i in range(len(matches)):
            match, seated = matches[i], minds[i]
            for t in range(decisions + 1):
                for seat in range(ROBOTS):
                    s = streams[i, seat]
                    if s < 0 or (match.over and t > 0 and not valid[t - 1, s]):
                        continue
                    mind, x = getattr(seated[seat], field), inputs[t, s]
                    encode(match, seat, mind.senses, x)
                    gauge(match, seat, x, gauges[t, s])
                    for k in range(size):
                        x[k] *= np.float32(1.0 / UNIT)
                    x[size] = np.float32(1.0)
                    if match.over:
                        over[s], results[s] = True, result(match, seat)
                        continue
                    if t == decisions:
                        continue
                    first_layer(x, first_matrices[players[s]], one)
                    bend(one)
                    second_layer(one, second_matrices[players[s]], two)
                    bend(two)
                    last_layer(two, last_matrices[players[s]], logits)
                    first = 0
                    for head in range(heads):
                        choice, odds = sample(logits, first, counts[head], mind)
                        choices[t, s, head] = choice
                        log_odds[t, s] += odds
                        first += counts[head]
                    valid[t, s] = True
                    act(match, seat, choices[t, s])
                if t < decisions:
                    for _ in range(PERIOD):
                        if match.over:
                            break
                        for seat in range(ROBOTS):
                            if streams[i, seat] < 0:
                                think(match, seat, seated[seat], weights)
                        judge(match)
                        drive(match)

    return collect


@cache
def loop_of(task: Task) -> Callable[..., None]:
    """The compiled loop of a task, cached. Raises ImportError without numba."""
    cast, network = cast_of(task)
    field = f"mind{cast.families.index(family_of(network))}"
    return compiled(make_collect(task, dispatcher(cast.families), field))


def is_compiled(task: Task) -> bool:
    """True if numba's on-disk cache holds the loop of a task, so that it loads at once."""
    return compiled_before(make_collect(task, dispatcher(cast_of(task)[0].families), ""))


def empty_experience(task: Task, streams: int, decisions: int) -> Experience:
    """Room for experience."""
    return Experience(
        np.zeros((decisions + 1, streams, task.encoding.size + 1), np.float32),
        np.zeros((decisions, streams, len(task.encoding.heads)), np.int64),
        np.zeros((decisions, streams), np.float32),
        np.zeros((decisions + 1, streams, len(task.gauges)), np.float32),
        np.zeros((decisions, streams), np.bool_),
        np.zeros(streams, np.bool_),
        np.zeros(streams, np.float32),
        np.zeros(streams, np.int64),
        np.full((streams, ROBOTS - 1), -1),
        np.zeros((0, 2)),
    )


class Shard:
    """Some matches of a training, with their random generator."""

    def __init__(self, task: Task, line_ups: Sequence[LineUp], seed: int) -> None:
        """One match for each of `line_ups`. Raises ArenaError; ImportError without numba."""
        self.task, self.line_ups = task, tuple(line_ups)
        self.random = np.random.default_rng(seed)
        self.cast, self.network = cast_of(task)
        self._number = self.cast.families.index(family_of(self.network))
        self._starts: dict[Any, Any] = {}
        self._experience: Experience | None = None
        self._minds = {name: self._prepared(name) for name in brains_of(task)}
        count = len(self.line_ups)
        self.matches: Any = np.repeat(self._start(self.line_ups[0]), count)
        self.minds: Any = np.zeros((count, ROBOTS), self._nobody.dtype)
        self.streams: Any = np.full((count, ROBOTS), -1)
        self._played = np.zeros(count, np.int64)  # ticks of each match, at least
        for i in range(count):
            self._begin(i, self._first_pool)
            ticks = int(self.matches["rules"]["ticks"][i])
            self.matches["tick"][i] = self.random.integers(max(1, ticks))  # so that not all end at the same time
        self._count_streams()

    def collect(self, policies: Sequence[Any], pool: Pool, decisions: int) -> Experience:
        """Play `decisions` decisions and begin the matches that have ended anew. The next call overwrites the result.

        `policies`: three float32 arrays (learners, inputs + 1, units), whose last rows are the biases.
        """
        experience = self._experience
        if experience is None or len(experience.choices) != decisions:
            experience = self._experience = empty_experience(self.task, self.width, decisions)
        for array in experience[2:PLAYED]:
            array.fill(0)
        experience.players[:] = LEARNING - self.minds["family"][self.streams >= 0]
        teams = self.matches["robots"]["team"]
        mates = mates_of(self.minds["family"], teams, self.streams) if self.task.team_critic else experience.mates
        networks = np.concatenate([self.cast.weights[self._number], pool.rows])
        weights = tuple(networks if k == self._number else row for k, row in enumerate(self.cast.weights))
        arguments = self.matches, self.minds, weights, self.streams, *policies, *experience[:PLAYED]
        overseer.run(self.task.game, self.matches["tick"].sum, loop_of(self.task), *arguments)
        ended = self.matches["over"] > 0
        self._check_length(ended, decisions * PERIOD)
        outcomes = self._outcomes() if self.task.population else experience.outcomes
        if self.task.cut:
            ended |= self.random.random(len(ended)) < self.task.cut
        for i in np.flatnonzero(ended):
            self._begin(int(i), pool)
        self._count_streams()
        return experience._replace(mates=mates, outcomes=outcomes)

    def _outcomes(self) -> Any:
        """The ends of matches against the exploiter or one member of the pool."""
        rules, found = games()[self.task.game], []
        for i in np.flatnonzero(self.matches["over"]):
            others = {*self.line_ups[i].seats} - {OFF, LEARNER}
            if others not in ({EXPLOITER}, {POOL}):
                continue
            end: Any = unpack(rules.state, self.matches[i])
            families = self.minds["family"][i]
            own = int(np.flatnonzero(families == LEARNING)[0])
            seat = next(k for k in range(ROBOTS) if families[k] not in (LEARNING, NOBODY))
            lead = rules.ranking_key(end, own) - rules.ranking_key(end, seat)
            row = int(self.minds["row"][i, seat]) - len(self.cast.weights[self._number])
            found.append((EXPLOITED if EXPLOITER in others else row, 0.5 * (1 + (lead > 0) - (lead < 0))))
        return np.array(found, float).reshape(-1, 2)

    def _check_length(self, ended: np.ndarray, ticks: int) -> None:
        """Count the ticks of matches that go on. Raises GameFault for a plug-in's match that does not end."""
        self._played = np.where(ended, 0, self._played + ticks)
        variants, game = games()[self.task.game].variants, self.task.game
        overtime = max(variants[name].overtime for name in self.task.variants)
        time = round((max(self.task.minutes) * 60 + overtime) * HZ)
        if overseer.is_overseen(game) and self._played.max() > bound(game, time):
            raise late(game)

    def warm(self) -> None:
        """Compile the loop, for a fresh shard."""
        sizes = self.task.sizes
        policies = [np.zeros((len(self.task.learners), inputs + 1, units), np.float32) for inputs, units in sizes]
        self.collect(policies, self._first_pool, 0)

    @property
    def width(self) -> int:
        """Number of streams."""
        return int((self.streams >= 0).sum())

    def state(self) -> ShardState:
        """Everything that changes, for `restore`."""
        return ShardState(self.matches.copy(), self.minds.copy(), self.random.bit_generator.state)

    def restore(self, state: ShardState) -> None:
        """Continue from the result of `state`. Raises KeyError, TypeError or ValueError."""
        self.matches, self.minds = state.matches.copy(), state.minds.copy()
        self.random.bit_generator.state = state.random
        self._count_streams()

    def _begin(self, i: int, pool: Pool) -> None:
        """Begin match i of its line-up anew."""
        line_up, random = self.line_ups[i], self.random
        self.matches[i] = self._start(line_up)[0]
        self.matches["random"][i] = _state(random)
        taken = [name for name in line_up.seats if name != OFF]
        shift = int(random.integers(len(taken)))
        member = None if pool.chances is None else random.choice(len(pool.rows), p=pool.chances)
        for seat in range(ROBOTS):
            name = taken[(seat + shift) % len(taken)] if seat < len(taken) else OFF
            prepared = self._minds[name]
            self.minds[i, seat] = prepared[random.integers(len(prepared))]
            if name == POOL:
                place = random.integers(len(pool.rows)) if member is None else member
                self.minds["row"][i, seat] = len(self.cast.weights[self._number]) + place
            if name != OFF:
                family = self._number if name in LEARNERS else int(self.minds["family"][i, seat])
                drawn, mind = _state(random), self.minds[f"mind{family}"]
                if "random" in mind.dtype.names:
                    mind["random"][i, seat] = drawn
            if name in (LEARNER, POOL) and EXPLOITER not in line_up.seats:
                for field, value in self.task.habits(random).items():
                    self.minds[f"mind{self._number}"]["senses"][field][i, seat] = value

    def _count_streams(self) -> None:
        """Number the learners' seats."""
        learning = self.minds["family"] <= LEARNING
        self.streams = np.where(learning, np.cumsum(learning).reshape(learning.shape) - 1, -1)

    def _start(self, line_up: LineUp) -> Any:
        """A prepared start of a match of this kind: a row of one."""
        task, random = self.task, self.random
        variants = line_up.variants or task.variants
        variant, arena = (str(random.choice(names)) for names in (variants, line_up.arenas or task.arenas))
        minutes, number = float(random.choice(task.minutes)), training_seed(int(random.integers(STARTS)))
        key = variant, arena, minutes, number, line_up.teams, sum(name != OFF for name in line_up.seats)
        if key not in self._starts:
            rules = games()[task.game].variants[variant]
            teams = line_up.teams or rules.teams
            one, two, three, four = (Seat("off" if seat >= key[-1] else LEARNER, teams[seat]) for seat in range(ROBOTS))
            setup = Setup(task.game, arena, (one, two, three, four), minutes, number, variant, rules.default_goal)
            self._starts[key] = new_matches([setup])
        return self._starts[key]

    def _prepared(self, name: str) -> Any:
        """Fresh minds of a brain (n,)."""
        kind = self.network if name in (*LEARNERS, POOL) else find_brain(self.task.game, name) if name != OFF else None
        minds = [nobody(self.cast) if kind is None else self.cast.mind_of(kind, training_seed(i)) for i in range(MINDS)]
        if name in LEARNERS:
            for mind in minds:
                mind.family = LEARNING - LEARNERS.index(name)
        return packed(minds)

    @property
    def _first_pool(self) -> Pool:
        """For matches that begin before there is a pool: of one row, since every pool has that place."""
        return Pool(self.cast.weights[self._number][:1])

    @property
    def _nobody(self) -> Any:
        return self._minds[OFF]


def _state(random: np.random.Generator) -> int:
    """A generator's state for a match or a mind of a training."""
    return seeded(training_seed(int(random.integers(SEEDS))))


def nobody(cast: Cast) -> Any:
    """A mind that leaves its seat alone."""
    mind = cast.mind()
    mind.family = NOBODY
    return mind


def brains_of(task: Task) -> list[str]:
    """The names on the seats of a task's line-ups, sorted."""
    return sorted({name for line_up in task.line_ups for name in line_up.seats} | {OFF, POOL, *LEARNERS})


@cache
def cast_of(task: Task) -> tuple[Cast, Any]:
    """The cast of a task's matches, and an empty network; those of the pool are added to its family in every round."""
    empty = Layers([np.zeros(size) for size in task.sizes], [np.zeros(units) for _, units in task.sizes])
    network = network_brain("network", task.encoding, Policy(empty), units=task.units)
    names = {*brains_of(task), *task.rivals} - {*LEARNERS, POOL, OFF}
    rivals = {find_brain(task.game, name) for name in names}
    return Cast([network, *sorted(rivals, key=lambda kind: kind.name)], fast=True), network
