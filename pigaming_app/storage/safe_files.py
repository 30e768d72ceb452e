"""Crash-safe writing of files: after a power cut, full disk or kill a file is complete, either the new or the old one.

`write_atomic` and `AtomicFile` replace a file in one step, `write_all_atomic` several; `write_with_backup` also saves
the previous version as `.bak`. `read_or_restore` reads a file; an unreadable one is renamed and replaced by the `.bak`.
A killed process leaves its temporary file behind, which `delete_temporary_files` deletes.
"""

import contextlib
import errno
import os
import re
import stat
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from datetime import datetime
from pathlib import Path
from typing import IO, TypeVar

from pigaming_app.storage.parsing import MAX_BYTES, describe_error, one_line, read, read_text

T = TypeVar("T")
MAX_BACKUP = 16_000_000  # bytes, largest file that gets a `.bak`
STALE = 86_400.0  # s, age at which a temporary file counts as abandoned, on file systems without locks
_TEMPORARY = re.compile(r"\.pigaming-[0-9a-f]{8}\.tmp")


class NotSaved(OSError):
    """A file was not written; the previous version is intact. The text is a sentence for the operator."""


class AtomicFile:
    """A temporary file in the folder of `path`, which atomically replaces it when finished.

    Every method raises OSError; the temporary file is then deleted and `path` is intact.
    """

    def __init__(self, path: Path) -> None:
        self._target = Path(os.path.realpath(path))  # preserves symbolic links
        _require_writable(self._target)
        self._name, self._file = _temporary(self._target.parent)
        self._pending = True

    def write(self, raw: bytes) -> None:
        with self._discard_on_error():
            self._file.write(raw)

    def sync(self) -> None:
        """Wait until everything written is on the disk."""
        with self._discard_on_error():
            self._file.flush()
            os.fsync(self._file.fileno())

    def finish(self) -> None:
        """Replace `path` with the temporary file."""
        self.sync()
        with self._discard_on_error():
            with contextlib.suppress(FileNotFoundError):
                os.chmod(self._name, stat.S_IMODE(os.stat(self._target).st_mode))
            if os.name == "nt":
                self._file.close()  # Windows can rename closed files only
            os.replace(self._name, self._target)
            self._pending = False
            self._file.close()
        _sync_folder(self._target.parent)

    def discard(self) -> None:
        """Delete the temporary file and leave `path` unchanged. No effect after `finish`."""
        if not self._pending:
            return
        self._pending = False
        if os.name != "nt":
            _delete(self._name)  # before the lock is released
        with contextlib.suppress(OSError):
            self._file.close()
        _delete(self._name)

    @contextlib.contextmanager
    def _discard_on_error(self) -> Iterator[None]:
        try:
            yield
        except BaseException:
            self.discard()
            raise


def write_atomic(path: Path, raw: bytes) -> None:
    """Write a file atomically; missing folders are created. Raises NotSaved."""
    with _as_not_saved(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        _replace(path, raw)


def write_all_atomic(files: Mapping[Path, bytes]) -> None:
    """Write files that belong together: none replaces its predecessor before all are on the disk. Raises NotSaved."""
    drafts: list[AtomicFile] = []
    try:
        for path, raw in files.items():
            with _as_not_saved(path):
                drafts.append(AtomicFile(path))
                drafts[-1].write(raw)
                drafts[-1].sync()
        for path, draft in zip(files, drafts, strict=True):
            with _as_not_saved(path):
                draft.finish()
    finally:
        for draft in drafts:
            draft.discard()


def require_writable(path: Path) -> None:
    """Raises NotSaved if `path` cannot be written; also deletes abandoned temporary files in its folder."""
    with _as_not_saved(path, "cannot be written"):
        AtomicFile(path).discard()
        delete_temporary_files(path.absolute().parent)


def write_with_backup(path: Path, text: str) -> None:
    """Write `text` (UTF-8) atomically and save the previous version as `.bak`. Raises NotSaved."""
    with _as_not_saved(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        with contextlib.suppress(FileNotFoundError):
            _replace(backup_of(path), read(path, MAX_BACKUP))
        _replace(path, text.encode())


def read_or_restore(path: Path, parse: Callable[[str], T], limit: int = MAX_BYTES) -> tuple[T | None, list[str]]:
    """Parse a file, or its backup if that fails. Returns the result and sentences for the operator.

    The result is None if there is no file, or neither can be parsed. `parse` raises ValueError for an invalid text. An
    unreadable file is renamed and replaced by its backup.
    """
    try:
        return parse(read_text(path, limit)), []
    except FileNotFoundError:
        return None, []
    except (OSError, ValueError) as error:
        message = f"{path} cannot be read ({describe_error(error)}); {_put_aside(path)}"
    backup = backup_of(path)
    try:
        restored = parse(read_text(backup, limit))
    except (OSError, ValueError):
        return None, [f"{message}; there is no usable backup."]
    with contextlib.suppress(OSError):
        _replace(path, read(backup, MAX_BACKUP))
    return restored, [f"{message}; the previous version was restored."]


def delete_temporary_files(*folders: Path) -> None:
    """Delete abandoned temporary files in these folders; those still being written remain."""
    for folder in folders:
        with contextlib.suppress(OSError):
            for entry in os.scandir(folder):
                if _TEMPORARY.fullmatch(entry.name) and entry.is_file(follow_symlinks=False):
                    _delete_unless_locked(entry.path)


@contextlib.contextmanager
def _as_not_saved(path: Path, failure: str = "was not saved") -> Iterator[None]:
    """Convert errors of the block to NotSaved, with the file's name."""
    try:
        yield
    except (OSError, ValueError) as error:  # ValueError: a zero byte in the name
        not_saved = NotSaved(one_line(f"{path} {failure}: {describe_error(error)}."))
        not_saved.errno = getattr(error, "errno", None)
        raise not_saved from error


def _replace(path: Path, raw: bytes) -> None:
    draft = AtomicFile(path)
    draft.write(raw)
    draft.finish()


def _require_writable(target: Path) -> None:
    """Raises OSError if `target` exists and is not a writable regular file."""
    with contextlib.suppress(FileNotFoundError):
        if stat.S_ISDIR(mode := os.stat(target).st_mode):
            raise IsADirectoryError(errno.EISDIR, "it is a folder")
        if not stat.S_ISREG(mode):
            raise OSError(errno.EINVAL, "it is not a file")
        if not os.access(target, os.W_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))


def _temporary(folder: Path) -> tuple[str, IO[bytes]]:
    """Create an empty file in the folder, open and locked. Raises OSError."""
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0) | getattr(os, "O_CLOEXEC", 0)
    while True:
        name = str(folder / f".pigaming-{os.urandom(4).hex()}.tmp")
        try:
            file = open(os.open(name, flags, 0o666), "wb")  # noqa: SIM115
        except FileExistsError:
            continue
        with contextlib.suppress(OSError):  # a file system without locks
            _lock(file, wait=True)
        if os.fstat(file.fileno()).st_nlink:
            return name, file
        file.close()  # deleted by another process before it was locked


def _lock(file: IO[bytes], wait: bool) -> bool:
    """Take the lock, which the system releases when the process ends; False if another has it. Raises OSError."""
    if sys.platform == "win32":
        return True  # Windows does not delete open files
    import fcntl

    try:
        fcntl.flock(file, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
    except BlockingIOError:
        return False
    return True


def _delete_unless_locked(name: str) -> None:
    with contextlib.suppress(OSError):
        if os.name == "nt":
            os.unlink(name)
            return
        with open(name, "rb") as file:
            try:
                free = _lock(file, wait=False)
            except OSError:
                free = time.time() - os.fstat(file.fileno()).st_mtime > STALE
            if free:
                os.unlink(name)


def _delete(name: str) -> None:
    with contextlib.suppress(OSError):
        os.unlink(name)


def _sync_folder(folder: Path) -> None:
    """Make a rename in the folder survive a power cut, if the system supports it."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def backup_of(path: Path) -> Path:
    """The previous version of a file."""
    return path.with_name(f"{path.name}.bak")


def _put_aside(path: Path) -> str:
    aside = path.with_name(f"{path.name}.broken-{datetime.now():%Y-%m-%d-%H%M%S}")
    try:
        os.replace(path, aside)
    except OSError as error:
        return f"it stays where it is ({describe_error(error)})"
    return f"kept as {aside.name}"
