"""When FIRE goes down and comes up, and how that differs from what models would wish."""

from collections.abc import Sequence
from math import log

import numpy as np

from pigaming_app.ai.people.fit.differences import MIDDLE, MODELS, explained
from pigaming_app.ai.people.fit.wishes import Array, Watched
from pigaming_app.sim.world import HZ

BACK = (2, 6)  # ticks before a press or release
LONG = 10  # ticks for which FIRE is down that is held
FAR_EDGE = 40  # ticks after which a press or release has nothing to do with a model's


def holds(plays: Sequence[Watched]) -> dict[str, float]:
    """How long and how often FIRE is held."""
    held = np.concatenate([_holds(play.actions[:, 2]) for play in plays])
    minutes = sum(len(play.actions) for play in plays) / (60.0 * HZ)
    found = {"fires": log(1.0 + len(held) / minutes)}
    held = held if len(held) else np.array([10])
    found |= {"hold": log(np.minimum(held, 40).mean()), "hold_middle": log(np.median(held))}
    found |= {f"hold_{ticks}": float(np.mean(held <= ticks)) for ticks in (3, 5, 8, 12)}
    return found | {"hold_spread": float(np.log(held).std())}


def _holds(fire: Array) -> Array:
    """Ticks for which a button is held, each time."""
    steps = np.diff(np.concatenate([[0.0], fire, [0.0]]))
    return np.flatnonzero(steps < 0.0) - np.flatnonzero(steps > 0.0)


def _ends(play: Watched) -> tuple[Array, Array]:
    """Ticks at which FIRE comes up, and for how long it was held."""
    ends = np.flatnonzero(np.diff(np.append(play.actions[:, 2], 0.0)) < 0.0) + 1
    held = _holds(play.actions[:, 2])
    return ends[ends < len(play.actions)], held[ends < len(play.actions)]


def presses(plays: Sequence[Watched]) -> dict[str, float]:
    """How much the models would still turn when FIRE goes down, and whether they fire, too."""
    found: dict[str, float] = {}
    starts = [np.flatnonzero(np.diff(play.actions[:, 2]) > 0.0) + 1 for play in plays]
    starts = [ticks[ticks > 30] for ticks in starts]
    for back in BACK:
        found |= _turns(f"press{back}", _wished(plays, [ticks - back for ticks in starts]))
    fired = [_fired(play, ticks) for play, ticks in zip(plays, starts, strict=True)]
    shares = np.concatenate([*fired, np.zeros((1, MODELS))]).mean(axis=0)
    return found | {f"fired{i}": float(share) for i, share in enumerate(shares)}


def releases(plays: Sequence[Watched]) -> dict[str, float]:
    """How much the models would still turn when FIRE comes up after it was held."""
    found: dict[str, float] = {}
    ends = [ticks[held > LONG] for ticks, held in map(_ends, plays)]
    for back in BACK:
        found |= _turns(f"release{back}", _wished(plays, [ticks - back for ticks in ends]))
    return found


def _wished(plays: Sequence[Watched], ticks: Sequence[Array]) -> Array:
    """The turns that the models wished at these ticks of each match, (n, models)."""
    turns = [play.wishes[some, :MODELS, 1] for play, some in zip(plays, ticks, strict=True)]
    return np.concatenate(turns) if sum(map(len, turns)) > 4 else np.zeros((5, MODELS))


def edges(plays: Sequence[Watched]) -> dict[str, float]:
    """How long after models FIRE goes down, and comes up."""
    found: dict[str, float] = {}
    for name, sign in (("down", 1.0), ("up", -1.0)):
        lags = np.concatenate([_lags(play, sign) for play in plays])
        near = lags[lags < FAR_EDGE]
        found[f"{name}_near"] = len(near) / max(len(lags), 1)
        near = near if len(near) > 4 else np.full(5, 8.0)
        found[f"{name}_mean"], found[f"{name}_spread"] = log(near.mean() + 0.5), float(np.log(near + 0.5).std())
        found |= {f"{name}_{share}": log(np.quantile(near, share) + 0.5) for share in (0.25, 0.5, 0.75)}
    return found


def _lags(play: Watched, sign: float) -> Array:
    """Ticks from the last edge of any model's FIRE to each of the person's; FAR_EDGE: as long or longer."""
    steps = np.diff(play.wishes[:, :MODELS, 2], axis=0) * sign > 0.0
    wished = np.flatnonzero(steps.any(axis=1)) + 1
    made = np.flatnonzero(np.diff(play.actions[:, 2]) * sign > 0.0) + 1
    last = np.append(wished, -FAR_EDGE)[np.searchsorted(wished, made, side="right") - 1]
    lags: Array = np.minimum(made - last, FAR_EDGE)
    return lags


def _fired(play: Watched, ticks: Array) -> Array:
    """Whether each model wished to fire in the half second before each press."""
    wished = np.concatenate([np.zeros((1, MODELS)), np.cumsum(play.wishes[:, :MODELS, 2], axis=0)])
    fired: Array = wished[ticks] > wished[np.maximum(0, ticks - HZ // 2)]
    return fired


def _turns(name: str, turns: Array) -> dict[str, float]:
    sizes = np.minimum(np.abs(turns), 1.0).mean(axis=0)
    found = {f"{name}_{i}": float(size) for i, size in enumerate(sizes)}
    found[f"{name}_middle"] = log(np.median(np.abs(turns[:, MIDDLE])) + 0.01)
    return found | explained(name, turns, 0.95)
