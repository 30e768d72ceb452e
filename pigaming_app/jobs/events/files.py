"""The file of an event, on the command line."""

import sys
from dataclasses import dataclass
from pathlib import Path

from pigaming_app.events import event_files
from pigaming_app.events.event import Event
from pigaming_app.jobs.terminal.options import JsonOption, argument, path
from pigaming_app.jobs.terminal.refusal import Refusal


@dataclass(frozen=True, kw_only=True)
class FileOption:
    """The file of the event."""

    file: Path = argument("the event", path, metavar="FILE")


@dataclass(frozen=True, kw_only=True)
class EventOptions(FileOption, JsonOption):
    """The event, and how it is printed."""


def loaded(file: Path) -> Event:
    """The event of a file; a damaged one is replaced by its backup. Raises Refusal."""
    event, problems = event_files.load(file)
    if event is None:
        raise Refusal(problems[-1] if problems else f"{file}: no such event")
    for problem in problems:
        print(f"PiGaming: {problem}", file=sys.stderr)
    return event
