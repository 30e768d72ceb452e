"""Withdraw an entrant, who plays no more; open matches of two are walkovers."""

from dataclasses import dataclass

from pigaming_app.events.journal import Withdrawn
from pigaming_app.jobs.events.changes.changing import change
from pigaming_app.jobs.events.files import FileOption
from pigaming_app.jobs.terminal.options import JsonOption, argument, word


@dataclass(frozen=True, kw_only=True)
class WithdrawOptions(FileOption, JsonOption):
    """Who withdraws."""

    name: str = argument("the entrant", word, metavar="NAME")


def run(options: WithdrawOptions) -> int:
    """Withdraw an entrant. Raises Refusal or NotSaved."""
    return change(options.file, options.json, lambda _: Withdrawn(options.name))
