"""What happens in an event, one entry after the other. Spec and journal together are the whole event."""

from dataclasses import dataclass

from pigaming_app.events.spec import Entrant, Outcome


@dataclass(frozen=True)
class Recorded:
    """The result of a match."""

    outcome: Outcome


@dataclass(frozen=True)
class Corrected:
    """A result in place of a recorded one; its note gives the reason."""

    outcome: Outcome


@dataclass(frozen=True)
class Added:
    """A late entrant."""

    entrant: Entrant


@dataclass(frozen=True)
class Withdrawn:
    """An entrant who will not play any more."""

    name: str


@dataclass(frozen=True)
class Postponed:
    """A match that others overtake, by its number."""

    fixture: int


@dataclass(frozen=True)
class Substituted:
    """An AI drives for an entrant from now on; an empty brain: the person is back."""

    name: str
    brain: str


Entry = Recorded | Corrected | Added | Withdrawn | Postponed | Substituted
