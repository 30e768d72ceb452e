"""Group stage and knock-out: a round robin in groups, the first two of each go on, then one defeat is the end.

The seeding is dealt out to and fro (1 2 3 4, 8 7 6 5 …), so groups are of equal strength; there is the largest power of
two of them that leaves three entrants or more to each. Two groups cross: A1 meets B2, and B1 meets A2 in the other half
of the bracket, so two of one group can meet again in the final only. Extra matches decide a tie (sudden_death.py).

A late entrant joins the smallest group. If somebody who goes on withdraws before the first match of the knock-out, the
next of the group takes the place; later the opponent goes on.
"""

from itertools import chain, zip_longest
from string import ascii_uppercase

from pigaming_app.events.formats import round_robin, tie_breaks
from pigaming_app.events.formats.field import Draw, EntrantField, FormatKind, MatchUp
from pigaming_app.events.formats.sudden_death import through
from pigaming_app.events.spec import EventSpec, Fixture, Standing

GROUP, KNOCKOUT, FINAL = "group", "knockout", "last"  # stages; the first one with the letter of the group
SMALLEST = 3  # entrants of a group


def rounds(field: EntrantField) -> list[Draw]:
    """All rounds of the groups, then one round of the knock-out after the other."""
    schedules = [
        [
            Draw(tuple(MatchUp(match.entrants, f"{GROUP} {letter}", True) for match in draw.matches), draw.byes)
            for draw in draws
        ]
        for letter, names in groups(field).items()
        for draws in [round_robin.schedule(field, names)]
    ]
    whole = [
        Draw(tuple(chain(*(draw.matches for draw in draws))), tuple(chain(*(draw.byes for draw in draws))))
        for draws in zip_longest(*schedules, fillvalue=Draw(()))
    ]
    if len(field.rounds) < len(whole):
        return whole[len(field.rounds) :]
    if not field.complete:
        return []
    names = _crossed(field) if len(field.rounds) == len(whole) else _winners(field)
    stage = FINAL if len(names) == 2 else KNOCKOUT
    pairs = zip(names[::2], names[1::2], strict=False)
    return [Draw(tuple(MatchUp(pair, stage) for pair in pairs))] if len(names) > 1 else []


def groups(field: EntrantField) -> dict[str, tuple[str, ...]]:
    """The groups by their letters, each in the order of the seeding."""
    early = [name for name in field.entrants if name not in field.late]
    count = number_of(len(early))
    dealt: list[list[str]] = [[] for _ in range(count)]
    for i, name in enumerate(early):
        row, column = divmod(i, count)
        dealt[column if row % 2 == 0 else count - 1 - column].append(name)
    for name in field.entrants:
        if name in field.late:
            min(dealt, key=len).append(name)
    return {letter: tuple(group) for letter, group in zip(ascii_uppercase, dealt, strict=False)}


def number_of(entrants: int) -> int:
    """How many groups there are."""
    return 1 << ((entrants // SMALLEST).bit_length() - 1)


def tables(field: EntrantField) -> dict[str, tuple[Standing, ...]]:
    """The table of each group."""
    return {
        letter: round_robin.table_among(field, names, _of_stage(field, f"{GROUP} {letter}"))
        for letter, names in groups(field).items()
    }


def table(field: EntrantField) -> tuple[Standing, ...]:
    """By the rounds that were reached, then by the place in the group, then by the points of a match there."""
    reached = dict.fromkeys(field.entrants, 0)
    for number, drawn in enumerate(field.rounds, 1):
        for fixture in drawn.fixtures:
            if not fixture.stage.startswith(GROUP):
                won = _through(field, fixture)
                reached |= {name: 2 * number + (name in won) for name in fixture.entrants}
    rows = {row.entrant: row for rows in tables(field).values() for row in rows}
    matches = dict.fromkeys(field.entrants, 0)
    for drawn in field.rounds:
        for fixture in drawn.fixtures:
            if fixture.stage.startswith(GROUP) and fixture.number in field.outcomes:
                matches |= {name: matches[name] + 1 for name in fixture.entrants}

    def key(name: str) -> tuple[float, ...]:
        """Higher is better."""
        return reached[name], -rows[name].place, round(rows[name].points / max(1, matches[name]), 6)

    def values(name: str) -> dict[str, float]:
        return {"group_place": float(rows[name].place), "group_points": rows[name].points}

    return tie_breaks.ranked(field, field.entrants, key, values)


def _crossed(field: EntrantField) -> list[str]:
    """Who goes on, by the place in the bracket: A1 B2 C1 D2 … B1 A2 D1 C2 …; whoever has withdrawn comes last."""
    best = [
        sorted((row.entrant for row in rows), key=lambda name: name in field.withdrawn)[:2]
        for rows in tables(field).values()
    ]
    if len(best) == 1:
        return best[0]
    pairs = list(zip(best[::2], best[1::2], strict=True))
    upper = [name for one, other in pairs for name in (one[0], other[1])]
    return upper + [name for one, other in pairs for name in (other[0], one[1])]


def _winners(field: EntrantField) -> list[str]:
    """Who goes on from the last round; where both have withdrawn, no matter who."""
    return [min(_through(field, one) or one.entrants) for one in field.rounds[-1].fixtures]


def _through(field: EntrantField, fixture: Fixture) -> frozenset[str]:
    outcome = field.outcomes.get(fixture.number)
    return through(outcome, 1) if outcome else frozenset()


def _of_stage(field: EntrantField, stage: str) -> list[Fixture]:
    return [one for drawn in field.rounds for one in drawn.fixtures if one.stage == stage]


def _check(spec: EventSpec) -> None:
    number = number_of(len(spec.entrants))
    size = -(-len(spec.entrants) // number)
    if max(1, spec.rounds) * number * size * (size - 1) // 2 > round_robin.MOST_MATCHES:
        raise ValueError(f"{spec.rounds} times {number} groups are more than {round_robin.MOST_MATCHES} matches")


def _wins(spec: EventSpec, fixture: Fixture) -> int:
    return 0 if fixture.stage.startswith(GROUP) else 1


def _qualified(field: EntrantField) -> frozenset[str]:
    """Who has which place in the bracket, once it is drawn."""
    drawn = any(_wins(field.spec, one) for drawn in field.rounds for one in drawn.fixtures)
    return frozenset(f"{i} {name}" for i, name in enumerate(_crossed(field))) if drawn else frozenset()


KIND = FormatKind(
    matches=lambda spec, count: 2 * count,
    draws=rounds,
    exchanges=False,
    table=table,
    parts=tables,
    wins=_wins,
    qualified=_qualified,
    sides={"knockout_side": (KNOCKOUT, FINAL)},
    bound=lambda spec: frozenset((KNOCKOUT, FINAL)),
    seats=(2,),
    rounds=(1, 2),
    check=_check,
)
