"""Tie-breaks after the FIDE Handbook, C.07 (Tie-break regulations, from 1 August 2024).

Two things are simpler: a round without an opponent counts as one against somebody with the own points, without a limit,
and the unplayed rounds of opponents are not adjusted.

Every function takes the table of all matches and the entrants who are still level, and returns a value of each of them:
more is better. A match of three or four counts as one of two against the mean of the opponents; head to head, as one
against each of them.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations

from pigaming_app.events.formats.scoring import exact

Values = dict[str, float]


@dataclass(frozen=True)
class CountedMatch:
    """A match as it counts: points of each entrant, and all who take part."""

    points: Mapping[str, float]
    first: str = ""  # who won alone


@dataclass(frozen=True)
class Table:
    """All matches that count, and the sum of the points of everybody, with those of byes and walkovers."""

    points: Mapping[str, float]
    games: Sequence[CountedMatch]
    missed: Mapping[str, int]  # rounds without an opponent: byes, walkovers and missed ones
    unplayed: Mapping[str, float]  # points of byes and walkovers


def head_to_head(table: Table, level: Sequence[str]) -> Values:
    """Direct encounter (article 6): points against the others who are level; of several matches with one, their mean.

    If not all have met, only those have points who stay ahead of all behind them however the missing matches had ended.
    """
    results: dict[tuple[str, str], list[float]] = {}
    for game in table.games:
        for pair in permutations([name for name in level if name in game.points], 2):
            own, other = (game.points[name] for name in pair)
            results.setdefault(pair, []).append(0.5 + 0.5 * ((own > other) - (own < other)))
    means = {pair: sum(points) / len(points) for pair, points in results.items()}
    points = {name: exact(sum(means.get((name, other), 0.0) for other in level)) for name in level}
    missing = {name: sum((name, other) not in means for other in level if other != name) for name in level}
    if not any(missing.values()):
        return points
    values = dict.fromkeys(level, 0.0)
    behind = sorted(level, key=points.__getitem__)
    while behind:
        best = behind.pop()
        if any(points[best] <= points[other] + missing[other] for other in behind):
            break
        values[best] = points[best]
    return values


def wins(table: Table, level: Sequence[str]) -> Values:
    """Number of games won: matches in which an entrant came first alone."""
    return {name: float(sum(game.first == name for game in table.games)) for name in level}


def buchholz(table: Table, level: Sequence[str]) -> Values:
    """Sum of the opponents' points; a round without an opponent is one against the own points."""
    return {
        name: sum(_opponents(table, game, name) for game in table.games if name in game.points)
        + table.missed[name] * table.points[name]
        for name in level
    }


def sonneborn_berger(table: Table, level: Sequence[str]) -> Values:
    """Sum of the opponents' points, each times the own points against it."""
    return {
        name: sum(game.points[name] * _opponents(table, game, name) for game in table.games if name in game.points)
        + table.unplayed[name] * table.points[name]
        for name in level
    }


def place_counts(place: int) -> "Callable[[Table, Sequence[str]], Values]":
    """Countback: how often an entrant came in at this place, from 1."""

    def count(table: Table, level: Sequence[str]) -> Values:
        return {name: float(sum(_place(game, name) == place for game in table.games)) for name in level}

    return count


def _place(game: CountedMatch, name: str) -> int:
    if name not in game.points:
        return 0
    return 1 + sum(points > game.points[name] for points in game.points.values())


def _opponents(table: Table, game: CountedMatch, name: str) -> float:
    """Mean of the opponents' points."""
    others = [table.points[other] for other in game.points if other != name]
    return sum(others) / len(others) if others else 0.0
