"""Enter the result of a match that was played elsewhere."""

from dataclasses import dataclass

from pigaming_app.events.changes import actions
from pigaming_app.jobs.events.changes.changing import MatchOption, change
from pigaming_app.jobs.terminal.options import argument, word

PLACES = "scores, A=3 B=1: more is better; or places, A B: best first, and A+B share one"


@dataclass(frozen=True, kw_only=True)
class ResultOptions(MatchOption):
    """The match and its result."""

    places: tuple[str, ...] = argument(PLACES, word, nargs="+", metavar="ENTRANT")


def run(options: ResultOptions) -> int:
    """Record the result of an open match, or of the extra match that it needs. Raises Refusal or NotSaved."""
    return change(options.file, options.json, lambda event: actions.recorded(event, options.match, options.places))
