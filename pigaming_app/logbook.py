"""The log of the arcade and of the jobs of real robots: one file among the user's own, that never grows for good."""

import logging
from logging.handlers import RotatingFileHandler
from pathlib import Path

FILE = "pigaming.log"


def log_file(data: Path) -> RotatingFileHandler:
    """What writes into the log in the data folder. Raises OSError where that cannot be written."""
    data.mkdir(parents=True, exist_ok=True)
    handler = RotatingFileHandler(data / FILE, maxBytes=500_000, backupCount=1, encoding="utf-8")
    handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(message)s"))
    return handler


def note(data: Path, sentence: str) -> None:
    """Write one sentence into the log; where that cannot be, it stands on the screen only."""
    try:
        handler = log_file(data)
    except OSError:
        return
    handler.handle(logging.LogRecord("pigaming", logging.WARNING, __file__, 0, sentence, None, None))
    handler.close()
