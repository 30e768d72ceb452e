"""Ctrl-C: a job ends with one line and exit code 130, whatever it is doing, and none of its processes stays.

SIGINT is blocked in all threads but one, so the processes that a job starts never receive it. That thread wakes the
main thread, which raises KeyboardInterrupt or calls the job's own handler. It ends the program where that does not
help: in compiled code, where cleaning up takes too long, and at the second Ctrl-C. On Windows, Python's way remains.
"""

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import FrameType, TracebackType
from typing import Any, NoReturn

LINE = "PiGaming: stopped."
CODE = 130
STUCK = 1.0  # s for the main thread to notice
PATIENCE = 3.0  # s for it to clean up
SWALLOWED = 0.05  # s until an interrupt that was raised where Python ignores exceptions is raised again
OWN_GROUP: dict[str, Any] = (  # of a process that runs jobs itself, and is ended by its parent
    {"creationflags": getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0)} if os.name == "nt" else {"process_group": 0}
)


class Interrupts:
    """The presses of Ctrl-C during a job. `cut`: one has cut the job off, which has no handler of its own."""

    def __init__(self) -> None:
        self.pressed = self.cut = False
        self._allowed = self._raised = False
        self._noticed = threading.Event()
        self._ending = threading.Lock()
        self._closed = False

    def end(self) -> NoReturn:
        """Print the line, end all processes below this one, and exit."""
        self._ending.acquire()  # never released: another thread waits here for the exit
        with suppress(OSError):
            os.write(2, (f"\r\x1b[K{LINE}\n" if os.isatty(2) else f"{LINE}\n").encode())
        for pid in descendants(os.getpid()):
            with suppress(OSError):
                os.kill(pid, signal.SIGKILL)
        os._exit(CODE)

    def watch(self) -> None:
        """Wait for presses, in a thread of its own."""
        while True:
            signal.sigwait({signal.SIGINT})
            if self._closed:
                return
            if self.pressed:
                self.end()
            self.pressed = True
            self.cut = signal.getsignal(signal.SIGINT) is signal.default_int_handler
            self._wake()
            if not self.cut:
                continue
            if not self._noticed.wait(STUCK):
                self.end()
            _later(PATIENCE, self.end)

    def close(self, watcher: threading.Thread) -> None:
        """End the thread that watches."""
        self._closed = True
        signal.pthread_kill(watcher.ident or 0, signal.SIGINT)
        watcher.join()

    def notice(self, _number: int, frame: FrameType | None) -> None:
        """Handler in the main thread: interrupt it, if it is allowed."""
        self._noticed.set()
        handler = signal.getsignal(signal.SIGINT)
        if self._allowed and not self._raised and callable(handler):
            self._raised = self.cut
            handler(signal.SIGINT, frame)

    def allow(self, allowed: bool) -> None:
        """Begin or end the part of the main thread that may be interrupted."""
        self._allowed = allowed
        if allowed and self.cut and not self._raised:
            self._raised = True
            raise KeyboardInterrupt

    def ignored(self, args: Any) -> None:
        """Hook for exceptions that Python cannot raise, as in a destructor."""
        if issubclass(args.exc_type, KeyboardInterrupt):
            self._raised = False
            _later(SWALLOWED, self._wake)
        elif not self.cut:
            sys.__unraisablehook__(args)

    def printed(self, kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        """Hook for exceptions that a library prints and drops, as SDL does with those of a file's methods."""
        if self.cut:
            self._raised = False
            _later(SWALLOWED, self._wake)
        else:
            sys.__excepthook__(kind, error, trace)

    def in_thread(self, args: Any) -> None:
        """Hook for exceptions that end a thread: once Ctrl-C was pressed, those of threads cut off are no news."""
        if not self.cut:
            threading.__excepthook__(args)

    @staticmethod
    def _wake() -> None:
        """Interrupt the main thread, even in a system call."""
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGURG)


@contextmanager
def watched() -> Iterator[Interrupts]:
    """Within this context Ctrl-C is watched, in the main thread of a process that does not ignore it."""
    interrupts = Interrupts()
    if (
        not hasattr(signal, "sigwait")
        or threading.current_thread() is not threading.main_thread()
        or signal.getsignal(signal.SIGINT) is not signal.default_int_handler
    ):
        yield interrupts
        return
    hooks = sys.unraisablehook, sys.excepthook, threading.excepthook
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    handler = signal.signal(signal.SIGURG, interrupts.notice)
    watcher = threading.Thread(target=interrupts.watch, name="interrupts", daemon=True)
    watcher.start()
    sys.unraisablehook, sys.excepthook = interrupts.ignored, interrupts.printed
    threading.excepthook = interrupts.in_thread
    try:
        yield interrupts
    finally:
        interrupts.close(watcher)
        sys.unraisablehook, sys.excepthook, threading.excepthook = hooks
        signal.signal(signal.SIGURG, handler)
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)


def descendants(pid: int) -> list[int]:
    """All processes below one, parents first."""
    children: dict[int, list[int]] = {}
    for child, parent in _processes():
        children.setdefault(parent, []).append(child)
    found = list(children.get(pid, ()))
    for one in found:
        found += children.get(one, ())
    return found


def _processes() -> Iterator[tuple[int, int]]:
    """Every process of the system, with its parent."""
    if Path("/proc/self/stat").exists():
        for entry in Path("/proc").glob("[0-9]*/stat"):
            with suppress(OSError, IndexError):  # it has ended since
                yield int(entry.parent.name), int(entry.read_text(errors="replace").rpartition(")")[2].split()[1])
        return
    with suppress(OSError):
        listed = subprocess.run(["ps", "-axo", "pid=,ppid="], capture_output=True, text=True, check=False).stdout
        yield from ((int(pid), int(parent)) for pid, parent in map(str.split, listed.splitlines()))


def _later(seconds: float, action: Any) -> None:
    timer = threading.Timer(seconds, action)
    timer.daemon = True
    timer.start()
