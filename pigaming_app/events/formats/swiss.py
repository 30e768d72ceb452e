"""Swiss system: opponents with equal scores who have not met.

Matches of two follow the FIDE Handbook, C.04.1 (Basic rules) and C.04.3 (the Dutch system), in this order:

1. An odd one out, of those with the fewest byes, has a bye, which counts as a win.
2. As few as possible meet again: in half as many rounds as there are entrants nobody does (Dirac).
3. From the highest score group down, as few as possible float from it to a lower one; a bye is below the last group.
4. In the order of scores, then of the seeding, each meets the opponent who is next in line: within a score group, the
   upper half meets the lower half in order, then itself from the end, then the groups below.

One matching of least weight satisfies all four, each as far as those before it permit, and there is only one such
pairing. The Dutch system's rules on colours and on repeated floats are left out; seats alternate instead.

Matches of three or four: groups of neighbours in the order of scores, in which as few as possible meet again.
"""

from collections.abc import Collection, Iterable, Sequence
from functools import lru_cache, reduce
from math import ceil, log2

from pigaming_app.events.formats import tie_breaks
from pigaming_app.events.formats.field import Draw, EntrantField, FormatKind, MatchUp
from pigaming_app.events.formats.grouping import neighbours
from pigaming_app.events.formats.scoring import BYE, scores
from pigaming_app.events.spec import EventSpec, Standing

MOST = 4096  # more than the sum of a criterion over all pairs
TIE_BREAKS = {
    "buchholz": tie_breaks.buchholz,
    "head_to_head": tie_breaks.head_to_head,
    "sonneborn_berger": tie_breaks.sonneborn_berger,
    "wins": tie_breaks.wins,
}


def rounds(field: EntrantField) -> list[Draw]:
    """The next round after a complete one; none after the last, or if there are less than two entrants."""
    names = field.present
    last = field.spec.rounds or default_rounds(len(field.entrants))
    if not field.complete or len(field.rounds) >= last or len(names) < 2:
        return []
    score, met = scores(field), field.meetings()
    order = sorted(names, key=lambda name: -score[name])
    if field.spec.seats > 2:
        return [Draw(tuple(MatchUp(group) for group in neighbours(order, field.spec.seats, met)))]
    place, byes = {name: i for i, name in enumerate(order)}, field.byes()
    again = frozenset(
        (*sorted(place[name] for name in pair), times) for pair, times in met.items() if pair <= place.keys()
    )
    found = pairing(tuple(score[name] for name in order), again, tuple(byes[name] for name in order))
    matches = tuple(MatchUp((order[one], order[other])) for one, other in found if other < len(order))
    return [Draw(matches, tuple(order[one] for one, other in found if other == len(order)))]


def table(field: EntrantField) -> tuple[Standing, ...]:
    """Points, Buchholz, head to head, Sonneborn-Berger, wins."""
    counted = tie_breaks.counted(field, field.outcomes.values(), bye=BYE)
    return tie_breaks.table_of(field, field.entrants, counted, TIE_BREAKS)


def default_rounds(count: int) -> int:
    """Rounds after which one alone can have won all: the binary logarithm, rounded up."""
    return ceil(log2(count))


@lru_cache(256)
def pairing(
    score: Sequence[float], met: Collection[tuple[int, int, int]], byes: Sequence[int]
) -> tuple[tuple[int, int], ...]:
    """The pairs of a round, each as two places in the order of scores, from 0; a bye has the place behind the last one.

    `score` and `byes`: by place, the best score first; `met`: two places, the lower number first, and how often.
    """
    from networkx import Graph, min_weight_matching  # late: it takes a tenth of a second

    values, even = sorted({*score}, reverse=True), len(score) + len(score) % 2
    group = [values.index(points) for points in score] + [len(values) - 1]
    times = {(one, other): count for one, other, count in met}
    graph = Graph()
    for one in range(len(score)):
        for rank, other in enumerate(_in_line(one, group[: len(score)], even)):
            rested = byes[one] if other == len(score) else 0
            floats = [int(group[one] <= i < group[other]) for i in range(len(values) - 1)]
            ranks = [rank if i == one else 0 for i in range(len(score))]
            graph.add_edge(one, other, weight=_number((rested, times.get((one, other), 0), *floats, *ranks)))
    return tuple(sorted((min(pair), max(pair)) for pair in min_weight_matching(graph)))


def _in_line(one: int, group: Sequence[int], even: int) -> list[int]:
    """All opponents of `one` behind it in the order, the next in line first."""
    first, size = group.index(group[one]), group.count(group[one])
    floats = first % 2  # of an odd number above, one comes down, and takes the first of the group
    half, end = first + floats + (size - floats) // 2, first + size
    lower, upper = range(max(half, one + 1), end), range(half - 1, one, -1)
    return [*lower, *upper, *range(end, even)]


def _number(criteria: Iterable[int]) -> int:
    """A number that grows with the first criterion, then with the second, and so on."""
    return reduce(lambda number, criterion: number * MOST + criterion, criteria, 0)


def _check(spec: EventSpec) -> None:
    count = len(spec.entrants)
    if spec.seats == 2 and spec.rounds > count - 1:
        raise ValueError(f"{count} entrants can play at most {count - 1} Swiss rounds, not {spec.rounds}")


KIND = FormatKind(
    matches=lambda spec, count: (spec.rounds or default_rounds(count)) * count // spec.seats,
    draws=rounds,
    table=table,
    check=_check,
    rounds=(3, 4, 5, 6, 7, 8, 9),
    figures=("points", "wins", "played", "buchholz"),
)
