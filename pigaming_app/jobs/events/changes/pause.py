"""Begin a break, in which no match is called, or end it."""

from dataclasses import dataclass

from pigaming_app.events.changes.actions import MAX_NOTE
from pigaming_app.events.journal import Paused, Resumed
from pigaming_app.jobs.events.changes.changing import change
from pigaming_app.jobs.events.files import FileOption
from pigaming_app.jobs.terminal.options import JsonOption, argument, flag, word
from pigaming_app.jobs.terminal.refusal import Refusal


@dataclass(frozen=True, kw_only=True)
class PauseOptions(FileOption, JsonOption):
    """The break."""

    note: str = argument("what everybody reads, as `until 11:30`", word, "", nargs="?", metavar="TEXT")
    off: bool = flag("end the break")


def run(options: PauseOptions) -> int:
    """Begin or end a break. Raises Refusal or NotSaved."""
    if options.off and options.note:
        raise Refusal("event break: --off goes without a text")
    entry = Resumed() if options.off else Paused(options.note[:MAX_NOTE])
    return change(options.file, options.json, lambda _: entry)
