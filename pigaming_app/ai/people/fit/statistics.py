"""Numbers that tell of a person's traits: how they press, and how that differs from what models would wish.

None of them knows the game: they compare inputs with the wishes of `wishes.ASKED`, whose models differ in one trait
each. What they say of a trait is calibrated by matches of known people (`calibration`).
"""

from collections.abc import Iterator, Sequence
from math import log, pi

import numpy as np

from pigaming_app.ai.people.fit.inputs import HandInputs, key_inputs, pointing_inputs
from pigaming_app.ai.people.fit.intervals import Lapses, lapses_of, period_of
from pigaming_app.ai.people.fit.wishes import ASKED, Array, Watched
from pigaming_app.ai.people.hands import PRESSED, STILL, TAP
from pigaming_app.sim.world import HZ

MIDDLE, FASTEST, SLOWEST, AHEAD_NOT, AHEAD = 1, 0, 3, 4, 5  # of ASKED
TURN_PERIOD = 1.0 / 6.0  # s for which a wish turns at least, as the hands take it
CLEAR = 5.0  # ticks of a tap that is worth a press beyond doubt
LATE = (10, 25, 50, 90)  # ticks after a decision was due
BACK = (2, 6)  # ticks before a press
LAGS = (5, 10, 15, 20, 25, 30, 40, 50)  # ticks
MATCH_MINUTE = 60.0 * HZ


def statistics(plays: Sequence[Watched], pointing: bool) -> dict[str, float]:
    """The numbers of a person who points with a stick or steers with keys, over all their matches."""
    hands = [(pointing_inputs if pointing else key_inputs)(play) for play in plays]
    period = _period(hands, pointing)
    found = {"period": log(period)}
    found |= _attention(plays, hands, period, pointing)
    found |= _fire(plays)
    found |= _differences(
        np.concatenate([_differing(*pair, period, pointing) for pair in zip(plays, hands, strict=True)])
    )
    found |= _presses(plays)
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
    for asking in (len(ASKED), len(ASKED) - 2):
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
    linear, turning = play.actions[:, 0][:, None], play.actions[:, 1][:, None] != 0.0
    wanted = np.where(np.abs(play.wishes[:, :, 0]) > PRESSED, np.sign(play.wishes[:, :, 0]), 0.0)
    asking: Array = (wanted != linear) | (~turning & (np.abs(play.wishes[:, :, 1]) * TAP >= CLEAR))
    return np.array(asking.sum(axis=1))


# ---------------------------------------------------------------------------------------------------------------- FIRE


def _fire(plays: Sequence[Watched]) -> dict[str, float]:
    """How long and how often FIRE is held."""
    held = np.concatenate([_holds(play.actions[:, 2]) for play in plays])
    minutes = sum(len(play.actions) for play in plays) / MATCH_MINUTE
    found = {"fires": log(1.0 + len(held) / minutes)}
    held = held if len(held) else np.array([10])
    found |= {"hold": log(np.minimum(held, 40).mean()), "hold_middle": log(np.median(held))}
    found |= {f"hold_{ticks}": float(np.mean(held <= ticks)) for ticks in (3, 5, 8, 12)}
    return found | {"hold_spread": float(np.log(held).std())}


def _holds(fire: Array) -> Array:
    """Ticks for which a button is held, each time."""
    edges = np.diff(np.concatenate([[0.0], fire, [0.0]]))
    return np.flatnonzero(edges < 0.0) - np.flatnonzero(edges > 0.0)


def _presses(plays: Sequence[Watched]) -> dict[str, float]:
    """How much the models would still turn when FIRE goes down, and whether they fire, too."""
    found: dict[str, float] = {}
    starts = [np.flatnonzero(np.diff(play.actions[:, 2]) > 0.0) + 1 for play in plays]
    starts = [ticks[ticks > 30] for ticks in starts]
    for back in BACK:
        turns = np.concatenate([play.wishes[ticks - back, :, 1] for play, ticks in zip(plays, starts, strict=True)])
        found |= _turns(f"press{back}", turns if len(turns) > 4 else np.zeros((5, len(ASKED))))
    fired = [_fired(play, ticks) for play, ticks in zip(plays, starts, strict=True)]
    shares = np.concatenate([*fired, np.zeros((1, len(ASKED)))]).mean(axis=0)
    return found | {f"fired{i}": float(share) for i, share in enumerate(shares)}


def _fired(play: Watched, ticks: Array) -> Array:
    """Whether each model wished to fire in the half second before each press."""
    wished = np.concatenate([np.zeros((1, len(ASKED))), np.cumsum(play.wishes[:, :, 2], axis=0)])
    fired: Array = wished[ticks] > wished[np.maximum(0, ticks - HZ // 2)]
    return fired


def _turns(name: str, turns: Array) -> dict[str, float]:
    sizes = np.minimum(np.abs(turns), 1.0).mean(axis=0)
    found = {f"{name}_{i}": float(size) for i, size in enumerate(sizes)}
    found[f"{name}_middle"] = log(np.median(np.abs(turns[:, MIDDLE])) + 0.01)
    return found | _explained(name, turns, 0.95)


# --------------------------------------------------------------------------------------------------------- differences


def _differing(play: Watched, hand: HandInputs, period: float, pointing: bool) -> Array:
    """What a decision pressed less what each model would have, (n, models): rad, or with keys turns of the stick."""
    if pointing:
        return _turned(hand.values[:, None] - _ways(play, hand.shown, period))
    short = np.abs(hand.values) < TAP
    return hand.values[short, None] / TAP - play.wishes[hand.shown[short], :, 1]


def _ways(play: Watched, ticks: Array, period: float) -> Array:
    """Direction in which hands without error would push the stick, as in `hands.point`; NaN: they would not."""
    linear, angular = play.wishes[ticks, :, 0], play.wishes[ticks, :, 1]
    off = angular * play.turn_rate * max(period / HZ, TURN_PERIOD)
    off = np.where((np.abs(linear) < PRESSED) & (np.abs(angular) >= 1.0), 0.5 * pi * angular, off)
    off = np.clip(off, -0.5 * pi, 0.5 * pi)
    ways = play.poses[ticks, :1] + np.where(linear < -PRESSED, pi - off, off)
    return np.where((np.abs(linear) < STILL) & (np.abs(angular) < STILL), np.nan, ways)


def _differences(off: Array) -> dict[str, float]:
    """Their sizes, and which traits explain them."""
    found: dict[str, float] = {}
    sizes = np.abs(off)
    for i in range(len(ASKED)):
        found[f"off{i}"] = _mean(np.minimum(sizes[:, i], 1.0))
        found[f"low{i}"] = log(_quantile(sizes[:, i], 0.35) + 0.01)
    for share in (0.2, 0.6):
        found[f"off_{share}"] = log(_quantile(sizes[:, MIDDLE], share) + 0.01)
    apart = _turned(off - off[:, MIDDLE : MIDDLE + 1])
    agreed = np.max(np.abs(np.nan_to_num(apart, nan=9.0)), axis=1) < 0.05
    for name, part in (("agreed", sizes[agreed, MIDDLE]), ("apart", sizes[~agreed, MIDDLE])):
        found |= {f"{name}_{q}": log(_quantile(part, q) + 0.01) for q in (0.25, 0.5)}
        found[name] = log(_mean(np.minimum(part, 0.8)) + 0.01)
    return found | _explained("off", off, 1.0)


def _explained(name: str, off: Array, limit: float) -> dict[str, float]:
    """By which parts of a later reaction and of a prediction the middle model would be nearer; what then remains.

    Least squares over all rows within `limit`.
    """
    causes = np.stack([_turned(off[:, SLOWEST] - off[:, FASTEST]), _turned(off[:, AHEAD] - off[:, AHEAD_NOT])], axis=1)
    rest = off[:, MIDDLE]
    with np.errstate(invalid="ignore"):
        good = (np.abs(rest) < limit) & (np.abs(causes) < limit).all(axis=1)
    causes, rest = causes[good], rest[good]
    parts = np.linalg.solve(causes.T @ causes + 0.05 * np.eye(2), causes.T @ rest)
    rest = np.abs(rest - causes @ parts)
    found = {f"{name}_late": float(parts[0]), f"{name}_ahead": float(parts[1]), f"{name}_rest": log(_mean(rest) + 0.01)}
    for i, cause in enumerate(("late", "ahead")):
        found[f"{name}_rest_{cause}"] = log(_mean(rest[np.abs(causes[:, i]) > 0.05]) + 0.01)
    return found


# -------------------------------------------------------------------------------------------------------------- habits


def _habits(plays: Sequence[Watched]) -> dict[str, float]:
    """How often the robot is driven ahead, back, and turned, and how much like the models."""
    actions, wishes = np.concatenate([play.actions for play in plays]), np.concatenate([play.wishes for play in plays])
    linear, angular = actions[:, 0], actions[:, 1]
    found = {"turbo": log(actions[:, 3].mean() + 0.003)}
    found |= {"ahead": float(np.mean(linear > 0.3)), "back": float(np.mean(linear < -0.3))}
    found |= {"slow": float(np.mean((linear > 0.1) & (linear < 0.6)))}
    found |= {"full_turn": float(np.mean(np.abs(angular) > 0.99)), "no_turn": float(np.mean(np.abs(angular) < 0.02))}
    driven = _signs(linear)[:, None] != _signs(wishes[:, :, 0])
    found |= {f"driven{i}": float(share) for i, share in enumerate(driven.mean(axis=0))}
    return found | dict(_followed(angular, np.clip(wishes[:, FASTEST, 1], -1.0, 1.0)))


def _followed(turns: Array, wished: Array) -> Iterator[tuple[str, float]]:
    """How much turns follow a wish, by the time between them."""
    size = np.mean(np.abs(turns)) * np.mean(np.abs(wished)) + 1e-9
    for lag in LAGS:
        yield f"lag{lag}", float(np.mean(turns[lag:] * wished[:-lag]) / size)


def _signs(values: Array) -> Array:
    return np.where(np.abs(values) > 0.2, np.sign(values), 0.0)


def _turned(angles: Array) -> Array:
    return (angles + pi) % (2.0 * pi) - pi


def _mean(values: Array, otherwise: float = 0.3) -> float:
    values = values[np.isfinite(values)]
    return float(values.mean()) if len(values) > 4 else otherwise


def _quantile(values: Array, share: float, otherwise: float = 0.3) -> float:
    values = values[np.isfinite(values)]
    return float(np.quantile(values, share)) if len(values) > 4 else otherwise
