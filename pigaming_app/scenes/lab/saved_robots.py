"""Robots that visitors have named and saved: one file each in the data folder."""

import errno
import logging
from collections.abc import Callable
from pathlib import Path

from pigaming_app.ai.brain.archive import BrainFileError
from pigaming_app.ai.learning.training import TableTraining
from pigaming_app.ai.networks.files import TrainedNetwork
from pigaming_app.ai.qlearning.table_files import Trained
from pigaming_app.scenes.files import is_network, load_network, load_table, save_network, save_table
from pigaming_app.scenes.pages.name_page import LETTERS
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders
from pigaming_app.storage.trash import discard

LENGTH = 6  # letters in a name
PROPOSALS = ("ROBI", "BIPO", "ZUMI", "TIKO", "LUMO", "PIXI", "VOLT", "MIKO", "NEON", "ZIGA")

log = logging.getLogger("pigaming")


class RobotFileError(Exception):
    """A robot could not be saved or opened; the message is a text key."""


def folder() -> Path:
    """Folder of the robot files; it may not exist yet."""
    return folders().data / "robots"


def file_of(name: str) -> Path:
    return folder() / f"{name}.npz"


def names() -> list[str]:
    """Names of the saved robots, most recent first."""
    files = []
    try:
        for path in folder().glob("*.npz"):
            if is_name(path.stem):
                files.append((path.stat().st_mtime, path.stem))
    except OSError as error:
        log.warning("%s", error)
    return [name for _, name in sorted(files, reverse=True)]


def is_name(text: str) -> bool:
    """True if the text is a valid robot name."""
    return 0 < len(text) <= LENGTH and text == text.strip() and all(letter in LETTERS for letter in text)


def proposal() -> str:
    """An unused name, if one is left."""
    taken = names()
    return next((name for name in PROPOSALS if name not in taken), PROPOSALS[0])


def save_robot(training: TableTraining, name: str) -> None:
    """Save a robot with a table under a name. Raises RobotFileError; an existing file is then left intact."""
    _save(lambda path: save_table(training.trained(name), path), name)


def save_network_as(trained: TrainedNetwork, name: str) -> None:
    """Save a robot with a network under a name. Raises RobotFileError; an existing file is then left intact."""
    _save(lambda path: save_network(trained, path), name)


def delete_robot(name: str) -> None:
    """Move a robot to the trash. Raises RobotFileError."""
    try:
        discard(file_of(name), "robots")
    except NotSaved as error:
        log.warning("%s", error)
        raise RobotFileError("lab.undeleted") from error


def load_robot(name: str) -> Trained | TrainedNetwork:
    """Load a robot. Raises RobotFileError."""
    path = file_of(name)
    try:
        return load_network(path) if is_network(path) else load_table(path)
    except BrainFileError as error:
        log.warning("%s", error)
        raise RobotFileError("lab.broken") from error


def _save(write: Callable[[Path], None], name: str) -> None:
    try:
        write(file_of(name))
    except OSError as error:
        log.warning("%s was not saved: %s", file_of(name), error)
        full = error.errno in (errno.ENOSPC, errno.EDQUOT)
        raise RobotFileError("lab.disk_full" if full else "lab.no_writing") from error
