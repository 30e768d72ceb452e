"""Swiss system: opponents with equal scores who have not met.

Matches of two follow the FIDE Handbook, C.04.1 (Basic rules) and C.04.3 (the Dutch system): within a score group, the
upper half by the seeding meets the lower half in order; whoever is left floats down to the next group; no two meet
twice; an odd one out, the last in the order who has had none yet, has a bye, which counts as a win. Where the
preferred opponent is not possible, the next one of the lower half is tried, then the upper half, then the next groups.
The Dutch system's rules on colours and on repeated floats are left out; seats alternate instead.
Up to half as many rounds as entrants always have a pairing without rematches (Dirac); beyond, rematches are the fewest
that are found.

Matches of three or four: groups of neighbours in the order of scores, in which as few as possible meet again.
"""

from collections.abc import Mapping, Sequence
from math import ceil, log2
from random import Random

from pigaming_app.events.formats.field import Draw, Field, Match, Pair
from pigaming_app.events.formats.grouping import neighbours
from pigaming_app.events.formats.scoring import scores

TRIES = 5_000  # steps of the search for one order
ORDERS = 10  # other orders that are tried


def next_round(field: Field) -> Draw | None:
    """The next round; None after the last one, or if there are less than two entrants."""
    names = field.present
    if len(field.rounds) >= (field.spec.rounds or default_rounds(len(field.entrants))) or len(names) < 2:
        return None
    score, met = scores(field), field.meetings()
    order = sorted(names, key=lambda name: -score[name])
    if field.spec.seats > 2:
        return Draw(tuple(Match(group) for group in neighbours(order, field.spec.seats, met)))
    if len(order) % 2 == 0:
        return Draw(tuple(Match(pair) for pair in pairs(order, score, met)[0]))
    fewest, upwards = field.byes(), order[::-1]
    draws: list[tuple[int, int, int, Draw]] = []
    for bye in sorted(upwards, key=fewest.__getitem__):
        found, again = pairs([name for name in order if name != bye], score, met)
        draws.append((fewest[bye], again, len(draws), Draw(tuple(Match(pair) for pair in found), (bye,))))
        if not again:
            break
    return min(draws)[3]


def default_rounds(count: int) -> int:
    """Rounds after which one alone can have won all: the binary logarithm, rounded up."""
    return ceil(log2(count))


def pairs(
    order: Sequence[str], score: Mapping[str, float], met: Mapping[Pair, int]
) -> tuple[list[tuple[str, str]], int]:
    """Pairs of an even number of entrants, and how many of them have met before. `order`: best first."""
    for again in range(len(order) // 2 + 1):
        if found := _search(order, score, met, again):
            return found, again
        for number in range(ORDERS):
            other = list(order)
            Random(number).shuffle(other)
            if found := _search(other, score, met, again):
                place = {name: i for i, name in enumerate(order)}
                ranked = [(one, two) if place[one] < place[two] else (two, one) for one, two in found]
                return sorted(ranked, key=lambda pair: place[pair[0]]), again
    raise AssertionError("with rematches of all, every pairing is possible")


def _search(
    order: Sequence[str], score: Mapping[str, float], met: Mapping[Pair, int], again: int
) -> list[tuple[str, str]]:
    """Pairs with at most `again` rematches, by backtracking; empty if none are found in TRIES steps."""
    steps = 0

    def complete(left: tuple[str, ...], allowed: int) -> list[tuple[str, str]] | None:
        nonlocal steps
        if not left:
            return []
        steps += 1
        if steps > TRIES:
            return None
        one = left[0]
        for other in candidates(left, score):
            repeated = int(met.get(frozenset((one, other)), 0) > 0)
            if repeated <= allowed:
                rest = tuple(name for name in left[1:] if name != other)
                if (found := complete(rest, allowed - repeated)) is not None:
                    return [(one, other), *found]
        return None

    return complete(tuple(order), again) or []


def candidates(left: Sequence[str], score: Mapping[str, float]) -> list[str]:
    """Opponents of the first of `left`, the preferred one first."""
    group = [name for name in left if score[name] == score[left[0]]]
    half = len(group) // 2
    behind = left[len(group) :] if list(left[: len(group)]) == group else [one for one in left if one not in group]
    if half == 0:
        return [*behind]  # floats down, to the best of the next group
    return [*group[half:], *reversed(group[1:half]), *behind]
