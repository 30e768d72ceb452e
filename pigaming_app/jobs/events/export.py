"""Standings and matches of an event as files for other programs."""

import json
import os
from dataclasses import dataclass
from pathlib import Path

from pigaming_app.events.event import Event
from pigaming_app.events.exports import matches_csv, plain, standings_csv
from pigaming_app.jobs.events.files import FileOption, loaded
from pigaming_app.jobs.terminal.options import option, path
from pigaming_app.jobs.terminal.refusal import Refusal, require
from pigaming_app.storage.parsing import quote
from pigaming_app.storage.safe_files import write_all_atomic


@dataclass(frozen=True, kw_only=True)
class ExportOptions(FileOption):
    """The files to write."""

    csv: Path | None = option("the table", path, metavar="OUT")
    matches: Path | None = option("all matches as CSV", path, metavar="OUT")
    json: Path | None = option("everything as JSON", path, metavar="OUT")
    poster: Path | None = option("A4: NAME.png, a file a page, or NAME.pdf (extra `events`)", path, metavar="OUT")


def run(options: ExportOptions) -> int:
    """Write the files. Raises Refusal or NotSaved."""
    event = loaded(options.file)
    writers = (
        (options.csv, standings_csv),
        (options.matches, matches_csv),
        (options.json, lambda event: json.dumps(plain(event), indent=1, ensure_ascii=False) + "\n"),
    )
    wanted = [(target, writer) for target, writer in writers if target is not None]
    if not wanted and options.poster is None:
        raise Refusal("--csv, --matches, --json or --poster with the name of a file is needed")
    texts = [(target, writer(event).encode("utf-8")) for target, writer in wanted]
    files = [*texts, *(_poster(event, options.poster).items() if options.poster else ())]
    names = [os.path.realpath(name) for name in (options.file, *(target for target, _ in files))]
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
    from pigaming_app.scenes.events.paper.poster import drawn, encoded
    from pigaming_app.storage.settings import Settings, folders
    from pigaming_app.ui.i18n import Words

    settings, _ = Settings.load(folders().config)
    return encoded(drawn(event, Words(settings.language)), target)
