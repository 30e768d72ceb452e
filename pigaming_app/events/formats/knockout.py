"""Knock-out with a second chance (double elimination): whoever has lost two matches is out.

The unbeaten play in the winners' bracket, those with one defeat in the losers' bracket; the winners' bracket pauses
while more are left in the other one. The last of either meet in the final; if the unbeaten loses it, a second final
decides.

Matches of two follow the standard bracket: the two best seeds can meet in its final only, the four best in its
semi-finals. To the next power of two, byes of the first round go to the best seeds. Losers cross over to the other half
of the bracket, and do not meet again as far as that is possible; an odd one out in the losers' bracket, of those with
the fewest byes the best seed, has a bye. In matches of three or four there are no byes: the matches are of equal size
and strength (serpentine), and the better half wins (of four two, of three two, of two one), or with `quarter` the first
alone. If places are equal at the cut, extra matches decide (sudden_death.py).

A late entrant has missed one round, and so begins in the losers' bracket.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import zip_longest

from pigaming_app.events.formats import tie_breaks
from pigaming_app.events.formats.field import Draw, EntrantField, FormatKind, MatchUp
from pigaming_app.events.formats.grouping import mixed, neighbours, serpentine
from pigaming_app.events.formats.sudden_death import through
from pigaming_app.events.spec import WALKOVER, Advance, EventSpec, Fixture, Standing

WINNERS, LOSERS, FINAL = "winners", "losers", "final"
OUT = 2  # defeats


def rounds(field: EntrantField) -> list[Draw]:
    """The next round after a complete one; none once the event is decided."""
    if not field.complete:
        return []
    lost = defeats(field)
    unbeaten = [name for name in field.present if lost[name] == 0]
    beaten = [name for name in field.present if lost[name] == 1]
    if len(unbeaten) + len(beaten) < 2:
        return []
    if len(unbeaten) <= 1 and len(beaten) <= 2 and len(unbeaten) + len(beaten) == 2:
        finals = bool(unbeaten) or any(one.stage == FINAL for drawn in field.rounds for one in drawn.fixtures)
        return [Draw((MatchUp((*unbeaten, *beaten), FINAL if finals else LOSERS),))]
    matches: list[MatchUp] = []
    byes: list[str] = []
    if len(unbeaten) > 1 and len(beaten) <= len(unbeaten):
        groups, byes = _winners(field, unbeaten)
        matches += [MatchUp(group, WINNERS) for group in groups]
    if len(beaten) > 1:
        groups, rested = _losers(field, beaten)
        matches += [MatchUp(group, LOSERS) for group in groups]
        byes += rested
    return [Draw(tuple(matches), tuple(byes))]


def wins(spec: EventSpec, fixture: Fixture) -> int:
    """How many win a match, and go on."""
    share = 2 if spec.advance == Advance.HALF else 4
    return -(-len(fixture.entrants) // share)


def defeats(field: EntrantField) -> dict[str, int]:
    """Lost matches of everybody; a missed first round is one."""
    lost = {name: int(name in field.late) for name in field.entrants}
    for drawn in field.rounds:
        for fixture in drawn.fixtures:
            if outcome := field.outcomes.get(fixture.number):
                for name in {*fixture.entrants} - through(outcome, wins(field.spec, fixture)):
                    lost[name] += 1
    return lost


def bracket(size: int) -> list[int]:
    """Seeds, from 1, by their place in a bracket of a power of two: 1, 8, 4, 5, 2, 7, 3, 6."""
    seeds = [1]
    while len(seeds) < size:
        seeds = [one for seed in seeds for one in (seed, 2 * len(seeds) + 1 - seed)]
    return seeds


def places_in_bracket(field: EntrantField) -> dict[str, int]:
    """Place of everybody in the bracket of the first round, from 0; of late entrants behind it."""
    starters = [name for name in field.entrants if name not in field.late]
    size = 1 << (len(starters) - 1).bit_length()
    place = {starters[seed - 1]: i for i, seed in enumerate(bracket(size)) if seed <= len(starters)}
    return place | {name: size + i for i, name in enumerate(sorted(field.late, key=field.entrants.index))}


def _winners(field: EntrantField, names: Sequence[str]) -> tuple[list[tuple[str, ...]], list[str]]:
    if field.spec.seats > 2:
        return mixed(serpentine(names, field.spec.seats), field.meetings()), []
    place = places_in_bracket(field)
    number = 1 + sum(any(one.stage == WINNERS for one in drawn.fixtures) for drawn in field.rounds)
    slots: dict[int, list[str]] = {}
    while not any(len(slot) > 1 for slot in slots.values()):  # withdrawals can leave a round without a match
        slots = {}
        for name in sorted(names, key=place.__getitem__):
            slots.setdefault(place[name] >> number, []).append(name)
        number += 1
    groups = [tuple(slot) for slot in slots.values() if len(slot) > 1]
    return groups, [slot[0] for slot in slots.values() if len(slot) == 1]


def _losers(field: EntrantField, names: Sequence[str]) -> tuple[list[tuple[str, ...]], list[str]]:
    met = field.meetings()
    if field.spec.seats > 2:
        return mixed(serpentine(names, field.spec.seats), met), []
    left, rested = list(names), []
    if len(left) % 2:
        byes = field.byes()
        rested = [min(left, key=lambda name: byes[name])]
        left.remove(rested[0])
    place = places_in_bracket(field)
    left.sort(key=place.__getitem__)
    played = {name for drawn in field.rounds for one in drawn.fixtures if one.stage == LOSERS for name in one.entrants}
    stayed = [name for name in left if name in played]
    fallen = [name for name in left if name not in played]
    if stayed and fallen:
        left = [name for pair in zip_longest(stayed, reversed(fallen)) for name in pair if name]
    return neighbours(left, 2, met), rested


def table(field: EntrantField) -> tuple[Standing, ...]:
    """Who is still in, the unbeaten first, then who was beaten for the second time last."""
    lost = defeats(field)
    left = {name: number for name, number in field.left.items() if _still_in(field, name)}
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
        """Higher is better. Whoever withdraws is out in the round that was open, as the last of a full match."""
        if name in left:
            return (0.0, left[name], 1.0 - field.spec.seats)
        if lost[name] < OUT:
            return (2.0 - lost[name], 0.0, 0.0)
        return (0.0, last[name], -ended[name])

    return tie_breaks.ranked(field, field.entrants, key)


def _still_in(field: EntrantField, name: str) -> bool:
    """True if somebody has not lost two matches at the robots, without walkovers."""
    kept = {number: one for number, one in field.outcomes.items() if one.note != WALKOVER}
    return defeats(replace(field, outcomes=kept))[name] < OUT


KIND = FormatKind(
    matches=lambda spec, count: 2 * count // (spec.seats - 1),
    draws=rounds,
    table=table,
    wins=wins,
    sides={"winners_side": (WINNERS, FINAL), "second_chance": (LOSERS,)},
    bound=lambda spec: frozenset((FINAL, *((WINNERS,) if spec.seats == 2 else ()))),
)
