"""Numbers that tell of a person's traits: how they press, and how that differs from what models would wish.

None of them knows the game: they compare inputs with the wishes of `wishes.ASKED`, whose models differ in one trait
each. What they say of a trait is calibrated by matches of known people (`calibration`).
"""

from collections.abc import Iterator, Sequence
from math import log, pi

import numpy as np

from pigaming_app.ai.people.fit import fire
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
from pigaming_app.ai.people.fit.intervals import Lapses, lapses_of, period_of
from pigaming_app.ai.people.fit.wishes import Array, Watched
from pigaming_app.ai.people.hands import PRESSED, STILL, TAP
from pigaming_app.sim.world import HZ

TURN_PERIOD = 1.0 / 6.0  # s for which a wish turns at least, as the hands take it
CLEAR = 5.0  # ticks of a tap that is worth a press beyond doubt
LATE = (10, 25, 50, 90)  # ticks after a decision was due
LAGS = (5, 10, 15, 20, 25, 30, 40, 50)  # ticks
MATCH_MINUTE = 60.0 * HZ


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
    found |= fire.presses(plays) | fire.releases(plays) | fire.edges(plays)
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
    if pointing:
        return _named("", lapses_of(_stick_times(hands), np.array([], int), period, -3.0))
    found: dict[str, float] = {}
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
