"""Standings and matches of an event as files for other programs."""

import json
import os
from argparse import ArgumentParser, Namespace

from pigaming_app.events.exports import matches_csv, plain, standings_csv
from pigaming_app.jobs.event.files import file_option, loaded
from pigaming_app.jobs.terminal.options import path
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.storage.safe_files import write_all_atomic


def options(parser: ArgumentParser) -> None:
    file_option(parser)
    parser.add_argument("--csv", type=path, metavar="OUT", help="the table")
    parser.add_argument("--matches", type=path, metavar="OUT", help="all matches as CSV")
    parser.add_argument("--json", type=path, metavar="OUT", help="everything as JSON")


def run(arguments: Namespace) -> int:
    """Write the files. Raises Refusal or NotSaved."""
    event = loaded(arguments.file)
    writers = (
        (arguments.csv, standings_csv),
        (arguments.matches, matches_csv),
        (arguments.json, lambda event: json.dumps(plain(event), indent=1, ensure_ascii=False) + "\n"),
    )
    wanted = [(target, writer) for target, writer in writers if target is not None]
    if not wanted:
        raise Refusal("--csv, --matches or --json with the name of a file is needed")
    names = [os.path.realpath(name) for name in (arguments.file, *(target for target, _ in wanted))]
    if len({*names}) < len(names):
        raise Refusal("every file needs a name of its own")
    write_all_atomic({target: writer(event).encode("utf-8") for target, writer in wanted})
    return 0
