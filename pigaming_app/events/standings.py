"""The table of an event.

Round robin: points, head to head, wins, Sonneborn-Berger. Of an entrant who withdraws before half of the matches are
played, none counts (FIDE Handbook C.05, General regulations for competitions). Swiss: points, Buchholz, head to head,
Sonneborn-Berger, wins. Grand Prix: points, then most first, second and third places. Knock-out: who is still in, the
unbeaten first, then who was beaten for the second time last; points are the number of those behind.
"""

from collections.abc import Callable, Mapping, Sequence

from pigaming_app.events import tie_breaks
from pigaming_app.events.formats import grand_prix, knockout, scoring
from pigaming_app.events.formats.field import EntrantField
from pigaming_app.events.progress import Progress
from pigaming_app.events.spec import WALKOVER, Format, Result, Standing
from pigaming_app.events.tie_breaks import CountedMatch, Table, Values

TieBreak = Callable[[Table, Sequence[str]], Values]
TIE_BREAKS: Mapping[Format, Mapping[str, TieBreak]] = {
    Format.ROUND_ROBIN: {
        "head_to_head": tie_breaks.head_to_head,
        "wins": tie_breaks.wins,
        "sonneborn_berger": tie_breaks.sonneborn_berger,
    },
    Format.SWISS: {
        "buchholz": tie_breaks.buchholz,
        "head_to_head": tie_breaks.head_to_head,
        "sonneborn_berger": tie_breaks.sonneborn_berger,
        "wins": tie_breaks.wins,
    },
    Format.GRAND_PRIX: {
        "first": tie_breaks.place_counts(1),
        "second": tie_breaks.place_counts(2),
        "third": tie_breaks.place_counts(3),
    },
}


def standings(progress: Progress) -> tuple[Standing, ...]:
    """All entrants, best first; equal ones share a place and stand in the order of their seeding."""
    field = progress.as_field()
    if field.spec.format == Format.KNOCKOUT:
        return _knockout(field)
    table = _table(field)
    chain = TIE_BREAKS[field.spec.format]
    values: dict[str, dict[str, float]] = {name: {} for name in field.entrants}
    groups = _split(field.entrants, table.points)
    for key, tie_break in chain.items():
        finer = []
        for group in groups:
            for name, value in tie_break(table, group).items():
                values[name][key] = value
            finer += _refined(tie_break, table, group)
        groups = finer
    rows: list[Standing] = []
    for group in groups:
        place = len(rows) + 1
        rows += [_row(field, place, name, table.points[name], values[name]) for name in group]
    return tuple(rows)


def team_standings(progress: Progress) -> tuple[Standing, ...]:
    """All teams, best first, by the sum of the points, then of the wins, of their entrants; none without teams."""
    rows = {row.entrant: row for row in standings(progress)}
    members: dict[str, list[Standing]] = {}
    for entrant in progress.entrants:
        if entrant.team:
            members.setdefault(entrant.team, []).append(rows[entrant.name])
    points = {team: sum(row.points for row in team_rows) for team, team_rows in members.items()}
    won = {team: sum(row.wins for row in team_rows) for team, team_rows in members.items()}
    order = sorted(members, key=lambda team: (-points[team], -won[team]))
    ranks = [(points[team], won[team]) for team in order]
    return tuple(
        Standing(
            place=1 + ranks.index((points[team], won[team])),
            entrant=team,
            points=points[team],
            wins=won[team],
            played=sum(row.played for row in members[team]),
            tie_breaks={"wins": float(won[team])},
        )
        for team in order
    )


def _table(field: EntrantField) -> Table:
    """The matches as the format counts them. In a round robin a walkover counts as played."""
    form = field.spec.format
    points, unplayed = dict.fromkeys(field.entrants, 0.0), dict.fromkeys(field.entrants, 0.0)
    games, met = [], dict.fromkeys(field.entrants, 0)
    for outcome in field.outcomes.values():
        if _void(field, outcome):
            continue
        gained = _grand_prix(outcome) if form == Format.GRAND_PRIX else scoring.points(outcome)
        walkover = outcome.note == WALKOVER
        for name, value in gained.items():
            points[name] += value
        if walkover and form != Format.ROUND_ROBIN:
            for name, value in gained.items():
                unplayed[name] += value
            continue
        first = outcome.places[0][0] if len(outcome.places[0]) == 1 and not walkover else ""
        games.append(CountedMatch(gained, first))
        for name in gained:
            met[name] += 1
    complete = [drawn for drawn in field.rounds if all(one.number in field.outcomes for one in drawn.fixtures)]
    for name in (name for drawn in complete if form != Format.ROUND_ROBIN for name in drawn.byes):
        value = grand_prix.BYE if form == Format.GRAND_PRIX else scoring.BYE
        points[name] += value
        unplayed[name] += value
    missed = {name: max(0, len(complete) - met[name]) for name in field.entrants}
    return Table({name: scoring.exact(value) for name, value in points.items()}, games, missed, unplayed)


def _void(field: EntrantField, outcome: Result) -> bool:
    """True if a result of a round robin does not count: somebody withdrew before half of the matches."""
    if field.spec.format != Format.ROUND_ROBIN or not field.withdrawn:
        return False
    return any(name in field.withdrawn and _left_early(field, name) for place in outcome.places for name in place)


def _left_early(field: EntrantField, name: str) -> bool:
    own = [one.number for drawn in field.rounds for one in drawn.fixtures if name in one.entrants]
    played = sum(number in field.outcomes and field.outcomes[number].note != WALKOVER for number in own)
    return 2 * played < len(own)


def _grand_prix(outcome: Result) -> dict[str, float]:
    """Points by place; a walkover is a first place."""
    if outcome.note == WALKOVER:
        return {name: share * grand_prix.POINTS[0] for name, share in scoring.points(outcome).items()}
    found: dict[str, float] = {}
    for place in outcome.places:
        here = grand_prix.shared(len(found) + 1, len(place))
        found |= dict.fromkeys(place, here)
    return found


def _knockout(field: EntrantField) -> tuple[Standing, ...]:
    lost = knockout.defeats(field)
    last = dict.fromkeys(field.entrants, 0)  # round of the last match
    ended = dict.fromkeys(field.entrants, 0.0)  # place in it
    for drawn in field.rounds:
        for fixture in drawn.fixtures:
            if outcome := field.outcomes.get(fixture.number):
                ahead = 0
                for place in outcome.places:
                    for name in place:
                        last[name], ended[name] = drawn.number, float(ahead)
                    ahead += len(place)

    def key(name: str) -> tuple[float, ...]:
        """Higher is better."""
        if lost[name] < knockout.OUT and name not in field.withdrawn:
            return (2.0 - lost[name], 0.0, 0.0)
        return (0.0, last[name], -ended[name])

    order = sorted(field.entrants, key=key, reverse=True)
    keys = [key(name) for name in order]
    rows = []
    for name in order:
        behind = sum(one < key(name) for one in keys)
        rows.append(_row(field, 1 + keys.index(key(name)), name, float(behind), {}))
    return tuple(rows)


def _split(names: Sequence[str], value: Mapping[str, float]) -> list[list[str]]:
    """The names by descending value, equal ones together in their order."""
    groups: dict[float, list[str]] = {}
    for name in names:
        groups.setdefault(scoring.exact(value[name]), []).append(name)
    return [groups[key] for key in sorted(groups, reverse=True)]


def _refined(tie_break: TieBreak, table: Table, group: list[str]) -> list[list[str]]:
    """A group split by a tie-break, which counts again among those who are still level, if they are fewer."""
    parts = _split(group, tie_break(table, group))
    return parts if len(parts) == 1 else [finer for part in parts for finer in _refined(tie_break, table, part)]


def _row(field: EntrantField, place: int, name: str, points: float, values: Mapping[str, float]) -> Standing:
    won = played = 0
    for outcome in field.outcomes.values():
        if outcome.note != WALKOVER and any(name in tied for tied in outcome.places):
            played += 1
            won += outcome.places[0] == (name,)
    return Standing(place, name, points, won, played, values)
