"""A knock-out as it could go on: who wins is made up, how many matches each round to come has is not."""

from pigaming_app.events.event import Event
from pigaming_app.events.formats.knockout import FINAL, defeats
from pigaming_app.events.spec import Fixture, Outcome


def outlook(event: Event) -> Event:
    """The event at its end, as if the first of each match won; of the final the one who has lost, so that both finals
    are there.
    """
    while event.open:
        event = event.record(_made_up(event, event.open[0]))
    return event


def is_settled(event: Event, shown: Event, fixture: Fixture, name: str) -> bool:
    """True if it is certain that an entrant plays this match of the outlook `shown`: all matches before are decided."""
    before = (one for one in shown.fixtures if one.number < fixture.number and name in one.entrants)
    return all(one.number in event.outcomes for one in before)


def _made_up(event: Event, fixture: Fixture) -> Outcome:
    order = fixture.entrants
    if fixture.stage == FINAL:
        lost = defeats(event.progress.as_field())
        order = tuple(sorted(order, key=lambda name: -lost[name]))
    return Outcome(fixture.number, tuple((name,) for name in order), extra=fixture.extra)
