"""Tie-breaks after the FIDE Handbook, C.07 (Tie-break regulations, from 1 August 2024).

Two things are simpler: a round without an opponent counts as one against somebody with the own points, without a limit,
and the unplayed rounds of opponents are not adjusted.

Every function takes the table of all matches and the entrants who are still level, and returns a value of each of them:
more is better. A match of three or four counts as one of two against the mean of the opponents.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

Values = dict[str, float]


@dataclass(frozen=True)
class Game:
    """A match as it counts: points of each entrant, and all who take part."""

    points: Mapping[str, float]
    first: str = ""  # who won alone


@dataclass(frozen=True)
class Table:
    """All matches that count, and the sum of the points of everybody, with those of byes and walkovers."""

    points: Mapping[str, float]
    games: Sequence[Game]
    missed: Mapping[str, int]  # rounds without an opponent: byes, walkovers and missed ones
    unplayed: Mapping[str, float]  # points of byes and walkovers


def head_to_head(table: Table, level: Sequence[str]) -> Values:
    """Direct encounter: points of the matches among those who are level, if each two of them have met."""
    among = [game for game in table.games if sum(name in game.points for name in level) > 1]
    met = {frozenset((one, other)) for game in among for one in game.points for other in game.points if one != other}
    values = dict.fromkeys(level, 0.0)
    if any(frozenset((one, other)) not in met for one in level for other in level if one < other):
        return values
    for game in among:
        inner = [name for name in game.points if name in values]
        for name in inner:
            won = [1.0 if game.points[name] > game.points[other] else 0.5 for other in inner if other != name]
            lost = sum(game.points[name] < game.points[other] for other in inner)
            values[name] += (sum(won) - 0.5 * lost) / (len(inner) - 1)
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


def _place(game: Game, name: str) -> int:
    if name not in game.points:
        return 0
    return 1 + sum(points > game.points[name] for points in game.points.values())


def _opponents(table: Table, game: Game, name: str) -> float:
    """Mean of the opponents' points."""
    others = [table.points[other] for other in game.points if other != name]
    return sum(others) / len(others) if others else 0.0
