"""Enter a late entrant, until a match of round two has been played."""

from dataclasses import dataclass

from pigaming_app.events.changes import actions
from pigaming_app.jobs.events.changes.changing import change
from pigaming_app.jobs.events.files import FileOption
from pigaming_app.jobs.terminal.options import JsonOption, argument, word
from pigaming_app.jobs.terminal.refusal import require_for_brains


@dataclass(frozen=True, kw_only=True)
class EnterOptions(FileOption, JsonOption):
    """Who comes late."""

    entrant: str = argument("NAME, NAME/TEAM, NAME=AI or NAME/TEAM=AI", word, metavar="NAME[/TEAM][=AI]")


def run(options: EnterOptions) -> int:
    """Add an entrant. Raises Refusal or NotSaved."""
    require_for_brains([options.entrant.partition("=")[2]])
    return change(options.file, options.json, lambda event: actions.entered(event, options.entrant))
