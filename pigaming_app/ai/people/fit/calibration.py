"""From statistics to traits: a regression over matches of known people, with its error by minutes of play.

After P. Fearnhead and D. Prangle, "Constructing summary statistics for approximate Bayesian computation", Journal of
the Royal Statistical Society B 74, 2012: of all statistics, the regression of a parameter on many tells most of it.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from math import exp, log, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np

from pigaming_app import ASSETS
from pigaming_app.ai.brain.kind import NUMBERS, Traits
from pigaming_app.ai.people.fit.wishes import Array
from pigaming_app.storage.parsing import read
from pigaming_app.storage.schema import from_json

SHARES = ("prediction", "tactics")  # traits from 0 to 1; all others count by their logarithms
FITTED = tuple(name for name in NUMBERS if name != "spread")
FAR = 3.0  # standard deviations beyond which a statistic tells no more
PENALTIES = tuple(0.1 * 3.0**i for i in range(10))  # of a regression, one of which is chosen for each trait
SHARPNESS = (0.0, 1.0, 2.0, 4.0, 8.0)  # with which a regression prefers what correlates with a trait; also chosen
FOLDS, LEAST = 6, 0.02  # parts of the people, each left out once for that choice; correlations count as this at least
POOR, POOR_SHARE = 0.25, 0.2  # errors, in logarithms and of shares, beyond which a trait is not told
SURE = 1.96  # standard deviations, for 95 %
MAX_BYTES = 1_000_000


class FittedTrait(NamedTuple):
    """A trait, and its interval of 95 %."""

    value: float
    low: float
    high: float


def estimate(trait: str, raw: float, error: float) -> FittedTrait:
    """The trait of a logarithm or share and its standard deviation."""
    return FittedTrait(*(plain(trait, raw + step * SURE * error) for step in (0.0, -1.0, 1.0)))


def plain(trait: str, raw: float) -> float:
    """The trait itself."""
    return min(1.0, max(0.0, raw)) if trait in SHARES else exp(raw)


def raw_of(trait: str, value: float) -> float:
    """Logarithm or share of a trait."""
    return value if trait in SHARES else log(value)


def is_told(trait: str, error: float) -> bool:
    """True if an error, as a standard deviation of `raw_of`, is small enough to tell a trait."""
    return error <= (POOR_SHARE if trait in SHARES else POOR)


@dataclass(frozen=True)
class TraitCalibration:
    """How a trait follows from the statistics. `errors`: standard deviations, by the minutes of `FitCalibration`.

    `guess`: weights of the statistics for a first guess of every trait, in standard deviations; the trait is the sum of
    `base`, the statistics by `weights`, and the products of all pairs of guesses by `mixed`.
    """

    base: float
    guess: tuple[float, ...]
    weights: tuple[float, ...]
    mixed: tuple[float, ...]
    errors: tuple[float, ...] = ()


@dataclass(frozen=True)
class FitCalibration:
    """Of one game and driving style. `minutes`: of play after which the errors were measured."""

    names: tuple[str, ...]
    means: tuple[float, ...]
    deviations: tuple[float, ...]
    minutes: tuple[float, ...]
    traits: Mapping[str, TraitCalibration]

    def raw(self, found: Mapping[str, float]) -> dict[str, float]:
        """Logarithms or shares of all traits."""
        row = _standard([found[name] for name in self.names], self.means, self.deviations)
        guesses = [float(row @ np.array(one.guess)) for one in self.traits.values()]
        terms = np.concatenate([row, _products(np.array([guesses]))[0]])
        return {name: one.base + float(terms @ np.array(one.weights + one.mixed)) for name, one in self.traits.items()}

    def shows(self, trait: str) -> bool:
        """True if long play of one person tells a trait; else the mean of many is only that of the regression."""
        return is_told(trait, min(self.traits[trait].errors))

    def error(self, trait: str, minutes: float) -> float:
        """Standard deviation of a logarithm or a share after so many minutes of play."""
        errors: tuple[float, ...] = self.traits[trait].errors
        if minutes <= self.minutes[0]:
            return errors[0] * sqrt(self.minutes[0] / max(minutes, 0.01))
        return float(np.interp(minutes, self.minutes, errors))


def file_of(game: str, driving: str) -> Path:
    """The file of a calibration that comes with PiGaming."""
    return ASSETS / "people" / f"{game}_{driving}.json"


@cache
def calibration(game: str, driving: str) -> FitCalibration | None:
    """That of a game and driving style, if there is one."""
    file = file_of(game, driving)
    return from_json(read(file, MAX_BYTES), FitCalibration) if file.exists() else None


Sample = tuple[Traits, Mapping[str, float]]  # a known person, and the statistics of their play


def calibrated(samples: Sequence[Sample], tested: Mapping[float, Sequence[Sample]]) -> FitCalibration:
    """By two ridge regressions over `samples`. `tested`: others, by the minutes of their play."""
    names, people = tuple(samples[0][1]), [person for person, _ in samples]
    table = np.array([[found[name] for name in names] for _, found in samples])
    usual = _without_outliers(table)
    means, deviations = usual.mean(axis=0), usual.std(axis=0) + 1e-6
    fitted = [name for name in FITTED if any(getattr(person, name) > 0.0 for person in people)]  # keys have no noise
    raws = np.array([[raw_of(name, getattr(person, name)) for name in fitted] for person in people])
    traits = dict(zip(fitted, _regressions(_standard(table, means, deviations), raws), strict=True))
    known = FitCalibration(names, _shortened(means), _shortened(deviations), _shortened(tested), traits)
    return replace(known, traits={trait: _with_errors(known, trait, tested) for trait in traits})


def _without_outliers(table: Array) -> Array:
    """The columns, within FAR standard deviations as their middle two thirds tell them."""
    low, middle, high = np.quantile(table, (1.0 / 6.0, 0.5, 5.0 / 6.0), axis=0)
    reach = np.where(high > low, FAR * 0.5 * (high - low), np.inf)
    return np.array(np.clip(table, middle - reach, middle + reach))


def _regressions(rows: Array, raws: Array) -> Iterator[TraitCalibration]:
    """Of each column of `raws` (people, traits) on the statistics (people, n), and on products of first guesses."""
    base, spread, count = raws.mean(axis=0), raws.std(axis=0), rows.shape[1]
    guess, without = preferring(rows, (raws - base) / spread)
    products = _products(without)
    weights, _ = preferring(np.concatenate([rows, products - products.mean(axis=0)], axis=1), raws - base)
    base = base - products.mean(axis=0) @ weights[count:]
    for i, own in enumerate(weights.T):
        yield TraitCalibration(
            _short(base[i]), _shortened(guess[:, i]), _shortened(own[:count]), _shortened(own[count:])
        )


def preferring(rows: Array, values: Array) -> tuple[Array, Array]:
    """As `ridge`, with a lower penalty on what correlates with a value, as far as that predicts people left out."""
    part = np.arange(len(rows)) % FOLDS

    def scaled(kept: Array, column: Array, sharpness: float) -> tuple[Array, Array]:
        """Weights, and the values of `kept` by all others."""
        some, known = rows[kept], column[kept]
        sizes = np.linalg.norm(some, axis=0) * np.linalg.norm(known) + 1e-9
        scale = np.maximum(np.abs(known @ some) / sizes, LEAST) ** sharpness
        scale /= np.sqrt(np.mean(scale**2))
        weights, others = ridge(some * scale, known[:, None])
        return scale * weights[:, 0], others[:, 0]

    def error(column: Array, sharpness: float) -> float:
        """Of the people who are left out, in all."""
        off = [rows[part == i] @ scaled(part != i, column, sharpness)[0] - column[part == i] for i in range(FOLDS)]
        return float(sum(np.square(one).sum() for one in off))

    best = [min(SHARPNESS, key=lambda sharpness: error(column, sharpness)) for column in values.T]
    every = np.full(len(rows), True)
    found = [scaled(every, column, sharpness) for column, sharpness in zip(values.T, best, strict=True)]
    weights, others = (np.stack(parts, axis=1) for parts in zip(*found, strict=True))
    return weights, others


def ridge(rows: Array, values: Array) -> tuple[Array, Array]:
    """Weights (k, m) of a regression of the values (n, m) on the rows (n, k), and each value by all other rows (n, m).

    Of PENALTIES each column has the one with the least error of its values by all other rows (D. M. Allen, "The
    relationship between variable selection and data augmentation", Technometrics 16, 1974).
    """
    left, sizes, right = np.linalg.svd(rows, full_matrices=False)
    found = []
    for penalty in PENALTIES:
        kept = sizes**2 / (sizes**2 + penalty)
        off = (values - left @ (kept[:, None] * (left.T @ values))) / (1.0 - (left**2 @ kept))[:, None]
        weights = right.T @ ((sizes / (sizes**2 + penalty))[:, None] * (left.T @ values))
        found.append((off, weights))
    best = [int(np.argmin([np.square(off[:, i]).sum() for off, _ in found])) for i in range(values.shape[1])]
    weights, off = (np.stack([found[k][part][:, i] for i, k in enumerate(best)], axis=1) for part in (1, 0))
    return weights, values - off


def _products(guesses: Array) -> Array:
    """Of all pairs of columns, squares among them."""
    first, second = np.triu_indices(guesses.shape[1])
    return np.array(guesses[:, first] * guesses[:, second])


def _with_errors(known: FitCalibration, trait: str, tested: Mapping[float, Sequence[Sample]]) -> TraitCalibration:
    errors = []
    for samples in tested.values():
        off = [known.raw(found)[trait] - raw_of(trait, getattr(person, trait)) for person, found in samples]
        errors.append(_short(np.sqrt(np.mean(np.square(off)))))
    return replace(known.traits[trait], errors=tuple(errors))


def _standard(rows: object, means: object, deviations: object) -> Array:
    far: Array = np.clip((np.asarray(rows) - np.asarray(means)) / np.asarray(deviations), -FAR, FAR)
    return far


def _short(number: float) -> float:
    """With five digits, as the file has it."""
    return float(f"{number:.5g}")


def _shortened(numbers: Iterable[float]) -> tuple[float, ...]:
    return tuple(map(_short, numbers))
