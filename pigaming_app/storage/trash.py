"""The trash: what people delete stays in the data folder for 30 days, and can be brought back.

`trash/TIME/PLACE` holds a file that lay at PLACE in the data folder, with its backup. Nothing else is written: a full
disk does not keep anybody from deleting.
"""

import contextlib
import logging
import re
import shutil
from dataclasses import dataclass
from datetime import datetime, timedelta
from itertools import count
from pathlib import Path

from pigaming_app.storage.parsing import describe_error
from pigaming_app.storage.safe_files import NotSaved, backup_of
from pigaming_app.storage.settings import folders

FOLDER = "trash"  # below the data folder
KEPT = timedelta(days=30)
LONGEST_NAMES = {"robots": 6}  # characters, where a kind of files has a limit
_TIME = "%Y%m%d-%H%M%S-%f"
_SET = datetime(2026, 1, 1)  # a clock that is earlier was never set

log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class Deleted:
    """A file in the trash. `place`: where it lay, relative to the data folder."""

    path: Path
    place: Path
    at: datetime

    @property
    def kind(self) -> str:
        """The folder of its kind: events, arenas, robots, replays."""
        return self.place.parts[0]

    @property
    def name(self) -> str:
        return self.place.stem

    def days_left(self, now: datetime) -> int:
        """Whole days until it is gone."""
        return max(0, (self.at + KEPT - now).days)


def discard(path: Path, kind: str) -> None:
    """Move a file, and its backup, to the trash; it may be gone already. `kind`: its folder, if it lies elsewhere than
    in the data folder. Raises NotSaved if it is still there.
    """
    data, now = folders().data, datetime.now()
    place = path.absolute().relative_to(data) if path.absolute().is_relative_to(data) else Path(kind, path.name)
    try:
        for moved in (backup_of(path), path):
            if moved.exists():
                there = data / FOLDER / now.strftime(_TIME) / place.with_name(moved.name)
                there.parent.mkdir(parents=True, exist_ok=True)
                shutil.move(moved, there)
    except OSError as error:
        raise NotSaved(f"{path} was not deleted: {describe_error(error)}.") from error


def deleted() -> list[Deleted]:
    """Everything in the trash, what was deleted last first."""
    found = []
    for folder, at in _times():
        for path in folder.rglob("*"):
            place = path.relative_to(folder)
            if path.is_file() and not path.is_symlink() and path.suffix != ".bak" and len(place.parts) > 1:
                found.append(Deleted(path, place, at))
    return sorted(found, key=lambda one: (one.at, one.place), reverse=True)


def restore(one: Deleted) -> Path:
    """Bring a file back to its place, under another name if that is taken. Raises NotSaved."""
    data = folders().data
    place = data / one.place
    most = LONGEST_NAMES.get(one.kind, 60)
    names = (f"{one.name[: most - len(str(number))]}{number}" for number in count(2))
    while place.exists():
        place = place.with_name(f"{next(names)}{one.place.suffix}")
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        if backup_of(one.path).is_file():
            shutil.move(backup_of(one.path), backup_of(place))
        shutil.move(one.path, place)
    except OSError as error:
        raise NotSaved(f"{place} was not brought back: {describe_error(error)}.") from error
    _remove_empty(one.path.parent)
    return place


def empty(now: datetime | None = None) -> None:
    """Delete what is older than KEPT at the time `now`, else everything.

    What a clock that was never set has stamped counts from `now` on.
    """
    for folder, at in _times():
        try:
            if now and now >= _SET > at:
                folder.rename(folder.with_name(now.strftime(_TIME)))
            elif now is None or now - at > KEPT:
                shutil.rmtree(folder)
        except OSError as error:
            log.warning("%s: %s", folder, error)


def _times() -> list[tuple[Path, datetime]]:
    """The folders of the trash with their times."""
    found = []
    with contextlib.suppress(OSError):
        for folder in (folders().data / FOLDER).iterdir():
            if re.fullmatch(r"\d{8}-\d{6}-\d{6}", folder.name) and folder.is_dir():
                with contextlib.suppress(ValueError):
                    found.append((folder, datetime.strptime(folder.name, _TIME)))
    return found


def _remove_empty(folder: Path) -> None:
    """Remove a folder and those above it, up to the trash, as long as they are empty."""
    top = folders().data / FOLDER
    with contextlib.suppress(OSError):
        while folder != top:
            folder.rmdir()
            folder = folder.parent
