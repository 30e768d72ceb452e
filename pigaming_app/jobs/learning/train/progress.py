"""Progress of a training on standard error, and the wish to stop it."""

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from shutil import get_terminal_size

from pigaming_app.jobs.terminal.console import print_error
from pigaming_app.jobs.terminal.interrupt import CODE

BAR = 24  # characters


def bar(share: float) -> str:
    """A bar for the part that is done."""
    done = int(BAR * min(1.0, share))
    return f"[{'#' * done}{'.' * (BAR - done)}]"


def show(line: str, milestone: bool) -> None:
    """Print a line of progress. In a terminal it replaces the previous one; elsewhere only milestones are printed."""
    if sys.stderr.isatty():
        width = get_terminal_size().columns - 1
        print(f"\r{line[:width]:{width}}", end="", file=sys.stderr, flush=True)
    elif milestone:
        print(line, file=sys.stderr, flush=True)


def note(line: str) -> None:
    """Print a line on standard error."""
    print(line, file=sys.stderr, flush=True)


def end_line() -> None:
    """End the line of progress in a terminal."""
    if sys.stderr.isatty():
        print(file=sys.stderr)


def end_of(stopped: list[int]) -> int:
    """The exit code of a training, and after Ctrl-C a line."""
    if stopped:
        print_error("stopped before the end; continue with --resume")
    return CODE if stopped else 0


@contextmanager
def interrupts() -> Iterator[list[int]]:
    """Within this context SIGINT and SIGTERM are only noted in the list."""
    stopped: list[int] = []
    kinds = (signal.SIGINT, signal.SIGTERM)
    before = [signal.signal(kind, lambda number, frame: stopped.append(number)) for kind in kinds]
    try:
        yield stopped
    finally:
        for kind, handler in zip(kinds, before, strict=True):
            signal.signal(kind, handler)
