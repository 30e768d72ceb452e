"""The user's drawings: saved arenas in `arenas/GAME/`, and in `drafts/GAME/` those with changes that are not saved.

A draft is written after every change, so that a power cut takes at most the last one.
"""

import contextlib
import logging
import re
import threading
from pathlib import Path

from pigaming_app.games.arenas import MOST_OWN, NAME, is_own_name, own_folder, read_source
from pigaming_app.games.drawing.values import Drawing, Part, drawing_of
from pigaming_app.sim.arena import MAX_TITLE
from pigaming_app.sim.toml_table import FieldError
from pigaming_app.storage.safe_files import NotSaved, write_atomic
from pigaming_app.storage.settings import folders
from pigaming_app.storage.trash import discard

NEW = re.compile(r"new-\d+")  # names of drawings that never had another
log = logging.getLogger("pigaming")


def drafts_folder(game: str) -> Path:
    """The folder of the drafts of a game. It may be missing."""
    return folders().data / "drafts" / game


def draft_file(game: str, name: str) -> Path:
    return drafts_folder(game) / f"{name}.toml"


def own_file(game: str, name: str) -> Path:
    return own_folder(game) / f"{name}.toml"


def own_names(game: str) -> list[str]:
    """The names of the user's arenas and drafts, the latest first, playable or not."""
    found: dict[str, float] = {}
    for folder in (own_folder(game), drafts_folder(game)):
        with contextlib.suppress(OSError):
            for path in folder.glob("*.toml"):
                if is_own_name(game, path.stem):
                    found[path.stem] = max(found.get(path.stem, 0.0), path.stat().st_mtime)
    return sorted(found, key=lambda name: -found[name])


def is_draft(game: str, name: str) -> bool:
    """True if a drawing has changes that are not saved."""
    return draft_file(game, name).exists()


def free_name(game: str) -> str:
    """A name for a new drawing."""
    taken = own_names(game)
    return next(name for k in range(1, len(taken) + 2) if (name := f"new-{k}") not in taken)


def opened(game: str, name: str) -> Drawing | None:
    """The user's drawing of a name, with changes that are not saved; None if no file of it can be read."""
    return _read(draft_file(game, name)) or _read(own_file(game, name))


def _read(path: Path) -> Drawing | None:
    """The drawing in a file; None without one, or if it cannot be read."""
    try:
        return drawing_of(read_source(path))
    except (OSError, UnicodeDecodeError, FieldError) as error:
        if path.exists():
            log.warning("%s: %s", path, error)
        return None


def title_of(drawing: Drawing, language: str) -> str:
    """The title of a drawing in a language; empty if it has none."""
    for part in drawing.of("title"):
        for key in (language, "en"):
            if isinstance(title := part.get(key), str) and title.isprintable() and len(title) <= MAX_TITLE:
                return title
    return ""


def titled(drawing: Drawing, title: str) -> Drawing:
    """A drawing with one title in all languages, which comes first."""
    part = Part("title", (("en", title[:MAX_TITLE]), ("pt", title[:MAX_TITLE])), several=False)
    return Drawing((part, *(other for other in drawing.parts if other.kind != "title")))


def file_name(title: str) -> str:
    """The name of the file of an arena with a title; empty if there can be none."""
    name = re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")[:40]
    return name if NAME.fullmatch(name) else ""


def is_full(game: str) -> bool:
    """True if no further arena would be listed."""
    try:
        return len(list(own_folder(game).glob("*.toml"))) >= MOST_OWN
    except OSError:
        return False


def save(game: str, name: str, drawing: Drawing, before: str) -> None:
    """Save an arena, in place of the draft `before`. Raises NotSaved."""
    write_atomic(own_file(game, name), drawing.text().encode())
    for draft in {name, before}:
        delete_draft(game, draft)


def rename(game: str, before: str, title: str) -> str:
    """Give an arena, and its draft, another title and the name that follows from it, which is returned.

    Whatever had that name goes to the trash. Raises NotSaved.
    """
    name = file_name(title)
    if name != before:
        discard(own_file(game, name), "arenas")
    for path_of in (own_file, draft_file):
        drawing = _read(path_of(game, before))
        if drawing:
            write_atomic(path_of(game, name), titled(drawing, title).text().encode())
        elif name != before:
            with contextlib.suppress(OSError):
                path_of(game, name).unlink(missing_ok=True)
    if name != before:
        delete_draft(game, before)
        with contextlib.suppress(OSError):
            own_file(game, before).unlink(missing_ok=True)
    return name


def export(game: str, name: str, drawing: Drawing) -> Path:
    """Write an arena as a file to share, and return its path. Raises NotSaved."""
    path = folders().data / "shared" / f"{game}-{name}.toml"
    write_atomic(path, drawing.text().encode())
    return path


def delete(game: str, name: str) -> None:
    """Move a drawing to the trash. Raises NotSaved if it remains."""
    delete_draft(game, name)
    discard(own_file(game, name), "arenas")


def delete_draft(game: str, name: str) -> None:
    with contextlib.suppress(OSError):
        draft_file(game, name).unlink(missing_ok=True)


class Autosave:
    """Writes drafts in a thread, the latest one last. `failed`: the last one could not be written."""

    def __init__(self, path: Path) -> None:
        self.path, self.failed = path, False
        self._text: str | None = None
        self._thread: threading.Thread | None = None
        self._lock = threading.Lock()

    def write(self, drawing: Drawing) -> None:
        """Write a draft soon."""
        with self._lock:
            self._text = drawing.text()
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, name="draft", daemon=False)
                self._thread.start()

    def finish(self) -> None:
        """Wait until the last draft is written."""
        thread = self._thread
        if thread is not None:
            thread.join()

    def _work(self) -> None:
        while (text := self._next()) is not None:
            try:
                write_atomic(self.path, text.encode())
                self.failed = False
            except NotSaved as error:
                log.warning("%s", error)
                self.failed = True

    def _next(self) -> str | None:
        with self._lock:
            text, self._text = self._text, None
            if text is None:
                self._thread = None
            return text
