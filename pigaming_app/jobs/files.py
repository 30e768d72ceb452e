"""The user's files before and after a job."""

import contextlib
from pathlib import Path

FOLDERS = ("crashes", "events", "ghosts", "pictures", "replays", "reports", "robots", "shared")  # below the data folder
BY_GAME = ("arenas", "drafts")  # folders with one folder a game


def sweep() -> None:
    """Delete the temporary files of processes that were killed."""
    from pigaming_app.storage.safe_files import delete_temporary_files as sweep_folders
    from pigaming_app.storage.settings import folders

    where, by_game = folders(), list[Path]()
    for name in BY_GAME:
        with contextlib.suppress(OSError):
            by_game += (where.data / name).iterdir()
    sweep_folders(where.config, where.data, *(where.data / folder for folder in FOLDERS), *by_game)


def log(line: str) -> None:
    """Add a line to the arcade's log, if this user has one."""
    from pigaming_app.storage.log import append_line
    from pigaming_app.storage.parsing import one_line
    from pigaming_app.storage.settings import NoHome, folders

    with contextlib.suppress(NoHome):
        append_line(folders().data, one_line(line))
