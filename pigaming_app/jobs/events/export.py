"""Standings and matches of an event as files for other programs."""

import json
import os
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from pigaming_app.events.event import Event
from pigaming_app.events.exports import matches_csv, plain, standings_csv
from pigaming_app.jobs.events.files import FileOption, loaded
from pigaming_app.jobs.terminal.options import integer, option, path
from pigaming_app.jobs.terminal.refusal import Refusal, require
from pigaming_app.storage.parsing import describe_error, quote
from pigaming_app.storage.safe_files import write_all_atomic

if TYPE_CHECKING:
    from pigaming_app.ui.i18n import Words


@dataclass(frozen=True, kw_only=True)
class ExportOptions(FileOption):
    """The files to write."""

    csv: Path | None = option("the table, for spreadsheets in the language of the arcade", path, metavar="OUT")
    matches: Path | None = option("all matches, alike", path, metavar="OUT")
    json: Path | None = option("everything as JSON", path, metavar="OUT")
    site: Path | None = option("the public page as a folder of files, in all languages", path, metavar="FOLDER")
    poster: Path | None = option("A4: NAME.png, a file a page, or NAME.pdf (extra `events`)", path, metavar="OUT")
    certificates: Path | None = option("A4: NAME.pdf, a page for each entrant (extra `events`)", path, metavar="OUT")
    places: int = option("with --certificates: for the first ones only", integer(1), 0, metavar="NUMBER")


def run(options: ExportOptions) -> int:
    """Write the files. Raises Refusal or NotSaved."""
    event = loaded(options.file)
    if options.places and not options.certificates:
        raise Refusal("--places goes with --certificates")
    comma, files = _words().decimal(".") == ",", []
    for target, table in ((options.csv, standings_csv), (options.matches, matches_csv)):
        if target:
            files.append((target, table(event, comma).encode("utf-8-sig")))  # without a byte order mark Excel guesses
    if options.json:
        text = json.dumps(plain(event), indent=1, ensure_ascii=False) + "\n"
        files.append((options.json, text.encode("utf-8")))
    if options.poster:
        files += _poster(event, options.poster).items()
    if options.certificates:
        files += _certificates(event, options.certificates, options.places).items()
    if options.site:
        files += _site(event, options.site).items()
    if not files:
        named = "--csv, --matches, --json, --poster or --certificates"
        raise Refusal(f"{named} with the name of a file is needed, or --site with a folder")
    names = [os.path.realpath(name) for name in (options.file, *(target for target, _ in files))]
    if len({*names}) < len(names):
        raise Refusal("every file needs a name of its own")
    write_all_atomic(dict(files))
    return 0


def _words() -> "Words":
    """The texts of the language of the arcade."""
    from pigaming_app.storage.settings import Settings, folders
    from pigaming_app.ui.i18n import Words

    settings, _ = Settings.load(folders().config)
    return Words(settings.language)


def _site(event: Event, folder: Path) -> dict[Path, bytes]:
    """The files of the public page."""
    from pigaming_app.scenes.events.desk.site import site

    found = site(event, _words().language, datetime.now())
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise Refusal(f"--site {quote(str(folder))}: {describe_error(error)}") from None
    return {folder / name: content for name, content in found.items()}


def _poster(event: Event, target: Path) -> dict[Path, bytes]:
    """The files of the poster. Raises Refusal."""
    suffix = target.suffix.lower()
    if suffix not in (".png", ".pdf"):
        raise Refusal(f"--poster: {quote(target.name)} is not the name of a .png or .pdf file")
    if suffix == ".pdf":
        require("events")
    from pigaming_app.scenes.events.paper.poster import poster
    from pigaming_app.scenes.events.paper.sheet import encoded

    return encoded(poster(event, _words()), [target])


def _certificates(event: Event, target: Path, places: int) -> dict[Path, bytes]:
    """The file of the certificates. Raises Refusal."""
    if target.suffix.lower() != ".pdf":
        raise Refusal(f"--certificates: {quote(target.name)} is not the name of a .pdf file")
    if not any(row.played for row in event.standings):
        raise Refusal("--certificates: no match has been played")
    require("events")
    from pigaming_app.scenes.events.paper.certificates import certificates
    from pigaming_app.scenes.events.paper.sheet import encoded

    return encoded(certificates(event, _words(), places), [target])
