"""What happens in an event, one entry after the other. Spec and journal together are the whole event."""

from msgspec import Struct

from pigaming_app.events.spec import Entrant, Result
from pigaming_app.storage.schema import Line


class Recorded(Struct, frozen=True, tag_field="entry", tag="result"):
    """The result of a match."""

    outcome: Result


class Corrected(Struct, frozen=True, tag_field="entry", tag="correction"):
    """A result in place of a recorded one; its note gives the reason."""

    outcome: Result


class Added(Struct, frozen=True, tag_field="entry", tag="late"):
    """A late entrant."""

    entrant: Entrant


class Withdrawn(Struct, frozen=True, tag_field="entry", tag="withdrawal"):
    """An entrant who will not play any more."""

    name: Line


class Postponed(Struct, frozen=True, tag_field="entry", tag="postponement"):
    """A match that others overtake, by its number."""

    fixture: int


class Substituted(Struct, frozen=True, tag_field="entry", tag="substitute"):
    """An AI drives for an entrant from now on; an empty brain: the person is back."""

    name: Line
    brain: Line


class Swapped(Struct, frozen=True, tag_field="entry", tag="swap"):
    """Two entrants exchange their places in the round that is open."""

    name: Line
    other: Line


class Reseated(Struct, frozen=True, tag_field="entry", tag="seats"):
    """The entrants of a match in the order of their seats."""

    fixture: int
    entrants: tuple[Line, ...]


class Summoned(Struct, frozen=True, tag_field="entry", tag="call"):
    """A match is called to an arcade; an empty name: the only one. None: the call is taken back."""

    fixture: int
    arcade: Line | None


class Paused(Struct, frozen=True, tag_field="entry", tag="break"):
    """A break begins, during which no match is called; the note says until when, or why."""

    note: Line = ""


class Resumed(Struct, frozen=True, tag_field="entry", tag="resumption"):
    """The break ends."""


class Arranged(Struct, frozen=True, tag_field="entry", tag="arrangement"):
    """Those who want to play a match, in a format on call; of a challenge, the challenger first."""

    entrants: tuple[Line, ...]


class Closed(Struct, frozen=True, tag_field="entry", tag="close"):
    """A day or a week of a format on call is over."""


Entry = (
    Recorded
    | Corrected
    | Added
    | Withdrawn
    | Postponed
    | Substituted
    | Swapped
    | Reseated
    | Summoned
    | Paused
    | Resumed
    | Arranged
    | Closed
)
