"""How inputs differ from the wishes of models, and which traits of the models explain it."""

from collections.abc import Iterator
from math import log, pi

import numpy as np

from pigaming_app.ai.people.fit.wishes import ASKED, Array

MIDDLE, FASTEST, SLOWEST, AHEAD_NOT, AHEAD = 1, 0, 3, 4, 5  # of ASKED
MODELS = 8  # of ASKED, without those of finer reactions
REACTIONS = (0, 8, 1, 9, 10, 2, 11, 3)  # of ASKED, by their reaction
SHARPNESS = (30.0, 100.0)  # of the choice of the nearest reaction


def differences(off: Array) -> dict[str, float]:
    """Their sizes, and which traits explain them."""
    found: dict[str, float] = {}
    sizes = np.abs(off)
    for i in range(MODELS):
        found[f"off{i}"] = _mean(np.minimum(sizes[:, i], 1.0))
        found[f"low{i}"] = log(_quantile(sizes[:, i], 0.35) + 0.01)
    for share in (0.2, 0.6):
        found[f"off_{share}"] = log(_quantile(sizes[:, MIDDLE], share) + 0.01)
    apart = turned(off - off[:, MIDDLE : MIDDLE + 1])
    agreed = np.max(np.abs(np.nan_to_num(apart, nan=9.0)), axis=1) < 0.05
    for name, part in (("agreed", sizes[agreed, MIDDLE]), ("apart", sizes[~agreed, MIDDLE])):
        found |= {f"{name}_{q}": log(_quantile(part, q) + 0.01) for q in (0.25, 0.5)}
        found[name] = log(_mean(np.minimum(part, 0.8)) + 0.01)
    return found | explained("off", off, 1.0)


def while_holding(off: Array) -> dict[str, float]:
    """Sizes of the differences while FIRE is held."""
    sizes = np.abs(off)
    found = {f"holding{i}": log(_mean(np.minimum(sizes[:, i], 1.0)) + 0.01) for i in range(MODELS)}
    return found | {f"holding_{q}": log(_quantile(sizes[:, MIDDLE], q) + 0.01) for q in (0.25, 0.5, 0.75)}


def nearest(off: Array) -> Iterator[tuple[str, float]]:
    """Sizes of the differences from each reaction where they matter, less their mean; the reaction that is nearest."""
    sizes = np.minimum(np.abs(np.nan_to_num(off, nan=9.0)), 0.6)
    sizes = np.concatenate([sizes[np.ptp(sizes, axis=1) > 0.1], np.full((20, len(REACTIONS)), 0.3)]).mean(axis=0)
    sizes = sizes - sizes.mean()
    reactions = np.log([ASKED[i].reaction for i in REACTIONS])
    yield from ((f"near{i}", float(size)) for i, size in enumerate(sizes))
    for sharp in SHARPNESS:
        weights = np.exp(-sharp * sizes)
        yield f"nearest{sharp:g}", float(weights @ reactions / weights.sum())


def explained(name: str, off: Array, limit: float) -> dict[str, float]:
    """By which parts of a later reaction and of a prediction the middle model would be nearer; what then remains.

    Least squares over all rows within `limit`.
    """
    causes = np.stack([turned(off[:, SLOWEST] - off[:, FASTEST]), turned(off[:, AHEAD] - off[:, AHEAD_NOT])], axis=1)
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


def turned(angles: Array) -> Array:
    return (angles + pi) % (2.0 * pi) - pi


def _mean(values: Array, otherwise: float = 0.3) -> float:
    values = values[np.isfinite(values)]
    return float(values.mean()) if len(values) > 4 else otherwise


def _quantile(values: Array, share: float, otherwise: float = 0.3) -> float:
    values = values[np.isfinite(values)]
    return float(np.quantile(values, share)) if len(values) > 4 else otherwise
