"""Call a match to an arcade, or take the call back."""

from dataclasses import dataclass

from pigaming_app.events.journal import Summoned
from pigaming_app.jobs.events.changes.changing import MatchOption, change
from pigaming_app.jobs.terminal.options import argument, flag, word
from pigaming_app.jobs.terminal.refusal import Refusal


@dataclass(frozen=True, kw_only=True)
class CallOptions(MatchOption):
    """The match and where it is played."""

    arcade: str = argument("name of the arcade, as `event run --arcade`; none: the only one", word, "", nargs="?")
    off: bool = flag("take the call back")


def run(options: CallOptions) -> int:
    """Call a match. Raises Refusal or NotSaved."""
    if options.off and options.arcade:
        raise Refusal("event call: --off goes without the name of an arcade")
    arcade = None if options.off else options.arcade
    return change(options.file, options.json, lambda _: Summoned(options.match, arcade))
