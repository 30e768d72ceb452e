"""An evaluation: the matches of a task, which depend on the agent alone. Equal in both bodies, to the last bit."""

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any

import numpy as np
from msgspec import Meta

from pigaming_app import ASSETS
from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.learning.cast import Cast, Family, Think, dispatcher
from pigaming_app.ai.learning.rollout import Batch, cast_with_baselines
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.game import Setup
from pigaming_app.games.registry import games
from pigaming_app.games.setup import longest, make_setup
from pigaming_app.gym.benchmark.tasks import AGENT, MATCHES, RIVAL, SEED, BenchmarkTask, Condition
from pigaming_app.gym.robots import GAIN, LONGEST, drawn_robots, hold_back, read_robots
from pigaming_app.sim.contact import drive
from pigaming_app.sim.kernel import can_compile, compiled
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.schema import Count

MEASURED = ASSETS / "benchmark" / "robots.toml"
Digest = Annotated[str, Meta(pattern=r"^[0-9a-f]{64}\Z")]


@dataclass(frozen=True)
class MatchCounts:
    """How the matches of a condition ended for the agent. `digest`: SHA-256 over the last states of all."""

    wins: Count
    ties: Count
    losses: Count
    digest: Digest

    @property
    def points(self) -> float:
        """A win is 1, a tie 1/2."""
        return self.wins + 0.5 * self.ties


def score_of(task: BenchmarkTask, ends: Mapping[str, MatchCounts]) -> tuple[float, int]:
    """Points in all conditions of a task that count, and the number of their matches."""
    counted = [ends[name] for name, condition in task.conditions.items() if condition.counts]
    return sum(one.points for one in counted), sum(one.wins + one.ties + one.losses for one in counted)


def evaluate(task: BenchmarkTask, agent: str, rival: str = "", matches: int = MATCHES) -> dict[str, MatchCounts]:
    """Play the matches of a task, by condition. `agent`, `rival`: names or paths of brains. Raises ChoiceError."""
    chosen = {AGENT: agent, RIVAL: rival}
    names = {name: chosen.get(name, name) for one in task.conditions.values() for name in one.seats}
    kinds = {name: find_brain(task.game, brain) for name, brain in names.items()}
    fast = can_compile() and not any(kind.plain for kind in kinds.values())
    cast = cast_with_baselines(kinds.values(), fast)
    return {name: _played(task, condition, kinds, cast, matches) for name, condition in task.conditions.items()}


def _played(
    task: BenchmarkTask, condition: Condition, kinds: Mapping[str, BrainKind], cast: Cast, matches: int
) -> MatchCounts:
    """The matches of one condition, every other one with the sides swapped."""
    setups = [_setup(task, condition, number // 2) for number in range(matches)]
    leads, digests = [0.0] * matches, [""] * matches
    for side in (0, 1):
        order = [condition.seats[seat ^ side] for seat in range(len(condition.seats))]
        batch = Batch(setups[side::2], [kinds[name] for name in order], cast.fast, cast)
        if condition.measured:
            _exchange_robots(batch, setups[side::2])
        batch.play(longest(setups[0]))
        seat, rank = order.index(AGENT), games()[task.game].ranking_key
        states = batch.ended()
        leads[side::2] = [rank(state, seat) - rank(state, seat ^ 1) for state in states]
        digests[side::2] = [digest(state) for state in states]
    wins, ties = sum(lead > 0 for lead in leads), sum(lead == 0 for lead in leads)
    return MatchCounts(wins, ties, matches - wins - ties, hashlib.sha256("".join(digests).encode()).hexdigest())


def _setup(task: BenchmarkTask, condition: Condition, number: int) -> Setup:
    """The setup of a pair of matches. All robots are AIs, whichever they are."""
    arena = condition.arenas[number % len(condition.arenas)]
    seats = ["random"] * len(condition.seats)
    return make_setup(task.game, seats, arena, task.minutes, SEED + number, task.variant, condition.teams, seats)


def _exchange_robots(batch: Batch, setups: Sequence[Setup]) -> None:
    """Draw measured robots for the matches of a batch, by their seeds."""
    measured = read_robots(MEASURED)
    trains = np.stack([drawn_robots(measured, np.random.default_rng(setup.seed)) for setup in setups])
    in_flight = np.zeros((len(setups), ROBOTS, LONGEST, 2))
    loop = _driven_rollout(batch.game, batch.cast.families, batch.fast)
    batch.loop = lambda *arguments: loop(*arguments, trains, in_flight)
    if batch.fast:
        batch.matches["robots"]["gain"] = trains[:, :, GAIN]
        return
    for match, row in zip(batch.matches, trains.tolist(), strict=True):
        for robot, train in zip(match.robots, row, strict=True):
            robot.gain = train[GAIN]


@cache
def _driven_rollout(game: str, families: tuple[Family, ...], fast: bool) -> Callable[..., None]:
    rollout = _make_driven_rollout(games()[game].judge, dispatcher(families))
    return compiled(rollout) if fast else rollout


def _make_driven_rollout(judge: Callable[[Any], None], think: Think) -> Callable[..., None]:
    """`make_rollout` with robots of their own; `trains`, `in_flight`: see `hold_back`."""

    def rollout(matches: Any, minds: Any, weights: Any, ticks: int, trains: Any, in_flight: Any) -> None:
        for i in range(len(matches)):
            match, seated = matches[i], minds[i]
            for _ in range(ticks):
                if match.over:
                    break
                for seat in range(ROBOTS):
                    think(match, seat, seated[seat], weights)
                judge(match)
                hold_back(match.tick, match.robots, trains[i], in_flight[i])
                drive(match)

    return rollout
