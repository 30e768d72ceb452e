"""End the week of a challenge ladder, or the day of a time trial or a high score. Open matches lapse."""

from dataclasses import dataclass

from pigaming_app.events import event_files
from pigaming_app.events.event import Event
from pigaming_app.jobs.events.files import FileOption, loaded
from pigaming_app.jobs.events.show import print_event
from pigaming_app.jobs.terminal.options import JsonOption
from pigaming_app.jobs.terminal.refusal import refused


@dataclass(frozen=True, kw_only=True)
class CloseOptions(FileOption, JsonOption):
    """The event whose week or day is over."""


def run(options: CloseOptions) -> int:
    """Write the end into the file. Raises Refusal or NotSaved."""
    known = loaded(options.file)
    with refused(ValueError):
        event = event_files.update(options.file, Event.close, known)
    print_event(event, options.json)
    return 0
