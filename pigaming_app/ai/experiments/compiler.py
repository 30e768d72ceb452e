"""Background process that compiles the Lab's kernels into numba's on-disk cache, once per run of the arcade.

It keeps running when the player leaves the Lab and ends with the arcade: a normal exit kills it, and after a crash it
exits because its standard input is closed.
"""

import contextlib
import os
import sys
from threading import Lock
from typing import TYPE_CHECKING

from pigaming_app.sim.kernel import PACKAGE, can_compile

if TYPE_CHECKING:
    from subprocess import Popen

PATIENCE = 10  # POSIX nice value of the process
BLAS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")  # threads of NumPy's matrix products

COMMAND = (sys.executable, "-m", "pigaming_app.ai.experiments.evaluation")


class Compiler:
    """Owner of the process. Thread-safe; a second `start` has no effect."""

    def __init__(self, command: tuple[str, ...] = COMMAND) -> None:
        self._command = command
        self._process: Popen[bytes] | None = None
        self._ended = False
        self._lock = Lock()  # the arcade may end while another thread starts the process

    def start(self) -> None:
        """Start the process if numba is installed and it was never started. Raises OSError."""
        with self._lock:
            if self._process is None and not self._ended and can_compile():
                self._process = launch(self._command)

    def end(self) -> None:
        """Kill the process for good; later calls of `start` have no effect."""
        with self._lock:
            self._ended = True
            if self._process:
                self._process.kill()
                self._process.communicate()

    @property
    def code(self) -> int | None:
        """Exit code of the process; None before it starts and while it runs."""
        return self._process.poll() if self._process else None


def launch(command: tuple[str, ...], answers: bool = False) -> "Popen[bytes]":
    """Start a background process with a pipe as standard input, and with `answers` as standard output. Raises OSError.

    NumPy's matrix products stay in the threads that call them.
    """
    import subprocess  # late, for the start of the arcade

    null = subprocess.DEVNULL
    names = ("CREATE_NO_WINDOW", "BELOW_NORMAL_PRIORITY_CLASS")  # defined on Windows only
    flags: int = sum(getattr(subprocess, name, 0) for name in names)
    process = subprocess.Popen(
        command,
        cwd=PACKAGE.parent,
        env=os.environ | dict.fromkeys(BLAS, "1"),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE if answers else null,
        stderr=null,
        creationflags=flags,
    )
    if hasattr(os, "setpriority"):  # not on Windows
        with contextlib.suppress(OSError):
            os.setpriority(os.PRIO_PROCESS, process.pid, PATIENCE)
    return process
