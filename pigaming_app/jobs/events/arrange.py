"""Arrange a match of those who want to play: a challenge, the challenger first, or a try.

For formats without a draw: challenge ladder, time trial, high score.
"""

from dataclasses import dataclass
from datetime import date

from pigaming_app.events import event_files
from pigaming_app.events.changes import calendar
from pigaming_app.jobs.events.files import FileOption, loaded
from pigaming_app.jobs.events.show import print_event
from pigaming_app.jobs.terminal.options import JsonOption, argument
from pigaming_app.jobs.terminal.refusal import refused


@dataclass(frozen=True, kw_only=True)
class ArrangeOptions(FileOption, JsonOption):
    """The event, and who plays."""

    names: tuple[str, ...] = argument("entrants; of a challenge, the challenger first", metavar="NAME", nargs="+")


def run(options: ArrangeOptions) -> int:
    """Write the match into the file. Raises Refusal or NotSaved."""
    known = loaded(options.file)
    with refused(ValueError):
        event = event_files.update(
            options.file, lambda event: calendar.up_to(event, date.today()).arrange(*options.names), known
        )
    print_event(event, options.json)
    return 0
