"""A change of the event in a file, also while arcades play it."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from pigaming_app.events import event_files
from pigaming_app.events.event import Event
from pigaming_app.events.journal import Entry
from pigaming_app.jobs.events.files import FileOption, loaded
from pigaming_app.jobs.events.show import print_event
from pigaming_app.jobs.terminal.options import JsonOption, argument, integer
from pigaming_app.jobs.terminal.refusal import refused


@dataclass(frozen=True, kw_only=True)
class MatchOption(FileOption, JsonOption):
    """A match of an event."""

    match: int = argument("its number, as `event show` prints it", integer(), metavar="MATCH")


def change(file: Path, as_json: bool, action: Callable[[Event], Entry]) -> int:
    """Add the entry that an action makes of the event in the file, and print the event. Raises Refusal or NotSaved."""
    loaded(file)  # restores a damaged one
    with refused(ValueError):
        event = event_files.update(file, lambda event: event.after(action(event)))
    print_event(event, as_json)
    return 0
