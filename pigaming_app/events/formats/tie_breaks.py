"""Tables: points, then tie-breaks after the FIDE Handbook, C.07 (Tie-break regulations, from 1 August 2024).

Two things are simpler: a round without an opponent counts as one against somebody with the own points, without a limit,
and the unplayed rounds of opponents are not adjusted.

Every function takes the table of all matches and the entrants who are still level, and returns a value of each of them:
more is better. A match of three or four counts as one of two against each of the opponents, of whom the mean is taken.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations

from pigaming_app.events.formats import scoring
from pigaming_app.events.formats.field import EntrantField
from pigaming_app.events.formats.scoring import exact
from pigaming_app.events.spec import WALKOVER, Result, Standing

Values = dict[str, float]


@dataclass(frozen=True)
class CountedMatch:
    """A match as it counts: points of each entrant, and all who take part."""

    points: Mapping[str, float]
    first: str = ""  # who won alone


@dataclass(frozen=True)
class Table:
    """All matches that count, and the sum of the points of everybody, with those of byes and walkovers.

    Nothing here is rounded: sixths that were would tell those apart who are level.
    """

    points: Mapping[str, float]
    games: Sequence[CountedMatch]
    missed: Mapping[str, int]  # rounds without an opponent: byes, walkovers and missed ones
    unplayed: Mapping[str, float]  # points of byes and walkovers


TieBreak = Callable[[Table, Sequence[str]], Values]


def table_of(
    field: EntrantField, names: Sequence[str], table: Table, chain: Mapping[str, TieBreak]
) -> tuple[Standing, ...]:
    """These entrants by points, then by each tie-break; equal ones share a place, in the order of `names`."""
    values: dict[str, dict[str, float]] = {name: {} for name in names}
    groups = _split(names, table.points)
    for key, tie_break in chain.items():
        finer = []
        for group in groups:
            for name, value in tie_break(table, group).items():
                values[name][key] = exact(value)
            finer += _refined(tie_break, table, group)
        groups = finer
    rows: list[Standing] = []
    for group in groups:
        place = len(rows) + 1
        rows += [row_of(field, place, name, exact(table.points[name]), values[name]) for name in group]
    return tuple(rows)


def counted(
    field: EntrantField,
    outcomes: Iterable[Result],
    gained_by: Callable[[Result], Mapping[str, float]] = scoring.points,
    bye: float | None = None,
) -> Table:
    """These results as they count. `bye`: points of a bye; None: a bye is nothing, and a walkover counts as played."""
    total, unplayed = dict.fromkeys(field.entrants, 0.0), dict.fromkeys(field.entrants, 0.0)
    matches, met = [], set()
    for outcome in outcomes:
        gained, walkover = gained_by(outcome), outcome.note == WALKOVER
        for name, value in gained.items():
            total[name] += value
        if walkover and bye is not None:
            for name, value in gained.items():
                unplayed[name] += value
            continue
        first = outcome.places[0][0] if len(outcome.places[0]) == 1 and not walkover else ""
        matches.append(CountedMatch(gained, first))
        met |= {(outcome.fixture, name) for name in gained}
    complete = [drawn for drawn in field.rounds if all(one.number in field.outcomes for one in drawn.fixtures)]
    for name in (name for drawn in complete if bye is not None for name in drawn.byes):
        total[name] += bye or 0.0
        unplayed[name] += bye or 0.0
    missed = {
        name: sum(all((one.number, name) not in met for one in drawn.fixtures) for drawn in complete)
        for name in field.entrants
    }
    return Table(total, matches, missed, unplayed)


def ranked(
    field: EntrantField,
    names: Iterable[str],
    key: Callable[[str], tuple[float, ...]],
    values: Callable[[str], Mapping[str, float]] = lambda name: {},
) -> tuple[Standing, ...]:
    """These entrants by a key, higher is better; points are the number of those behind."""
    order = sorted(names, key=key, reverse=True)
    keys = [key(name) for name in order]
    return tuple(
        row_of(field, 1 + keys.index(own), name, float(sum(other < own for other in keys)), values(name))
        for name, own in zip(order, keys, strict=True)
    )


def row_of(field: EntrantField, place: int, name: str, points: float, values: Mapping[str, float]) -> Standing:
    """A row of a table, with the matches of an entrant."""
    won = played = 0
    for outcome in field.outcomes.values():
        if outcome.note != WALKOVER and any(name in tied for tied in outcome.places):
            played += 1
            won += outcome.places[0] == (name,) and len(outcome.places) > 1
    return Standing(place, name, points, won, played, values)


def head_to_head(table: Table, level: Sequence[str]) -> Values:
    """Direct encounter (article 6): points against the others who are level; of several matches with one, their mean.

    If not all have met, only those have points who stay ahead of all behind them however the missing matches had ended.
    """
    results: dict[tuple[str, str], list[float]] = {}
    for game in table.games:
        for pair in permutations([name for name in level if name in game.points], 2):
            results.setdefault(pair, []).append(_against(game, *pair))
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
        name: sum(_mean_of_others(game, name, table.points.__getitem__) for game in table.games if name in game.points)
        + table.missed[name] * table.points[name]
        for name in level
    }


def sonneborn_berger(table: Table, level: Sequence[str]) -> Values:
    """Sum of the opponents' points, each times the own points against it."""

    def value(game: CountedMatch, name: str) -> float:
        return _mean_of_others(game, name, lambda other: _against(game, name, other) * table.points[other])

    return {
        name: sum(value(game, name) for game in table.games if name in game.points)
        + table.unplayed[name] * table.points[name]
        for name in level
    }


def place_counts(place: int) -> TieBreak:
    """Countback: how often an entrant came in at this place, from 1."""

    def count(table: Table, level: Sequence[str]) -> Values:
        return {name: float(sum(_place(game, name) == place for game in table.games)) for name in level}

    return count


def _split(names: Sequence[str], value: Mapping[str, float]) -> list[list[str]]:
    """The names by descending value, equal ones together in their order."""
    groups: dict[float, list[str]] = {}
    for name in names:
        groups.setdefault(exact(value[name]), []).append(name)
    return [groups[key] for key in sorted(groups, reverse=True)]


def _refined(tie_break: TieBreak, table: Table, group: list[str]) -> list[list[str]]:
    """A group split by a tie-break, which counts again among those who are still level, if they are fewer."""
    parts = _split(group, tie_break(table, group))
    return parts if len(parts) == 1 else [finer for part in parts for finer in _refined(tie_break, table, part)]


def _place(game: CountedMatch, name: str) -> int:
    if name not in game.points:
        return 0
    return 1 + sum(points > game.points[name] for points in game.points.values())


def _against(game: CountedMatch, name: str, other: str) -> float:
    """Points of one against another in a match; none if it was nobody's, as both were away."""
    own, others = game.points[name], game.points[other]
    return 0.5 + 0.5 * ((own > others) - (own < others)) if own or others else 0.0


def _mean_of_others(game: CountedMatch, name: str, value: Callable[[str], float]) -> float:
    others = [value(other) for other in game.points if other != name]
    return sum(others) / len(others) if others else 0.0
