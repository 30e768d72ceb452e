"""Two entrants who exchange their places in the draw, and the seats of a match."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from pigaming_app.events.formats import knockout
from pigaming_app.events.spec import Fixture, Format, Round

if TYPE_CHECKING:
    from pigaming_app.events.progress import Progress


def swapped(progress: "Progress", name: str, other: str) -> "Progress":
    """With two entrants in each other's place in the first round that is open; a bye is a place, too.

    In the winners' bracket of a knock-out they keep the places to its end. Raises ValueError.
    """
    form = progress.spec.format
    if form == Format.ROUND_ROBIN:
        raise ValueError("in a round robin everybody meets everybody: a match can be postponed instead")
    if name == other:
        raise ValueError("two different entrants exchange their places")
    drawn = next((one for one in progress.rounds if any(_is_open(progress, match) for match in one.fixtures)), None)
    if drawn is None:
        raise ValueError("no round is open")
    if _match_of(progress, drawn, name) == _match_of(progress, drawn, other) is not None:
        raise ValueError(f"{name} and {other} play each other")
    entrants = progress.entrants
    if form == Format.KNOCKOUT:
        lost = knockout.defeats(progress.as_field())
        if lost[name] != lost[other]:
            raise ValueError(f"{name} and {other} are not in the same bracket")
        if not lost[name]:  # whose next matches follow from the seeding
            both = {one.name: one for one in entrants}
            turned = {name: both[other], other: both[name]}
            entrants = tuple(turned.get(one.name, one) for one in entrants)
    turn = {name: other, other: name}
    fixtures = tuple(replace(one, entrants=_turned(one.entrants, turn)) for one in drawn.fixtures)
    fresh = replace(drawn, fixtures=fixtures, byes=_turned(drawn.byes, turn))
    rounds = tuple(fresh if one is drawn else one for one in progress.rounds)
    return replace(progress, entrants=entrants, rounds=rounds)


def seated(progress: "Progress", fixture: Fixture, entrants: Sequence[str]) -> "Progress":
    """With the entrants of a match that has not begun in this order of seats. Raises ValueError."""
    if fixture.number in progress.played:
        raise ValueError(f"match {fixture.number} has begun: extra matches keep its seats")
    if sorted(entrants) != sorted(fixture.entrants):
        raise ValueError(f"match {fixture.number} is between {', '.join(fixture.entrants)}, each with one seat")
    fresh = replace(fixture, entrants=tuple(entrants))
    rounds = tuple(
        replace(drawn, fixtures=tuple(fresh if one.number == fixture.number else one for one in drawn.fixtures))
        for drawn in progress.rounds
    )
    return replace(progress, rounds=rounds)


def _match_of(progress: "Progress", drawn: Round, name: str) -> int | None:
    """The open match of an entrant in a round; None for a bye. Raises ValueError if there is neither."""
    if name in drawn.byes:
        return None
    fixture = next((one for one in drawn.fixtures if name in one.entrants), None)
    if fixture is None:
        raise ValueError(f"{name} does not play in round {drawn.number}")
    if not _is_open(progress, fixture):
        raise ValueError(f"{name} has played in round {drawn.number}")
    return fixture.number


def _is_open(progress: "Progress", fixture: Fixture) -> bool:
    return fixture.number not in progress.played and fixture.number not in progress.outcomes


def _turned(names: Sequence[str], turn: dict[str, str]) -> tuple[str, ...]:
    return tuple(turn.get(name, name) for name in names)
