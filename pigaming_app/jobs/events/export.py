"""Standings and matches of an event as files for other programs."""

import json
import os
from argparse import ArgumentParser, Namespace
from pathlib import Path

from pigaming_app.events.event import Event
from pigaming_app.events.exports import matches_csv, plain, standings_csv
from pigaming_app.jobs.events.files import file_option, loaded
from pigaming_app.jobs.terminal.options import path
from pigaming_app.jobs.terminal.refusal import Refusal, require
from pigaming_app.storage.parsing import quote
from pigaming_app.storage.safe_files import write_all_atomic


def options(parser: ArgumentParser) -> None:
    file_option(parser)
    parser.add_argument("--csv", type=path, metavar="OUT", help="the table")
    parser.add_argument("--matches", type=path, metavar="OUT", help="all matches as CSV")
    parser.add_argument("--json", type=path, metavar="OUT", help="everything as JSON")
    parser.add_argument(
        "--poster",
        type=path,
        metavar="OUT",
        help="A4: NAME.png, a file a page, or NAME.pdf (extra `events`)",
    )


def run(arguments: Namespace) -> int:
    """Write the files. Raises Refusal or NotSaved."""
    event = loaded(arguments.file)
    writers = (
        (arguments.csv, standings_csv),
        (arguments.matches, matches_csv),
        (arguments.json, lambda event: json.dumps(plain(event), indent=1, ensure_ascii=False) + "\n"),
    )
    wanted = [(target, writer) for target, writer in writers if target is not None]
    if not wanted and arguments.poster is None:
        raise Refusal("--csv, --matches, --json or --poster with the name of a file is needed")
    texts = [(target, writer(event).encode("utf-8")) for target, writer in wanted]
    files = [*texts, *(_poster(event, arguments.poster).items() if arguments.poster else ())]
    names = [os.path.realpath(name) for name in (arguments.file, *(target for target, _ in files))]
    if len({*names}) < len(names):
        raise Refusal("every file needs a name of its own")
    write_all_atomic(dict(files))
    return 0


def _poster(event: Event, target: Path) -> dict[Path, bytes]:
    """The files of the poster, in the language of the arcade. Raises Refusal."""
    suffix = target.suffix.lower()
    if suffix not in (".png", ".pdf"):
        raise Refusal(f"--poster: {quote(target.name)} is not the name of a .png or .pdf file")
    if suffix == ".pdf":
        require("events")
    from pigaming_app.scenes.events.poster import drawn, encoded
    from pigaming_app.storage.settings import Settings, folders
    from pigaming_app.ui.i18n import Words

    settings, _ = Settings.load(folders().config)
    return encoded(drawn(event, Words(settings.language)), target)
