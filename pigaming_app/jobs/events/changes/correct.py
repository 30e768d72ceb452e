"""Replace the result of a match that has been played, for a reason that the file keeps."""

from dataclasses import dataclass

from pigaming_app.events.changes import actions
from pigaming_app.jobs.events.changes.changing import change
from pigaming_app.jobs.events.changes.result import ResultOptions
from pigaming_app.jobs.terminal.options import option, word


@dataclass(frozen=True, kw_only=True)
class CorrectOptions(ResultOptions):
    """The match, its right result, and why it was wrong."""

    reason: str = option("why; it stays in the file", word, required=True, metavar="TEXT")


def run(options: CorrectOptions) -> int:
    """Correct a result. Raises Refusal or NotSaved."""
    return change(
        options.file,
        options.json,
        lambda event: actions.corrected(event, options.match, options.places, options.reason),
    )
