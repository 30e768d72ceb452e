"""The process that compiles what the Lab plays into numba's cache: once in a run of the arcade, out of everybody's way.

It goes on while the Lab is left and entered again, and ends with the arcade: at the end it is killed, and when the
arcade crashes, it notices that its standard input was closed.
"""

import contextlib
import os
import subprocess
import sys
from threading import Lock

from pigaming_app.sim.kernel import PACKAGE, can_compile

PATIENCE = 10  # how nice the process is to others

COMMAND = (sys.executable, "-m", "pigaming_app.ai.experiments.evaluation")


class Compiler:
    """The process, which `start` starts; a second start changes nothing."""

    def __init__(self, command: tuple[str, ...] = COMMAND) -> None:
        self._command = command
        self._process: subprocess.Popen[bytes] | None = None
        self._ended = False
        self._lock = Lock()  # the arcade may end while another thread starts the process

    def start(self) -> None:
        """Compile, where numba is installed and nothing has been started yet. Raises OSError."""
        with self._lock:
            if self._process is None and not self._ended and can_compile():
                self._process = _started(self._command)

    def end(self) -> None:
        """Kill the process; it will not be started again."""
        with self._lock:
            self._ended = True
            if self._process:
                self._process.kill()
                self._process.communicate()

    @property
    def code(self) -> int | None:
        """The exit code; None while it runs, and before it is started."""
        return self._process.poll() if self._process else None


def _started(command: tuple[str, ...]) -> subprocess.Popen[bytes]:
    quiet = subprocess.DEVNULL
    windows = ("CREATE_NO_WINDOW", "BELOW_NORMAL_PRIORITY_CLASS")  # flags that only Windows has
    flags: int = sum(getattr(subprocess, name, 0) for name in windows)
    process = subprocess.Popen(
        command, cwd=PACKAGE.parent, stdin=subprocess.PIPE, stdout=quiet, stderr=quiet, creationflags=flags
    )
    if hasattr(os, "setpriority"):  # not on Windows
        with contextlib.suppress(OSError):
            os.setpriority(os.PRIO_PROCESS, process.pid, PATIENCE)
    return process
