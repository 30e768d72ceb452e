"""Let two entrants exchange their places in the round that is open, as far as they have not played in it."""

from dataclasses import dataclass

from pigaming_app.events.journal import Swapped
from pigaming_app.jobs.events.changes.changing import change
from pigaming_app.jobs.events.files import FileOption
from pigaming_app.jobs.terminal.options import JsonOption, argument, word


@dataclass(frozen=True, kw_only=True)
class SwapOptions(FileOption, JsonOption):
    """The two."""

    name: str = argument("an entrant", word, metavar="A")
    other: str = argument("another one", word, metavar="B")


def run(options: SwapOptions) -> int:
    """Exchange two entrants. Raises Refusal or NotSaved."""
    return change(options.file, options.json, lambda _: Swapped(options.name, options.other))
