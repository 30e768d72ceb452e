"""Replays in the data folder, at most LIMIT of them.

Saving one more deletes the oldest, but only files that the arcade itself has named, and none that is read-only.
"""

import errno
import logging
import os
import re
import secrets
import stat
from collections import deque
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from pigaming_app.ai.brain_files import display_name
from pigaming_app.games.game import Seat
from pigaming_app.games.moments import CLOSE, KINDS, Moment
from pigaming_app.games.replay import Replay, ReplayError
from pigaming_app.scenes.features.replays import pack
from pigaming_app.scenes.files import load_replay
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.storage.safe_files import NotSaved, write_atomic
from pigaming_app.storage.settings import folders
from pigaming_app.storage.trash import discard

LIMIT = 100  # files
DATE = "%Y-%m-%d_%H-%M-%S"
OWN_NAME = re.compile(r"(\d{4}-\d\d-\d\d_\d\d-\d\d-\d\d)_[a-z]+_[a-z0-9-]+(_\d+)?\.replay")

log = logging.getLogger("pigaming")
KEPT = 8  # matches in memory
Highlight = tuple[Replay, Moment]


class StoreError(Exception):
    """A replay could not be saved or deleted; the message is a text key."""


def folder() -> Path:
    """The folder of the replays; it may not exist yet."""
    return folders().data / "replays"


def paths(place: Path | None = None) -> list[Path]:
    """All replays, or those of another folder, the latest first."""
    try:
        found = [
            path for path in (place or folder()).iterdir() if path.suffix == ".replay" and not path.name.startswith(".")
        ]
    except FileNotFoundError:
        return []
    except OSError as error:
        log.warning("%s", error)
        return []
    return sorted(found, key=lambda path: (saved_at(path), path.name), reverse=True)


def saved_at(path: Path) -> datetime:
    """The local time in the name of a replay, or of the last change of a file with another name."""
    named = OWN_NAME.fullmatch(path.name)
    try:
        return datetime.strptime(named[1], DATE) if named else datetime.fromtimestamp(path.stat().st_mtime)
    except (OSError, ValueError, OverflowError):
        return datetime.fromtimestamp(0)


def save(replay: Replay, now: datetime | None = None) -> Path:
    """Write a replay and delete the oldest ones beyond the limit. Raises StoreError."""
    path = free_name(folder(), replay, now or datetime.now())
    excess = [path for path in reversed(paths()) if _deletable(path)][: max(0, len(paths()) + 1 - LIMIT)]
    if len(paths()) + 1 - len(excess) > LIMIT:
        raise StoreError("replays.all_kept")
    write(path, replay)
    for old in excess:
        try:
            old.unlink()
        except OSError as error:
            log.warning("%s: %s", old, error)
    return path


def write(path: Path, replay: Replay) -> None:
    """Write a replay. Raises StoreError."""
    try:
        write_atomic(path, pack(replay))
    except NotSaved as error:
        log.warning("%s", error)
        full = error.errno in (errno.ENOSPC, errno.EDQUOT)
        raise StoreError("replays.disk_full" if full else "replays.no_writing") from error


def delete(path: Path) -> None:
    """Move a replay to the trash. Raises StoreError; a file that has already vanished is no error."""
    try:
        discard(path, "replays")
    except NotSaved as error:
        log.warning("%s: %s", path, error)
        raise StoreError("replays.not_deleted") from error


def load(path: Path) -> Replay | None:
    """Read a replay; None, with a line in the log, if it is damaged or has vanished."""
    try:
        return load_replay(path)
    except ReplayError as error:
        log.warning("%s", error)
        return None


def free_name(place: Path, replay: Replay, now: datetime) -> Path:
    """A new name of date, game and players in a folder."""
    stem = f"{now:{DATE}}_{replay.setup.game}_{_players(replay.setup.seats)}"
    names = [stem, *(f"{stem}_{number}" for number in range(2, LIMIT + 2))]
    return next(path for path in (place / f"{name}.replay" for name in names) if not os.path.lexists(path))


def _players(seats: Sequence[Seat]) -> str:
    """The players of the seats, in lower-case letters, digits and hyphens."""
    players = "-".join(display_name(seat.brain) for seat in seats if seat.brain != "off")
    return re.sub(r"[^a-z0-9-]+", "-", players.lower())


def _deletable(path: Path) -> bool:
    """True for a writable file with a name of the arcade."""
    try:
        return bool(OWN_NAME.fullmatch(path.name)) and bool(path.lstat().st_mode & stat.S_IWUSR)
    except OSError:
        return False


class Highlights:
    """The pool. Kinds of moments take turns; of close finishes the closest is chosen, else one at random."""

    def __init__(self) -> None:
        self.played: deque[Replay] = deque(maxlen=KEPT)
        self._turn = 0

    def add(self, replay: Replay) -> None:
        """Keep a match that has just been played, if it has moments."""
        if replay.moments:
            self.played.append(replay)

    def next(self) -> Highlight | None:
        """The next highlight, with one saved replay chosen at random among the candidates; None if there is none."""
        replays = [*self.played, *self._saved()]
        for _ in KINDS:
            kind = KINDS[self._turn % len(KINDS)]
            self._turn += 1
            found = [(replay, one) for replay in replays for one in replay.moments if one.kind == kind]
            if found:
                closest = min(found, key=lambda highlight: highlight[1].lead)
                return closest if kind == CLOSE else secrets.choice(found)
        return None

    def _saved(self) -> list[Replay]:
        """One saved replay, if there is any that plays out as recorded."""
        saved = paths()
        replay = load(secrets.choice(saved)) if saved else None
        return [replay] if replay and not replay.other_engine else []


def highlights(context: Context) -> Highlights:
    """Those of a context, for attract mode: `context.shared(highlights)`."""
    return Highlights()
