"""Log file of the arcade and of the jobs with real robots, of bounded size."""

import contextlib
import errno
import logging
import os
import sys
from logging.handlers import RotatingFileHandler
from pathlib import Path

FILE = "pigaming.log"
CRASH_FILE = "crash.log"  # stacks of a crashed interpreter
MAX_LINE = 65_536  # bytes at the end of the log that are searched for an incomplete line


class LogFile(RotatingFileHandler):
    """A rotating log file of whole lines. Write errors, such as a full disk, lose lines but are not reported."""

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
        """Close the file and remove an incomplete last line; the next line reopens it."""
        stream, self.stream = self.stream, None
        with contextlib.suppress(OSError):
            if stream:
                stream.close()
        with contextlib.suppress(OSError):
            _cut_torn_line(self.baseFilename)


def log_file(data: Path) -> LogFile:
    """A handler for the log in the data folder. Raises OSError if it cannot be written."""
    data.mkdir(parents=True, exist_ok=True)
    require_file(data / FILE)
    handler = LogFile(data / FILE)
    handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(message)s"))
    return handler


def append_line(data: Path, sentence: str) -> None:
    """Append a sentence to the log as a warning. Does nothing if the log cannot be written."""
    try:
        handler = log_file(data)
    except OSError:
        return
    handler.handle(logging.LogRecord("pigaming", logging.WARNING, __file__, 0, sentence, None, None))
    handler.close()


def require_file(path: Path) -> None:
    """Raises OSError if `path` exists and is not a regular file: opening a pipe would block until it has a reader."""
    if path.exists() and not path.is_file():
        raise OSError(errno.EINVAL, "it is not a file")


def _cut_torn_line(path: str) -> None:
    """Remove an incomplete last line. Raises OSError."""
    with open(path, "r+b") as file:
        size = file.seek(0, os.SEEK_END)
        begin = max(0, size - MAX_LINE)
        file.seek(begin)
        end = file.read(MAX_LINE).rfind(b"\n") + 1
        if end or not begin:
            file.truncate(begin + end)
