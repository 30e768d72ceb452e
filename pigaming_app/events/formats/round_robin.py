"""Round robin: everybody meets everybody.

Matches of two follow the Berger tables (FIDE Handbook C.05, annex 1, "Details of Berger tables"; the same as the circle
method of R. Schurig, 1886): of an even number n the last stays, all others move on by n/2 places from round to round.
Of an odd number, whoever would meet the missing last one has a bye. The first of a pair takes the first seat. In a
second cycle, seats are exchanged.

Matches of three or four: in every round all play, in groups that are exchanged until as few as possible meet again, and
there are rounds until each two have met as often as there are cycles, but at most three times as many as a perfect
design would need.
"""

from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import replace
from functools import lru_cache
from random import Random

from pigaming_app.events.formats import tie_breaks
from pigaming_app.events.formats.field import Draw, EntrantField, FormatKind, MatchUp, meetings
from pigaming_app.events.formats.grouping import mixed, serpentine, sizes
from pigaming_app.events.spec import WALKOVER, EventSpec, Fixture, Result, Standing

MOST_MATCHES = 4096  # of two
CYCLES = 1  # by default
PATIENCE = 3  # times the rounds of a perfect design
TIE_BREAKS = {
    "head_to_head": tie_breaks.head_to_head,
    "wins": tie_breaks.wins,
    "sonneborn_berger": tie_breaks.sonneborn_berger,
}


def rounds(field: EntrantField) -> list[Draw]:
    """The rounds that are not drawn yet."""
    return schedule(field, field.entrants)[len(field.rounds) :]


def schedule(field: EntrantField, names: tuple[str, ...]) -> list[Draw]:
    """All rounds among some entrants. Late ones have missed the first round and play from the second one on."""
    cycles = field.spec.rounds or CYCLES
    first = tuple(name for name in names if name not in field.late)
    draws = _pairs if field.spec.seats == 2 else _groups
    whole = draws(first, field.spec.seats, cycles)
    if len(first) == len(names):
        return whole
    played = {frozenset(match.entrants) for match in whole[0].matches}
    again = [whole[0]]
    for draw in draws(names, field.spec.seats, cycles):
        left = []
        for match in draw.matches:
            if frozenset(match.entrants) in played:
                played.remove(frozenset(match.entrants))
            else:
                left.append(match)
        if left:
            again.append(Draw(tuple(left), draw.byes))
    return again


def table(field: EntrantField) -> tuple[Standing, ...]:
    """Points, head to head, wins, Sonneborn-Berger."""
    return table_among(field, field.entrants, [one for drawn in field.rounds for one in drawn.fixtures])


def table_among(field: EntrantField, names: Sequence[str], fixtures: Sequence[Fixture]) -> tuple[Standing, ...]:
    """The table of some entrants by their matches. An entrant who withdraws before half of the own ones are played is
    taken out of all of them (FIDE Handbook C.05, General regulations for competitions).
    """
    early = {name for name in names if name in field.withdrawn and _left_early(field, name, fixtures)}
    outcomes = [field.outcomes[one.number] for one in fixtures if one.number in field.outcomes]
    counting = [_without(one, early) for one in outcomes]
    counting = [one for one in counting if sum(map(len, one.places)) > 1]
    return tie_breaks.table_of(field, names, tie_breaks.counted(field, counting), TIE_BREAKS)


def berger(count: int) -> list[list[tuple[int, int]]]:
    """The Berger table for an even number of entrants, numbered from 1: pairs of each round, first seat first."""
    last, half = count, count // 2
    table = []
    for number in range(count - 1):
        one = number * half % (count - 1) + 1  # meets the last
        pairs = [(one, last) if number % 2 == 0 else (last, one)]
        for k in range(1, half):
            pairs.append((1 + (one - 1 + k) % (count - 1), 1 + (one - 1 - k) % (count - 1)))
        table.append(pairs)
    return table


def _pairs(names: tuple[str, ...], seats: int, cycles: int) -> list[Draw]:
    count = len(names) + len(names) % 2
    draws = []
    for cycle in range(cycles):
        for pairs in berger(count):
            matches, byes = [], []
            for pair in pairs:
                one, other = pair if cycle % 2 == 0 else pair[::-1]
                if max(pair) > len(names):
                    byes.append(names[min(pair) - 1])
                else:
                    matches.append(MatchUp((names[one - 1], names[other - 1]), seated=True))
            draws.append(Draw(tuple(matches), tuple(byes)))
    return draws


@lru_cache(8)
def _groups(names: tuple[str, ...], seats: int, cycles: int) -> list[Draw]:
    perfect = -(-cycles * (len(names) - 1) // (sizes(len(names), seats)[0] - 1))
    every = len(names) * (len(names) - 1) // 2
    draws: list[Draw] = []
    met: dict[frozenset[str], int] = {}
    while len(draws) < perfect * PATIENCE:
        if len(met) == every and min(met.values()) >= cycles:
            break
        order = list(names)
        if draws:
            Random(len(draws)).shuffle(order)
        groups = mixed(serpentine(order, seats), met)
        draws.append(Draw(tuple(MatchUp(group) for group in groups)))
        for pair, times in meetings(iter(groups)).items():
            met[pair] = met.get(pair, 0) + times
    return draws


def _without(outcome: Result, names: AbstractSet[str]) -> Result:
    places = (tuple(name for name in place if name not in names) for place in outcome.places)
    return replace(outcome, places=tuple(filter(None, places)))


def _left_early(field: EntrantField, name: str, fixtures: Sequence[Fixture]) -> bool:
    own = [one.number for one in fixtures if name in one.entrants]
    played = sum(number in field.outcomes and field.outcomes[number].note != WALKOVER for number in own)
    several = field.spec.seats > 2  # all play in every round, and matches are drawn on without whoever has left
    return 2 * played < (len(field.rounds) - (name in field.late) if several else len(own))


def _check(spec: EventSpec) -> None:
    count = len(spec.entrants)
    if max(1, spec.rounds) * count * (count - 1) // 2 > MOST_MATCHES:
        raise ValueError(f"{spec.rounds} times {count} entrants are more than {MOST_MATCHES} matches")


KIND = FormatKind(
    draws=rounds,
    table=table,
    check=_check,
    follows_results=False,
    exchanges=False,
    follows_withdrawals=False,
    rounds=(1, 2),
    figures=("points", "wins", "played", "head_to_head"),
)
