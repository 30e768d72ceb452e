"""Enter a late entrant, until a match of round two has been played."""

from collections.abc import Sequence
from dataclasses import dataclass

from pigaming_app.events.changes import actions
from pigaming_app.events.spec import Entrant
from pigaming_app.jobs.events.changes.changing import change
from pigaming_app.jobs.events.files import FileOption
from pigaming_app.jobs.events.new import require_brain, with_whole_path
from pigaming_app.jobs.terminal.options import JsonOption, argument, word


@dataclass(frozen=True, kw_only=True)
class EnterOptions(FileOption, JsonOption):
    """Who comes late."""

    entrant: str = argument("NAME, NAME/TEAM, NAME=AI or NAME/TEAM=AI", word, metavar="NAME[/TEAM][=AI]")


def run(options: EnterOptions) -> int:
    """Add an entrant. Raises Refusal or NotSaved."""
    return change(options.file, options.json, lambda event: actions.entered(event, options.entrant, _complete))


def _complete(entrant: Entrant, games: Sequence[str]) -> Entrant:
    if entrant.brain:
        require_brain(entrant.brain, games)
    return with_whole_path(entrant)
