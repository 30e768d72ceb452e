"""Tournaments and Grand Prix: knock-out, round robin, Swiss. A file holds the whole event."""

from argparse import ArgumentParser, Namespace

from pigaming_app.jobs.event import export, new, play, show

WORDS = {"new": new, "run": play, "show": show, "export": export}


def options(parser: ArgumentParser) -> None:
    """Declare a sub-command for each word."""
    words = parser.add_subparsers(dest="word", metavar="WORD", required=True)
    for name, module in WORDS.items():
        about = (module.__doc__ or "").partition("\n\n")[0].replace("\n", " ")
        short = about[0].lower() + about[1:].rstrip(".")
        module.options(words.add_parser(name, help=short, description=about, allow_abbrev=False))


def run(arguments: Namespace) -> int:
    """Run the sub-command. Raises Refusal or NotSaved."""
    return int(WORDS[arguments.word].run(arguments))
