"""Lapses of attention, by what somebody leaves undone while models would do something.

Most decisions on keys change nothing, so a pause may be a lapse or contentment. How likely a decision at a tick is to
show follows from how many models would change something there; FIRE that goes down or comes up tells that somebody
attends, too. The rest is a hidden semi-Markov model, as the hands are one (`hands.move`): attending, with a time since
the last decision, or away.

The search is that of E. K. Berndt, B. H. Hall, R. E. Hall, J. A. Hausman, "Estimation and inference in nonlinear
structural models", Annals of Economic and Social Measurement 3, 1974.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from math import erf, sqrt
from typing import Any

import numpy as np

from pigaming_app.ai.people.fit.inputs import HandInputs
from pigaming_app.ai.people.fit.wishes import Array, Watched
from pigaming_app.ai.people.hands import PRESSED, SHORTEST, STILL, TAP
from pigaming_app.sim.world import HZ

MODELS = 8  # of `wishes.ASKED`, without those of finer reactions
SWAY = 4.0  # ticks, standard deviation of the length of a tap
AFTER = (int(0.4 * HZ), int(0.9 * HZ))  # ticks after a shot in which somebody may watch it
PACE = 2  # ticks of a step, for speed
LONGEST = 250  # ticks; of a longer pause only so many count
FIRE_BY = ((0.01, 0.3, 0.6, 0.99), (3, 5, 8, 15, 40))  # shares of models that disagree with FIRE; ticks since it moved
NUMBERS = (
    "odds", "length", "shows", "asked", "all", "none", "after", "later",
    "turning", "spin", "still", "backing", "stop", "back",
)  # fmt: skip
"""Of a lapse, the logarithms of the odds per tick and of the mean length in ticks; then the log-odds that a decision
shows: in general, for each of the models' log-odds, while all models ask for a change, while none does, in the two
times AFTER a shot; and on keys alone: while a turn key is down, for each 3 rad/s of turn, while no drive key is down,
while that for backwards is, for the share of the models that would stop, and for that of those that would back up."""
USUAL = np.array((-7.0, 3.7, 0.0, 0.8, *[0.0] * (len(NUMBERS) - 4)))
APART = np.array((1.2, 0.7, 0.8, 0.4, *[0.8] * (len(NUMBERS) - 4)))  # standard deviations, before anything is seen
ODDS, LENGTHS = (-0.7, 0.7), (-0.8, -0.3, 0.2, 0.7, 1.2)  # off USUAL, from the best of which a search begins
LONGER, AGAIN = (-0.4, -0.15, 0.15, 0.4), 2  # off its end, from where it begins again; how often
NEARBY, NEAR = 1e-3, 0.04  # steps for slopes; the last step of lapses

Logs = Callable[[Array], Array]


@dataclass(frozen=True)
class Pauses:
    """From each decision that shows to the next, the longest first, in the ticks of all matches in a row."""

    start: Array  # (pauses,): the tick of the decision
    length: Array  # (pauses,): ticks to the next decision, or to the end
    ended: Array  # (pauses,): whether by a decision; else the match ends, or the pause is longer than LONGEST
    asking: Array  # (ticks, 12): of NUMBERS from "shows" on
    moved: Array  # (ticks,): whether FIRE has gone down or come up in this step
    moves: Array  # (ticks,): the chance of that in such situations


def attention_of(pauses: Pauses, period: float) -> tuple[Array, Array]:
    """The likeliest NUMBERS of somebody with this period (ticks) between decisions, and their standard deviations."""
    hazard = decision_hazard(period)

    def logs(x: Array) -> Array:
        shows = 1.0 / (1.0 + np.exp(-pauses.asking @ x[2:]))
        found = chances(pauses, shows, hazard, *_in_steps(x))
        return np.array(np.log(found + 1e-12))

    def value(x: Array, found: Array) -> float:
        return float(found.sum() - 0.5 * np.sum(((x - USUAL) / APART) ** 2))

    def best(starts: Iterable[Array]) -> tuple[Array, Array]:
        return max(((x, logs(x)) for x in starts), key=lambda pair: value(*pair))

    x, here = best(USUAL + _lapses(odds, length) for odds in ODDS for length in LENGTHS)
    for _ in range(AGAIN):
        x, here, known = _climbed(x, here, logs, value)
        before = x
        x, here = best([x, *(x + _lapses(-longer, longer) for longer in LONGER)])  # elsewhere it may be higher
        if x is before:
            break
    return x, np.sqrt(np.diag(np.linalg.inv(known)))


def _climbed(x: Array, here: Array, logs: Logs, value: Callable[[Array, Array], float]) -> tuple[Array, Array, Array]:
    """The maximum near x, the logarithms there, and the information on it."""
    while True:
        slopes = np.stack([logs(x + step) - here for step in NEARBY * np.eye(len(x))], axis=1) / NEARBY
        known = slopes.T @ slopes + np.diag(APART**-2.0)
        step = np.linalg.solve(known, slopes.sum(axis=0) - (x - USUAL) / APART**2)
        step = step / max(1.0, np.abs(step).max())
        there = logs(x + step)
        while (worse := value(x + step, there) < value(x, here)) and np.abs(step).max() > NEAR:
            step = 0.4 * step
            there = logs(x + step)
        if worse:
            return x, here, known
        x, here = x + step, there
        if np.abs(step[:2]).max() < NEAR:
            return x, here, known


def _in_steps(x: Array) -> tuple[float, float]:
    """Odds of a lapse per step, and the steps of the longest."""
    return PACE * float(np.exp(min(x[0], -2.0))), 2.0 / PACE * float(np.exp(np.clip(x[1], 1.0, 6.0)))


def _lapses(odds: float, length: float) -> Array:
    return np.append([odds, length], np.zeros(len(USUAL) - 2))


def decision_hazard(period: float) -> Array:
    """Chance of a decision by the steps since the last one, from 0 on, if there was none in between: `hands.move`."""
    waits = 1 + (period * (0.7 + 0.6 * (np.arange(2000) + 0.5) / 2000.0)).astype(int)
    chance = np.bincount(-(-waits // PACE)) / 2000.0
    left = 1.0 - np.append(0.0, np.cumsum(chance)[:-1])
    return np.array((chance / np.maximum(left, 1e-9))[1:])


def chances(pauses: Pauses, shows: Array, hazard: Array, odds: float, reach: float) -> Array:
    """The chance of each pause; all of them advance together, a step at a time.

    `shows`: of each tick, the chance that a decision shows; `hazard`: `decision_hazard`; `odds`: of a lapse, per step,
    whose length is uniform up to `reach` steps. A lapse begins after what a step does.
    """
    length, whole, ages = -(-pauses.length // PACE), int(reach), len(hazard)
    attend, back, left = np.zeros((len(length), ages)), np.zeros((len(length), ages)), [np.zeros((len(length), ages))]
    awake, found = np.zeros(len(length), int), np.zeros(len(length))
    attend[:, 0] = 1.0 - odds
    left[0][:, 0] = odds  # of those who are away, by the step in which they left
    for step in range(1, int(length[0]) + 1):
        alive = int(np.searchsorted(-length, -step, side="right"))
        tick = pauses.start[:alive] + np.minimum(PACE * step, pauses.length[:alive])
        attend, back, awake = attend[:alive], back[:alive], awake[:alive]
        if step >= 2:
            back = back + left[step - 2][:alive] * (awake <= step - 2)[:, None]
        if (old := step - whole - 2) >= 0:
            over = left[old][:alive] * (awake <= old)[:, None]
            back, attend = back - over, attend + over * ((reach - whole) / reach)
        attend = attend + back / reach
        moved = pauses.moved[tick]
        seen = np.where(moved, pauses.moves[tick], 1.0 - pauses.moves[tick])
        decides = attend @ hazard
        ends, ended = length[:alive] == step, pauses.ended[:alive]
        found[:alive][ends] = (decides * shows[tick] * seen)[ends]
        attend[:, 1:] = attend[:, :-1] * (1.0 - hazard[:-1])
        attend[:, 0] = decides * (1.0 - shows[tick])
        attend *= seen[:, None]
        back[moved], awake[moved] = 0.0, step
        if len(cut := np.flatnonzero(ends & ~ended)):
            found[cut] = attend[cut].sum(axis=1)
            for k in range(max(0, step - whole), step):
                found[cut] += (1.0 - (step - k) / reach) * left[k][cut].sum(axis=1) * (awake[cut] <= k)
        left.append(attend * odds)
        attend = attend * (1.0 - odds)
    return found


def pauses_of(plays: Sequence[Watched], hands: Sequence[HandInputs], pointing: bool) -> Pauses:
    """Those between the decisions of all matches."""
    starts, lengths, ends, ticks = [], [], [], 0
    for play, hand in zip(plays, hands, strict=True):
        apart = np.diff(np.append(hand.decisions, len(play.actions) - 1))
        starts.append(ticks + hand.decisions)
        lengths.append(np.minimum(apart, LONGEST))
        ends.append((np.arange(len(apart)) < len(apart) - 1) & (apart < LONGEST))
        ticks += len(play.actions)
    every = [np.concatenate(parts) for parts in (starts, lengths, ends)]
    order = np.argsort(-every[1], kind="stable")
    order = order[every[1][order] > 0]
    moved, situation = (np.concatenate(parts) for parts in zip(*map(_fire, plays), strict=True))
    rest = 1.0 - ((np.bincount(situation, weights=moved) + 0.05) / (np.bincount(situation) + 3.0))[situation]
    asking = np.concatenate([_asking(play, pointing) for play in plays])
    moved, rest = np.any(_steps(moved), axis=0), np.prod(_steps(rest), axis=0)
    start, length, ended = (part[order] for part in every)
    return Pauses(start, length, ended, asking, moved, 1.0 - rest)


def _steps(ticks: Array) -> Array:
    """The ticks of the step that ends with each tick, (PACE, ticks)."""
    return np.stack([np.roll(ticks, back) for back in range(PACE)])


def _asking(play: Watched, pointing: bool) -> Array:
    """What tells whether a decision at each tick would show, (ticks, 12): of NUMBERS from "shows" on."""
    wishes, before = play.wishes[:, :MODELS], np.vstack([np.zeros((1, 2)), play.actions[:-1, :2]])
    turns, turning = np.abs(wishes[:, :, 1]), np.abs(before[:, 1])  # of keys: 1 or 0
    if pointing:  # with noise, so that each decision shows that does not leave the stick at rest
        asked = before.any(axis=1, keepdims=True) | (np.abs(wishes[:, :, 0]) >= STILL) | (turns >= STILL)
        share, keys = asked.mean(axis=1), np.zeros((6, len(turning)))
    else:
        wanted = np.where(np.abs(wishes[:, :, 0]) > PRESSED, np.sign(wishes[:, :, 0]), 0.0)
        taps = np.where(turns >= 1.0, 1.0, _below((turns * TAP - SHORTEST) / SWAY)) * (1.0 - turning)[:, None]
        share = np.where(wanted != before[:, :1], 1.0, taps).mean(axis=1)
        down = before[:, 0] == 0.0, before[:, 0] < 0.0, (wanted == 0.0).mean(axis=1), (wanted < 0.0).mean(axis=1)
        keys = np.stack([turning, np.abs(play.poses[:, 1]) / 3.0, *down])
    odds = np.log((0.01 + 0.97 * share) / (0.99 - 0.97 * share))
    shots = np.flatnonzero(np.diff(play.actions[:, 2]) > 0.0) + 1
    since = _since(shots, len(odds), "right")
    after = since < AFTER[0], (since >= AFTER[0]) & (since < AFTER[1])
    return np.stack([np.ones(len(odds)), odds, odds > 3.0, odds < -4.0, *after, *keys], axis=1).astype(float)


def _fire(play: Watched) -> tuple[Array, Array]:
    """Of each tick, whether FIRE moves, and a number of its situation: what models wish of it, when it last moved."""
    fire, (shares, ticks) = play.actions[:, 2], FIRE_BY
    before = np.append(0.0, fire[:-1])
    moved = fire != before
    disagree = (play.wishes[:, :MODELS, 2] != before[:, None]).mean(axis=1)
    since = _since(np.flatnonzero(moved), len(fire), "left")
    return moved, np.digitize(disagree, shares) + 5 * before.astype(int) + 10 * np.digitize(since, ticks)


def _since(at: Array, ticks: int, side: Any) -> Array:
    """Ticks since the last of these, for all ticks of a match; with the side "left" those before the tick count."""
    every = np.arange(ticks)
    return np.array(every - np.append(-LONGEST, at)[np.searchsorted(at, every, side=side)])


_GRID = np.linspace(-4.0, 4.0, 161)
_BELOW = np.array([0.5 + 0.5 * erf(x / sqrt(2.0)) for x in _GRID])


def _below(x: Array) -> Array:
    """The normal distribution function."""
    return np.array(np.interp(x, _GRID, _BELOW))
