"""Tournaments and Grand Prix: knock-out, round robin, Swiss. A file holds the whole event."""

from argparse import ArgumentParser, Namespace

from pigaming_app.jobs.events import export, new, play, show
from pigaming_app.jobs.terminal.options import subcommands

WORDS = {"new": new, "run": play, "show": show, "export": export}


def options(parser: ArgumentParser) -> None:
    subcommands(parser, "word", WORDS)


def run(arguments: Namespace) -> int:
    """Run the sub-command. Raises Refusal or NotSaved."""
    return int(WORDS[arguments.word].run(arguments))
