"""Choose the seats of a match: seat 1 is that of the first pad."""

from dataclasses import dataclass

from pigaming_app.events.changes import actions
from pigaming_app.jobs.events.changes.changing import MatchOption, change
from pigaming_app.jobs.terminal.options import argument, word


@dataclass(frozen=True, kw_only=True)
class SeatOptions(MatchOption):
    """The match and its seats."""

    seats: tuple[str, ...] = argument("A=2 B=1; the others keep their order", word, nargs="+", metavar="NAME=SEAT")


def run(options: SeatOptions) -> int:
    """Change the seats of an open match. Raises Refusal or NotSaved."""
    return change(options.file, options.json, lambda event: actions.seats(event, options.match, options.seats))
