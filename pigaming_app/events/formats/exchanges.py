"""Two entrants who exchange their places in the draw, and the seats of a match."""

from collections.abc import Container, Sequence
from dataclasses import replace

from pigaming_app.events.formats import knockout
from pigaming_app.events.formats.field import EntrantField
from pigaming_app.events.formats.registry import KINDS
from pigaming_app.events.refusals import Refused
from pigaming_app.events.spec import Fixture, Format, Round

Played = Container[int]  # numbers of matches that have begun


def swapped(field: EntrantField, played: Played, name: str, other: str) -> tuple[tuple[str, ...], tuple[Round, ...]]:
    """The seeding and the rounds with two entrants in each other's place in the first round that is open.

    A bye is a place, too. In the winners' bracket of a knock-out they keep the places to its end. Raises Refused.
    """
    form = field.spec.format
    if KINDS[form].on_call:
        raise Refused("undrawn")
    if not KINDS[form].exchanges:
        raise Refused("all_meet")
    if name == other:
        raise Refused("same")
    drawn = next((one for one in field.rounds if any(_is_open(field, played, match) for match in one.fixtures)), None)
    if drawn is None:
        raise Refused("no_round")
    if _match_of(field, played, drawn, name) == _match_of(field, played, drawn, other) is not None:
        raise Refused("opponents", name=name, other=other)
    turn, seeding = {name: other, other: name}, field.entrants
    if form == Format.KNOCKOUT:
        lost = knockout.defeats(field)
        if lost[name] != lost[other]:
            raise Refused("brackets", name=name, other=other)
        if not lost[name]:  # whose next matches follow from the seeding
            seeding = _turned(seeding, turn)
    fixtures = tuple(replace(one, entrants=_turned(one.entrants, turn)) for one in drawn.fixtures)
    fresh = replace(drawn, fixtures=fixtures, byes=_turned(drawn.byes, turn))
    return seeding, tuple(fresh if one is drawn else one for one in field.rounds)


def seated(rounds: Sequence[Round], played: Played, fixture: Fixture, entrants: Sequence[str]) -> tuple[Round, ...]:
    """The rounds with the entrants of a match that has not begun in this order of seats. Raises Refused."""
    if fixture.number in played:
        raise Refused("begun", match=fixture.number)
    if sorted(entrants) != sorted(fixture.entrants):
        raise Refused("one_seat", match=fixture.number, names=", ".join(fixture.entrants))
    fresh = replace(fixture, entrants=tuple(entrants))
    return tuple(
        replace(drawn, fixtures=tuple(fresh if one.number == fixture.number else one for one in drawn.fixtures))
        for drawn in rounds
    )


def _match_of(field: EntrantField, played: Played, drawn: Round, name: str) -> int | None:
    """The open match of an entrant in a round; None for a bye. Raises Refused if there is neither."""
    if name in drawn.byes:
        return None
    fixture = next((one for one in drawn.fixtures if name in one.entrants), None)
    if fixture is None:
        raise Refused("no_place", name=name, round=drawn.number)
    if not _is_open(field, played, fixture):
        raise Refused("round_played", name=name, round=drawn.number)
    return fixture.number


def _is_open(field: EntrantField, played: Played, fixture: Fixture) -> bool:
    return fixture.number not in played and fixture.number not in field.outcomes


def _turned(names: Sequence[str], turn: dict[str, str]) -> tuple[str, ...]:
    return tuple(turn.get(name, name) for name in names)
