"""The log of the arcade and of the jobs of real robots: one file among the user's own, of bounded size."""

import contextlib
import errno
import logging
import os
import sys
from logging.handlers import RotatingFileHandler
from pathlib import Path

FILE = "pigaming.log"
LONGEST = 65_536  # bytes at the end of the log in which a torn line is looked for


class LogFile(RotatingFileHandler):
    """Appends whole lines to a file. A full disk costs lines, nothing else."""

    def __init__(self, path: Path) -> None:
        super().__init__(path, maxBytes=500_000, backupCount=1, encoding="utf-8", errors="backslashreplace")

    def handleError(self, record: logging.LogRecord) -> None:  # noqa: N802
        if isinstance(sys.exc_info()[1], OSError):
            self._abandon()
        else:
            super().handleError(record)

    def close(self) -> None:
        with contextlib.suppress(OSError):
            super().close()

    def _abandon(self) -> None:
        """Close the file without what could not be written; the next line opens it again."""
        stream, self.stream = self.stream, None
        with contextlib.suppress(OSError):
            if stream:
                stream.close()
        with contextlib.suppress(OSError):
            _cut_torn_line(self.baseFilename)


def log_file(data: Path) -> LogFile:
    """The handler that writes the log in the data folder. Raises OSError where that cannot be written."""
    data.mkdir(parents=True, exist_ok=True)
    require_file(data / FILE)
    handler = LogFile(data / FILE)
    handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(message)s"))
    return handler


def append_line(data: Path, sentence: str) -> None:
    """Write one sentence into the log; where that cannot be, it stands on the screen only."""
    try:
        handler = log_file(data)
    except OSError:
        return
    handler.handle(logging.LogRecord("pigaming", logging.WARNING, __file__, 0, sentence, None, None))
    handler.close()


def require_file(path: Path) -> None:
    """Raises OSError if something else than a regular file is there: opening a pipe would wait for its reader."""
    if path.exists() and not path.is_file():
        raise OSError(errno.EINVAL, "it is not a file")


def _cut_torn_line(path: str) -> None:
    """Take away what follows the last end of a line. Raises OSError."""
    with open(path, "r+b") as file:
        size = file.seek(0, os.SEEK_END)
        begin = max(0, size - LONGEST)
        file.seek(begin)
        end = file.read(LONGEST).rfind(b"\n") + 1
        if end or not begin:
            file.truncate(begin + end)
