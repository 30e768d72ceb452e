"""Many matches of one task, advanced together by a decision: what all environments share.

Every episode is one of the task's matches, number 0 to `starts` - 1, with seeds that only trainings have. Which ones a
match plays follows from its own seed. They are prepared when they are first drawn, and copied from then on.
"""

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

import numpy as np
from gymnasium.error import ResetNeeded

from pigaming_app.ai.learning.batch import initial_states
from pigaming_app.ai.learning.cast import Cast, Family, Think, dispatcher
from pigaming_app.ai.networks.encoding import UNIT, Encoding
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.ai.tallies import Tallies
from pigaming_app.games.registry import games
from pigaming_app.gym.masks import masks_of
from pigaming_app.gym.options import EnvironmentTask
from pigaming_app.gym.rewards import TALLIES, rows_of
from pigaming_app.gym.robots import GAIN, LONGEST, PARAMETERS, drawn_robots, hold_back
from pigaming_app.sim.action import set_action
from pigaming_app.sim.contact import drive
from pigaming_app.sim.kernel import compiled, kernel
from pigaming_app.sim.record import copy, dtype, packed, to_bytes, unpack
from pigaming_app.sim.world import ROBOTS

Loop = Callable[..., None]
SCALE = 1.0 / UNIT

STREAMS = "start_of", "episodes", "seeded", "_streams"
KEPT = (*STREAMS, "fresh", "totals", "_seen", "_trains", "_in_flight")  # of a pickle, beside task and records
LOWEST = np.array([-1.0, -1.0, 0.0, 0.0])  # continuous action
STRIDE = np.uint64(0x9E3779B97F4A7C15)  # of a seed's sequence, as in splitmix64


@kernel
def act_continuously(match: Any, seat: int, action: Any) -> None:
    """Set a seat's action from linear and angular stick in [-1, 1], and fire and turbo, which are on above 0.5."""
    set_action(match.actions[seat], float(action[0]), float(action[1]), int(action[2] > 0.5), int(action[3] > 0.5))


def make_loop(judge: Any, think: Think, act: Any, encoding: Encoding, tallies: Tallies) -> Loop:
    """The loop over matches of a game.

    Of each match (n) and learner (a): `actions` (n, a, choices), `senses` (n, a), `observations` (n, a, inputs),
    `totals` (n, a, tallies), `rewards` (n, a). `minds` (n, opponents) and `weights` are those of the cast, `worth`
    (tallies) the weights of the reward. Learners sit on the first seats, opponents on those after them. A match that is
    `fresh` (n) is only observed; with `only_fresh` the others are left alone. `over` (n) receives 1 if the match is
    over, or nothing is at stake for learners. `trains` (n or 0, 4, PARAMETERS) and `in_flight`: see robots.py.
    """
    encode, size = encoding.encode, encoding.size
    tally, is_done, count = tallies.tally, tallies.is_done, len(tallies.names)

    def play(
        matches: Any,
        minds: Any,
        weights: Any,
        senses: Any,
        actions: Any,
        fresh: Any,
        totals: Any,
        worth: Any,
        observations: Any,
        rewards: Any,
        over: Any,
        ticks: int,
        only_fresh: bool,
        trains: Any,
        in_flight: Any,
    ) -> None:
        learners = rewards.shape[1]
        for i in range(len(matches)):
            if only_fresh and not fresh[i]:
                continue
            match, seated = matches[i], minds[i]
            if not fresh[i]:
                for seat in range(learners):
                    act(match, seat, actions[i, seat])
                for _ in range(ticks):
                    if match.over:
                        break
                    for k in range(len(seated)):
                        think(match, learners + k, seated[k], weights)
                    judge(match)
                    if len(trains):
                        hold_back(match.tick, match.robots, trains[i], in_flight[i])
                    drive(match)
            done = 1
            for seat in range(learners):
                row = observations[i, seat]
                encode(match, seat, senses[i][seat], row)
                for k in range(size):
                    row[k] *= SCALE
                total, reward = totals[i, seat], 0.0
                for k in range(count):
                    reward -= worth[k] * total[k]
                tally(match, seat, senses[i][seat], total)
                for k in range(count):
                    reward += worth[k] * total[k]
                rewards[i, seat] = 0.0 if fresh[i] else reward
                done &= is_done(match, seat)
            over[i] = done

    return play


@cache
def loop_of(game: str, families: tuple[Family, ...], continuous: bool, fast: bool) -> Loop:
    """The loop of a game for a cast, cached; `fast`: compiled. Raises ImportError without numba."""
    encoding = ENCODINGS[game]
    act = act_continuously if continuous else encoding.act
    loop = make_loop(games()[game].judge, dispatcher(families), act, encoding, TALLIES[game])
    return compiled(loop) if fast else loop


class Matches:
    """`count` matches. Observations are (count, learners, inputs), rewards (count, learners), `over` is (count,)."""

    def __init__(self, task: EnvironmentTask, count: int) -> None:
        self.task, self.count = task, count
        self.encoding = ENCODINGS[task.game]
        self.cast = Cast(task.opponents, task.fast)
        self.loop: Loop = loop_of(task.game, self.cast.families, task.continuous, task.fast)
        self.start_of = np.zeros(count, np.int64)  # number of the match that each plays
        self.episodes = np.zeros(count, np.int64)  # that each has begun
        self.seeded = False  # all matches have begun
        self._streams = np.zeros(count, np.uint64)
        self._pool: dict[int, Any] = {}  # prepared matches: state, and minds of the opponents
        shape = (count, task.learners)
        self.fresh = np.ones(count, np.bool_)
        self.totals = np.zeros((*shape, len(TALLIES[task.game].names)))
        self._worth = np.array(task.weights)
        if task.fast:
            self.states: Any = np.zeros(count, dtype(games()[task.game].state))
            self.minds: Any = np.zeros((count, len(task.opponents)), dtype(self.cast.mind))
            self.senses: Any = np.zeros(shape, dtype(self.encoding.senses))
        else:
            self.states, self.minds = [None] * count, [None] * count
            self.senses = [[None] * task.learners for _ in range(count)]
        seen = count if task.reward else 0
        self._seen = np.zeros((seen, task.learners, self.encoding.size), np.float32)  # at the last decision
        self._no_actions = np.zeros((*shape, *action_shape(task)), action_type(task))
        driven = count if task.robots else 0
        self._trains, self._in_flight = np.zeros((driven, ROBOTS, PARAMETERS)), np.zeros((driven, ROBOTS, LONGEST, 2))
        self._choices = np.array([choices for _, choices in self.encoding.heads])

    def begin(self, seeds: Sequence[int | None], which: Any) -> None:
        """Begin the next episode of the matches selected by a mask (count,).

        Each seed determines the episodes of its match from then on; None: it goes on with its sequence.
        """
        for i in np.flatnonzero(which).tolist():
            if (seed := seeds[i]) is not None:
                self._streams[i : i + 1] = mixed(np.array([seed & 0xFFFFFFFFFFFFFFFF], np.uint64))
        self.seeded = True
        self.restart(which)

    def phases(self, decisions: int) -> Any:
        """A number of decisions for each match (count,), from 1 to `decisions`, that follows from its seed."""
        return (mixed(self._streams ^ STRIDE) % np.uint64(decisions)).astype(np.int64) + 1

    def restart(self, which: Any) -> None:
        """Begin the next episode of the matches selected by a mask (count,)."""
        chosen = np.flatnonzero(which)
        self._streams[chosen] += STRIDE
        self.episodes[chosen] += 1
        self.start_of[chosen] = mixed(self._streams[chosen]) % np.uint64(self.task.starts)
        for i, start in zip(chosen.tolist(), self.start_of[chosen].tolist(), strict=True):
            state, minds = self._prepared(start)
            if self.task.fast:
                raw(self.states)[i], raw(self.minds)[i] = state, minds
            else:
                self.states[i], self.minds[i] = copy(state), [copy(mind) for mind in minds]
                self.senses[i] = [self.encoding.senses() for _ in range(self.task.learners)]
        if self.task.fast:
            self.senses[chosen] = np.zeros((), self.senses.dtype)
        self.fresh[chosen] = True
        if self.task.robots:
            self._exchange_robots(chosen)

    def _exchange_robots(self, chosen: Any) -> None:
        """Draw the robots of the episodes that begin, by their seeds."""
        self._in_flight[chosen] = 0.0
        for i in chosen.tolist():
            random = np.random.default_rng(int(self._streams[i]))
            self._trains[i] = drawn_robots(self.task.robots, random)
            if self.task.fast:
                self.states["robots"]["gain"][i] = self._trains[i, :, GAIN]
            else:
                for robot, train in zip(self.states[i].robots, self._trains[i].tolist(), strict=True):
                    robot.gain = train[GAIN]

    def advance(self, actions: Any) -> tuple[Any, Any, Any]:
        """Play one decision; new arrays of observations, rewards and `over`. Fresh matches are only observed.

        `actions`: (count, learners, heads) choices, or (count, learners, 4) if continuous.
        """
        shape = (self.count, self.task.learners)
        observations = np.empty((*shape, self.encoding.size), np.float32)
        rewards, over = np.empty(shape), np.empty(self.count, np.bool_)
        fresh, before = self.fresh.copy(), self.totals.copy()
        self._run(actions, observations, rewards, over, False)
        if self.task.reward:
            task, played = self.task, ~fresh
            rows = rows_of(task.game, self.totals - before, self._seen, actions, task.continuous)
            rewards[fresh], rewards[played] = 0.0, self.task.reward(rows[played])
            self._seen[:] = observations
        return observations, rewards, over

    def observe(self, observations: Any) -> None:
        """Write the first observations of fresh matches into an array of observations."""
        rewards, over = np.empty((self.count, self.task.learners)), np.empty(self.count, np.bool_)
        fresh = self.fresh.copy()
        self._run(self._no_actions, observations, rewards, over, True)
        if self.task.reward:
            self._seen[fresh] = observations[fresh]

    def _run(self, actions: Any, observations: Any, rewards: Any, over: Any, only_fresh: bool) -> None:
        self.loop(
            self.states,
            self.minds,
            self.cast.weights,
            self.senses,
            actions,
            self.fresh,
            self.totals,
            self._worth,
            observations,
            rewards,
            over,
            self.task.ticks,
            only_fresh,
            self._trains,
            self._in_flight,
        )
        self.fresh[:] = False

    def state(self, i: int) -> Any:
        """Match i as a plain record."""
        return unpack(games()[self.task.game].state, self.states[i]) if self.task.fast else self.states[i]

    def result(self, i: int, seat: int = 0) -> dict[str, float]:
        """The tallies of a learner in match i, by name."""
        return dict(zip(TALLIES[self.task.game].names, self.totals[i, seat].tolist(), strict=True))

    def require_begun(self, call: str) -> None:
        """Raises ResetNeeded, with the name of the call, before the first episode."""
        if not self.seeded:
            raise ResetNeeded(f"{call} before reset: an episode begins with reset")

    def checked(self, actions: Any) -> Any:
        """Actions as the array that `advance` takes.

        They are (matches, learners, numbers), (matches * learners, numbers), or (numbers,) for a single learner. Raises
        ValueError if they do not lie in the action space, ResetNeeded before the first episode.
        """
        self.require_begun("step")
        shape = (self.count, self.task.learners, *action_shape(self.task))
        try:
            found = np.asarray(actions)
        except ValueError:
            raise ValueError(f"actions differ in length; {shape[2]} numbers are needed for each agent") from None
        agents = shape[0] * shape[1]
        if found.shape not in (shape, (agents, shape[2]), shape[2:] if agents == 1 else shape):
            raise ValueError(f"actions have the shape {found.shape}; {shape[2]} numbers are needed for each agent")
        if self.task.continuous:
            if found.dtype.kind not in "iuf":
                raise ValueError(f"actions are numbers: two sticks, fire and turbo; not {found.dtype}")
        elif found.dtype.kind not in "iu":
            raise ValueError(f"actions are whole numbers, one for each of the heads {dict(self.encoding.heads)}")
        found = found.reshape(shape)
        least, most = (LOWEST, 1.0) if self.task.continuous else (0, self._choices - 1)
        inside = (found >= least) & (found <= most)
        if not inside.all():
            agent = int(np.flatnonzero(~inside.all(-1))[0])
            action = found.reshape(-1, shape[2])[agent].tolist()
            space = "sticks in [-1, 1], fire and turbo in [0, 1]"
            space = space if self.task.continuous else f"the heads {dict(self.encoding.heads)}"
            raise ValueError(f"action {action} of agent {agent} lies outside {space}")
        return np.ascontiguousarray(found, action_type(self.task))

    def masks(self) -> Any:
        """Whether each choice of the heads, one head after the other, may have a use: bool (count, learners, choices).

        Only those of FIRE and turbo may have none (see masks.py). Raises ValueError for sticks, ResetNeeded before the
        first episode.
        """
        if self.task.continuous:
            raise ValueError("action_masks: sticks have no choices; continuous=True excludes them")
        self.require_begun("action_masks")
        found = np.ones((self.count, self.task.learners, self.encoding.outputs), np.bool_)
        buttons = np.empty((*found.shape[:2], 2), np.bool_)
        masks_of(self.task.game, self.task.fast)(self.states, buttons, self.task.ticks)
        found[:, :, [-3, -1]] = buttons  # two choices each: off, on
        return found

    def __getstate__(self) -> dict[str, Any]:
        """Task, arrays and records as bytes: equal for both bodies."""
        kept = {name: getattr(self, name) for name in ("task", "count", *KEPT)}
        if self.seeded:
            kept["records"] = [self._bytes(rows) for rows in (self.states, self.minds, self.senses)]
        return kept

    def __setstate__(self, kept: dict[str, Any]) -> None:
        self.__init__(kept["task"], kept["count"])  # type: ignore[misc]
        for name in KEPT:
            setattr(self, name, kept[name])
        if not self.seeded:
            return
        kinds = games()[self.task.game].state, self.cast.mind, self.encoding.senses
        states, minds, senses = (np.frombuffer(r, dtype(k)) for r, k in zip(kept["records"], kinds, strict=True))
        if self.task.fast:
            self.states[:], self.minds[:] = states, minds.reshape(self.minds.shape)
            self.senses[:] = senses.reshape(self.senses.shape)
        else:
            self.states = [unpack(kinds[0], row) for row in states]
            self.minds = [[unpack(kinds[1], mind) for mind in row] for row in minds.reshape(self.count, -1)]
            self.senses = [[unpack(kinds[2], one) for one in row] for row in senses.reshape(self.count, -1)]

    def _bytes(self, rows: Any) -> bytes:
        if self.task.fast:
            return bytes(rows.tobytes())
        return b"".join(to_bytes(one) for row in rows for one in (row if isinstance(row, list) else (row,)))

    def _prepared(self, start: int) -> Any:
        if start not in self._pool:
            setup = self.task.setup_of(start)
            (state,) = initial_states([setup])
            minds: Any = [
                self.cast.mind_of(kind, setup.seed * ROBOTS + seat)
                for seat, kind in enumerate(self.task.opponents, self.task.learners)
            ]
            if self.task.fast:
                state = raw(packed([state]))[0]
                minds = raw(packed(minds) if minds else np.zeros(0, self.minds.dtype))
            self._pool[start] = state, minds
        return self._pool[start]


def raw(rows: Any) -> Any:
    """A view of NumPy records as bytes, which are copied at once instead of field by field."""
    return rows.view(f"V{rows.dtype.itemsize}")


def action_shape(task: EnvironmentTask) -> tuple[int]:
    """The length of one learner's action."""
    return (4,) if task.continuous else (len(ENCODINGS[task.game].heads),)


def action_type(task: EnvironmentTask) -> Any:
    return np.float64 if task.continuous else np.int64


def mixed(numbers: Any) -> Any:
    """Well-scattered numbers of 64 bits: the output function of splitmix64."""
    numbers = (numbers ^ (numbers >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    numbers = (numbers ^ (numbers >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return numbers ^ (numbers >> np.uint64(31))
