"""Numbers that tell of a person's traits: how they press, and how that differs from what models would wish.

None of them knows the game: they compare inputs with the wishes of `wishes.ASKED`, whose models differ in one trait
each. What they say of a trait is calibrated by matches of known people (`calibration`).
"""

from collections.abc import Callable, Iterator, Sequence
from math import log, pi
from typing import NamedTuple

import numpy as np

from pigaming_app.ai.people.fit import fire
from pigaming_app.ai.people.fit.aiming import aims
from pigaming_app.ai.people.fit.attention import NUMBERS, attention_of, pauses_of
from pigaming_app.ai.people.fit.differences import (
    FASTEST,
    MODELS,
    REACTIONS,
    differences,
    nearest,
    turned,
    while_holding,
)
from pigaming_app.ai.people.fit.fire import LONG
from pigaming_app.ai.people.fit.inputs import HandInputs, key_inputs, pointing_inputs
from pigaming_app.ai.people.fit.wishes import Array, Watched
from pigaming_app.ai.people.hands import PRESSED, STILL, TAP
from pigaming_app.sim.world import HZ

TURN_PERIOD = 1.0 / 6.0  # s for which a wish turns at least, as the hands take it
CLEAR = 5.0  # ticks of a tap that is worth a press beyond doubt
LATE = (10, 25, 50, 90)  # ticks after a decision was due
LAGS = (5, 10, 15, 20, 25, 30, 40, 50)  # ticks
MATCH_MINUTE = 60.0 * HZ
LONGEST = 300  # ticks; longer times count as these
ROUNDS = 90  # of the search
FLOOR = 1e-5  # probability of a time that the model excludes


class Lapses(NamedTuple):
    """Logarithms of the odds per tick and of the mean length in ticks; log-odds of a decision that shows nothing."""

    odds: float
    length: float
    unseen: float


def period_of(times: Array, unseen: float) -> float:
    """The mean period. `unseen`: log-odds of an invisible decision from which the search begins."""
    counts = _counts(times)

    def cost(x: Array) -> float:
        return -float(counts @ np.log(density(np.exp(x[0]), Lapses(x[1], x[2], x[3])) + FLOOR))

    first = [np.array([np.log(period), np.log(0.001), np.log(40.0), unseen]) for period in np.geomspace(7.0, 45.0, 40)]
    return float(np.exp(searched(cost, min(first, key=cost), (0.05, 0.7, 0.5, 0.7))[0]))


def lapses_of(times: Array, cut: Array, period: float, unseen: float) -> Lapses:
    """The lapses of somebody with this period. `cut`: times after which nothing more is known."""
    counts, ended = _counts(times), _counts(cut)

    def cost(x: Array) -> float:
        chances = density(period, Lapses(*x))
        later = np.clip(1.0 - np.cumsum(chances), FLOOR, 1.0)
        return -float(counts @ np.log(chances + FLOOR) + ended @ np.log(later))

    starts = [np.array([np.log(odds), np.log(length), unseen]) for odds, length in ((0.001, 40.0), (0.002, 20.0))]
    found = [searched(cost, start, (0.7, 0.5, 0.7)) for start in starts]
    return Lapses(*min(found, key=cost))


def density(period: float, lapses: Lapses) -> Array:
    """Chance of each time between two visible decisions, from 0 to LONGEST - 1."""
    if not 4.0 < period < 70.0 or lapses.odds > -1.6 or not 0.0 < lapses.length < 5.3:
        return np.zeros(LONGEST)
    ticks = np.arange(LONGEST)
    free = np.clip(np.minimum(ticks, 1.3 * period) - np.maximum(ticks - 1, 0.7 * period), 0.0, None) / (0.6 * period)
    away = np.clip(np.minimum(ticks, 2.0 * np.exp(lapses.length) + 1.0) - np.maximum(ticks - 1, 0), 0.0, 1.0)
    rate = np.exp(lapses.odds) * period
    once = _after(free, away / away.sum())
    known = np.exp(-rate) * (free + rate * once + 0.5 * rate**2 * _after(once, away / away.sum()))
    unseen = 1.0 / (1.0 + np.exp(-lapses.unseen))
    total, several = np.array(known), known
    for _ in range(6 if unseen > 0.1 else 2):
        several = unseen * _after(several, known)
        total += several
    return np.array((1.0 - unseen) * total)


def searched(cost: Callable[[Array], float], start: Array, steps: tuple[float, ...], rounds: int = ROUNDS) -> Array:
    """The minimum near `start`, by the simplex method of Nelder and Mead (The Computer Journal 7, 1965)."""
    points = [start, *(start + step * row for step, row in zip(steps, np.eye(len(start)), strict=True))]
    costs = [cost(point) for point in points]
    for _ in range(rounds):
        order = np.argsort(costs)
        points, costs = [points[i] for i in order], [costs[i] for i in order]
        middle = np.mean(points[:-1], axis=0)
        tried = [middle + reach * (middle - points[-1]) for reach in (1.0, 2.0, -0.5)]
        beyond = cost(tried[0])
        if beyond < costs[0]:
            far = cost(tried[1])
            points[-1], costs[-1] = (tried[1], far) if far < beyond else (tried[0], beyond)
        elif beyond < costs[-2]:
            points[-1], costs[-1] = tried[0], beyond
        elif (inside := cost(tried[2])) < costs[-1]:
            points[-1], costs[-1] = tried[2], inside
        else:
            points = [points[0], *(0.5 * (points[0] + point) for point in points[1:])]
            costs = [costs[0], *(cost(point) for point in points[1:])]
    return points[int(np.argmin(costs))]


def _after(first: Array, second: Array) -> Array:
    return np.convolve(first, second)[:LONGEST]


def _counts(times: Array) -> Array:
    return np.bincount(np.minimum(times, LONGEST - 1), minlength=LONGEST).astype(float)


def statistics(plays: Sequence[Watched], pointing: bool) -> dict[str, float]:
    """The numbers of a person who points with a stick or steers with keys, over all their matches."""
    hands = [(pointing_inputs if pointing else key_inputs)(play) for play in plays]
    period = _period(hands, pointing)
    found = {"period": log(period)}
    found |= _attention(plays, hands, period, pointing)
    found |= fire.holds(plays)
    shown = [_differing(*pair, period, pointing) for pair in zip(plays, hands, strict=True)]
    off, holding = (np.concatenate(parts) for parts in zip(*shown, strict=True))
    found |= differences(off[:, :MODELS]) | while_holding(off[holding, :MODELS]) | dict(nearest(off[:, REACTIONS]))
    found |= fire.presses(plays) | fire.releases(plays) | fire.edges(plays) | aims(plays)
    found |= _habits(plays)
    return found


def _period(hands: Sequence[HandInputs], pointing: bool) -> float:
    if pointing:
        return period_of(_stick_times(hands), -3.0)
    return period_of(np.concatenate([np.diff(hand.decisions) for hand in hands]), 0.0)


def _stick_times(hands: Sequence[HandInputs]) -> Array:
    """Times between decisions, except those in which the stick rested."""
    return np.concatenate([np.diff(hand.decisions)[~hand.ends[:-1]] for hand in hands])


# ----------------------------------------------------------------------------------------------------------- attention


def _attention(
    plays: Sequence[Watched], hands: Sequence[HandInputs], period: float, pointing: bool
) -> dict[str, float]:
    numbers, errors = attention_of(pauses_of(plays, hands, pointing), period)
    found = {f"attention_{name}": float(number) for name, number in zip(NUMBERS, numbers, strict=True)}
    found |= {f"attention_{name}_error": float(error) for name, error in zip(NUMBERS[:2], errors[:2], strict=True)}
    if pointing:
        return found | _named("", lapses_of(_stick_times(hands), np.array([], int), period, -3.0))
    for asking in (MODELS, MODELS - 2):
        spans = [_spans(play, hand.decisions, period, asking) for play, hand in zip(plays, hands, strict=True)]
        times, cut = (np.concatenate(parts) for parts in zip(*spans, strict=True))
        found |= _named(str(asking), lapses_of(times, cut, period, -2.0))
        minutes = sum(len(play.actions) for play in plays) / MATCH_MINUTE
        for late in LATE:
            count = np.sum(times > 1.3 * period + late) + np.sum(cut > 1.3 * period + late)
            found[f"late{asking}_{late}"] = log((count + 0.5) / minutes)
    return found


def _named(which: str, lapses: Lapses) -> dict[str, float]:
    return {f"{name}{which}": value for name, value in lapses._asdict().items()}


def _spans(play: Watched, decisions: Array, period: float, asking: int) -> tuple[Array, Array]:
    """Times until the next decision, and times until fewer models than `asking` ask for another key, if that is sooner.

    What happens before a decision is due does not matter.
    """
    content = np.append(np.flatnonzero(_asking(play) < asking), len(play.actions))
    due = decisions[:-1] + int(np.ceil(0.7 * period))
    lost, after = content[np.searchsorted(content, due)], decisions[1:]
    seen = (after <= due) | (lost >= after)
    return (after - decisions[:-1])[seen], (lost - decisions[:-1])[~seen]


def _asking(play: Watched) -> Array:
    """Of each tick, how many models ask for another key than the one that is down."""
    wishes = play.wishes[:, :MODELS]
    linear, turning = play.actions[:, 0][:, None], play.actions[:, 1][:, None] != 0.0
    wanted = np.where(np.abs(wishes[:, :, 0]) > PRESSED, np.sign(wishes[:, :, 0]), 0.0)
    asking: Array = (wanted != linear) | (~turning & (np.abs(wishes[:, :, 1]) * TAP >= CLEAR))
    return np.array(asking.sum(axis=1))


# --------------------------------------------------------------------------------------------------------- differences


def _differing(play: Watched, hand: HandInputs, period: float, pointing: bool) -> tuple[Array, Array]:
    """What a decision pressed less what each model would have, (n, models): rad, or with keys turns of the stick.

    And whether FIRE was held.
    """
    held = np.cumsum(np.append(0.0, play.actions[:, 2]))
    holding = held[1:] - held[np.maximum(0, np.arange(len(play.actions)) - LONG)] >= LONG
    if pointing:
        return turned(hand.values[:, None] - _ways(play, hand.shown, period)), holding[hand.shown]
    short = np.abs(hand.values) < TAP
    shown = hand.shown[short]
    return hand.values[short, None] / TAP - play.wishes[shown, :, 1], holding[shown]


def _ways(play: Watched, ticks: Array, period: float) -> Array:
    """Direction in which hands without error would push the stick, as in `hands.point`; NaN: they would not."""
    linear, angular = play.wishes[ticks, :, 0], play.wishes[ticks, :, 1]
    off = angular * play.turn_rate * max(period / HZ, TURN_PERIOD)
    off = np.where((np.abs(linear) < PRESSED) & (np.abs(angular) >= 1.0), 0.5 * pi * angular, off)
    off = np.clip(off, -0.5 * pi, 0.5 * pi)
    ways = play.poses[ticks, :1] + np.where(linear < -PRESSED, pi - off, off)
    return np.where((np.abs(linear) < STILL) & (np.abs(angular) < STILL), np.nan, ways)


# -------------------------------------------------------------------------------------------------------------- habits


def _habits(plays: Sequence[Watched]) -> dict[str, float]:
    """How often the robot is driven ahead, back, and turned, and how much like the models."""
    actions, wishes = np.concatenate([play.actions for play in plays]), np.concatenate([play.wishes for play in plays])
    linear, angular = actions[:, 0], actions[:, 1]
    found = {"turbo": log(actions[:, 3].mean() + 0.003)}
    found |= {"ahead": float(np.mean(linear > 0.3)), "back": float(np.mean(linear < -0.3))}
    found |= {"slow": float(np.mean((linear > 0.1) & (linear < 0.6)))}
    found |= {"full_turn": float(np.mean(np.abs(angular) > 0.99)), "no_turn": float(np.mean(np.abs(angular) < 0.02))}
    driven = _signs(linear)[:, None] != _signs(wishes[:, :MODELS, 0])
    found |= {f"driven{i}": float(share) for i, share in enumerate(driven.mean(axis=0))}
    return found | dict(_followed(angular, np.clip(wishes[:, FASTEST, 1], -1.0, 1.0)))


def _followed(turns: Array, wished: Array) -> Iterator[tuple[str, float]]:
    """How much turns follow a wish, by the time between them."""
    size = np.mean(np.abs(turns)) * np.mean(np.abs(wished)) + 1e-9
    for lag in LAGS:
        yield f"lag{lag}", float(np.mean(turns[lag:] * wished[:-lag]) / size)


def _signs(values: Array) -> Array:
    return np.where(np.abs(values) > 0.2, np.sign(values), 0.0)
