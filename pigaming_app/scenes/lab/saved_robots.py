"""The robots that people have named and saved: one file each in the folder for data."""

import errno
import logging
from pathlib import Path

from pigaming_app.ai.experiments.training import Training, resumed
from pigaming_app.ai.qlearning.table_files import TableError
from pigaming_app.scenes.files import load_table, save_table
from pigaming_app.sim.arena import ArenaError
from pigaming_app.storage.settings import folders

LENGTH = 6  # letters of a name
LETTERS = " ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
PROPOSALS = ("ROBI", "BIPO", "ZUMI", "TIKO", "LUMO", "PIXI", "VOLT", "MIKO", "NEON", "ZIGA")

log = logging.getLogger("pigaming")


class RobotFileError(Exception):
    """A robot was not saved or cannot be opened; the text is the key of a sentence for people."""


def folder() -> Path:
    """Where the robots are; it need not exist."""
    return folders().data / "robots"


def file_of(name: str) -> Path:
    """The file of a robot."""
    return folder() / f"{name}.npz"


def names() -> list[str]:
    """The robots that there are, the last saved first."""
    found = []
    try:
        for path in folder().glob("*.npz"):
            if is_name(path.stem):
                found.append((path.stat().st_mtime, path.stem))
    except OSError as trouble:
        log.warning("%s", trouble)
    return [name for _, name in sorted(found, reverse=True)]


def is_name(text: str) -> bool:
    """Whether a robot can be called so."""
    return 0 < len(text) <= LENGTH and text == text.strip() and all(letter in LETTERS for letter in text)


def proposal() -> str:
    """A name that nobody has yet, as long as there are some."""
    taken = names()
    return next((name for name in PROPOSALS if name not in taken), PROPOSALS[0])


def save_robot(training: Training, name: str) -> None:
    """Save a robot under a name. Raises RobotFileError; what stood there before is intact."""
    try:
        save_table(training.trained(name), file_of(name))
    except OSError as trouble:
        log.warning("%s was not saved: %s", file_of(name), trouble)
        full = trouble.errno in (errno.ENOSPC, errno.EDQUOT)
        raise RobotFileError("lab.disk_full" if full else "lab.no_writing") from trouble


def load_robot(name: str, fast: bool) -> tuple[Training, bool]:
    """A robot as it was saved, and whether it was trained with another version of the engine. Raises RobotFileError."""
    try:
        trained = load_table(file_of(name))
        return resumed(trained, fast), trained.other_engine
    except (TableError, ArenaError) as trouble:
        log.warning("%s", trouble)
        raise RobotFileError("lab.broken") from trouble
