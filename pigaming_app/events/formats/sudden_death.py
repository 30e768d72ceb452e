"""Sudden death: extra matches decide who goes on from a knock-out match that is level where it divides its entrants.

Only those play who share the place across that line, again and again while some still do. After LEVEL extra matches
without any difference between them, lots are drawn from the event's seed.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import takewhile
from random import Random

from pigaming_app.events.spec import Fixture, Result

LEVEL = 3
SEED_STEP = 500  # between the seeds of two extra matches of one match, more than a knock-out has matches

Places = tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Verdict:
    """The places of a match after its extra matches. `tied`: who has to play another one; `lots`: lots were drawn."""

    places: Places
    tied: tuple[str, ...] = ()
    lots: bool = False


def verdict(fixture: Fixture, played: Sequence[Result], through: int) -> Verdict:
    """What a match and its extra matches, in this order, have decided. `through`: how many go on."""
    places = played[0].places
    for extra in played[1:]:
        group = {name for place in extra.places for name in place}
        at = next(i for i, place in enumerate(places) if {*place} == group)
        places = (*places[:at], *extra.places, *places[at + 1 :])
    tied = across(places, through)
    level = sum(1 for _ in takewhile(lambda extra: len(extra.places) == 1, reversed(played[1:])))
    if not tied or level < LEVEL:
        return Verdict(places, tied)
    at = places.index(tied)
    return Verdict((*places[:at], *((name,) for name in lots(fixture, tied)), *places[at + 1 :]), lots=True)


def across(places: Places, through: int) -> tuple[str, ...]:
    """Those who share a place of which only some go on."""
    ahead = 0
    for place in places:
        if ahead < through < ahead + len(place):
            return place
        ahead += len(place)
    return ()


def through(outcome: Result, wins: int) -> frozenset[str]:
    """Who goes on from a match that is decided, so many of them; nobody if all have withdrawn."""
    found: list[str] = []
    for place in outcome.places:
        if len(found) + len(place) > wins:
            break
        found += place
    return frozenset(found)


def lots(fixture: Fixture, tied: Sequence[str]) -> list[str]:
    """An order drawn by lot, which depends on the seed of the match and on no list."""
    return Random(fixture.seed).sample(sorted(tied), len(tied))


def extra_match(fixture: Fixture, number: int, tied: Sequence[str]) -> Fixture:
    """The extra match, from 1, of those who are tied, in the order of their seats."""
    entrants = tuple(name for name in fixture.entrants if name in tied)
    return replace(fixture, entrants=entrants, seed=fixture.seed + SEED_STEP * number, extra=number)
