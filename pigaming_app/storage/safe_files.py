"""Writing files so that a pulled plug, a full disk or a kill leaves each of them whole: the new one or the one before.

`write_atomic` and `AtomicFile` replace a file in one step; `write_with_backup` also keeps the version before as `.bak`.
`read_or_restore` reads one back: a file that cannot be read is put aside under another name and the `.bak` takes its
place. A killed process leaves its temporary file behind, which `delete_temporary_files` deletes.
"""

import contextlib
import errno
import os
import re
import stat
import sys
import time
from collections.abc import Callable, Iterator
from datetime import datetime
from pathlib import Path
from typing import IO, TypeVar

from pigaming_app.storage.parsing import MAX_BYTES, describe_error, one_line, read, read_text

T = TypeVar("T")
LARGEST = 16_000_000  # bytes of a file that gets a `.bak`
STALE = 86_400.0  # s after which a temporary file is left over, on disks that know no locks
_TEMPORARY = re.compile(r"\.(pigaming|.+\.(toml|bak|json|npz))-\w{8}(\.tmp)?")  # up to 1.3.0 named after the file


class NotSaved(OSError):
    """A file was not written; the one before it is intact. The text is one sentence for the operator."""


class AtomicFile:
    """A file being written beside `path`, which it replaces in one step when it is finished.

    Every method raises OSError; then the draft is gone and what stood at `path` is intact.
    """

    def __init__(self, path: Path) -> None:
        self._target = Path(os.path.realpath(path))  # a link stays a link
        _require_writable(self._target)
        self._name, self._file = _temporary(self._target.parent)
        self._pending = True

    def write(self, raw: bytes) -> None:
        """Append to it."""
        with self._or_discarded():
            self._file.write(raw)

    def finish(self) -> None:
        """Put it in the place of the file."""
        with self._or_discarded():
            self._file.flush()
            os.fsync(self._file.fileno())
            with contextlib.suppress(FileNotFoundError):
                os.chmod(self._name, stat.S_IMODE(os.stat(self._target).st_mode))
            if os.name == "nt":
                self._file.close()  # Windows renames closed files only
            os.replace(self._name, self._target)
            self._pending = False
            self._file.close()
        _sync_folder(self._target.parent)

    def discard(self) -> None:
        """Delete it; what stood at `path` stays. After `finish` this does nothing."""
        if not self._pending:
            return
        self._pending = False
        if os.name != "nt":
            _delete(self._name)  # while the lock is held
        with contextlib.suppress(OSError):
            self._file.close()
        _delete(self._name)

    @contextlib.contextmanager
    def _or_discarded(self) -> Iterator[None]:
        try:
            yield
        except BaseException:
            self.discard()
            raise


def write_atomic(path: Path, raw: bytes) -> None:
    """Write a file, whole or not at all; missing folders are made. Raises NotSaved."""
    with _blamed(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        _replace(path, raw)


def require_writable(path: Path) -> None:
    """Raises NotSaved if a file at `path` cannot be written; deletes what killed processes left beside it."""
    with _blamed(path, "cannot be written"):
        AtomicFile(path).discard()
        delete_temporary_files(path.absolute().parent)


def write_with_backup(path: Path, text: str) -> None:
    """Write `text` (UTF-8) to `path`, missing folders too; what stood there becomes `.bak`. Raises NotSaved."""
    with _blamed(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        with contextlib.suppress(FileNotFoundError):
            _replace(_backup(path), read(path, LARGEST))
        _replace(path, text.encode())


def read_or_restore(path: Path, parse: Callable[[str], T], limit: int = MAX_BYTES) -> tuple[T | None, list[str]]:
    """What `parse` (which raises ValueError) makes of the file, and what to tell the operator. No file: None."""
    try:
        return parse(read_text(path, limit)), []
    except FileNotFoundError:
        return None, []
    except (OSError, ValueError) as error:
        said = f"{path} cannot be read ({describe_error(error)}); {_put_aside(path)}"
    backup = _backup(path)
    try:
        restored = parse(read_text(backup, limit))
    except (OSError, ValueError):
        return None, [f"{said}; starting afresh."]
    with contextlib.suppress(OSError):
        _replace(path, read(backup, LARGEST))
    return restored, [f"{said}; the version before it is back."]


def delete_temporary_files(*folders: Path) -> None:
    """Delete the temporary files that killed processes left in these folders; those being written stay."""
    for folder in folders:
        with contextlib.suppress(OSError):
            for entry in os.scandir(folder):
                if _TEMPORARY.fullmatch(entry.name) and entry.is_file(follow_symlinks=False):
                    _delete_unless_locked(entry.path)


@contextlib.contextmanager
def _blamed(path: Path, what: str = "was not saved") -> Iterator[None]:
    """Turn what goes wrong with a file meanwhile into NotSaved with its name."""
    try:
        yield
    except (OSError, ValueError) as error:  # ValueError: a zero byte in the name
        refused = NotSaved(one_line(f"{path} {what}: {describe_error(error)}."))
        refused.errno = getattr(error, "errno", None)
        raise refused from error


def _replace(path: Path, raw: bytes) -> None:
    draft = AtomicFile(path)
    draft.write(raw)
    draft.finish()


def _require_writable(target: Path) -> None:
    """Raises OSError unless a regular file is or can be there."""
    with contextlib.suppress(FileNotFoundError):
        if stat.S_ISDIR(mode := os.stat(target).st_mode):
            raise IsADirectoryError(errno.EISDIR, "it is a folder")
        if not stat.S_ISREG(mode):
            raise OSError(errno.EINVAL, "it is not a file")
        if not os.access(target, os.W_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))


def _temporary(folder: Path) -> tuple[str, IO[bytes]]:
    """An empty file in the folder, open and locked."""
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0) | getattr(os, "O_CLOEXEC", 0)
    while True:
        name = str(folder / f".pigaming-{os.urandom(4).hex()}.tmp")
        try:
            file = open(os.open(name, flags, 0o666), "wb")  # noqa: SIM115
        except FileExistsError:
            continue
        with contextlib.suppress(OSError):  # a disk without locks
            _lock(file, wait=True)
        if os.fstat(file.fileno()).st_nlink:
            return name, file
        file.close()  # swept away by another process before it was locked


def _lock(file: IO[bytes], wait: bool) -> bool:
    """Take the lock, which the system gives back however this process ends; false if another has it. Raises OSError."""
    if sys.platform == "win32":
        return True  # there a file that is open cannot be deleted
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
    """Make a rename in the folder survive a pulled plug, where the system can."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def _backup(path: Path) -> Path:
    return path.with_name(f"{path.name}.bak")


def _put_aside(path: Path) -> str:
    aside = path.with_name(f"{path.name}.broken-{datetime.now():%Y-%m-%d-%H%M%S}")
    try:
        os.replace(path, aside)
    except OSError as error:
        return f"it stays where it is ({describe_error(error)})"
    return f"kept as {aside.name}"
