"""Background process that compiles the Lab's kernels into numba's on-disk cache, once per run of the arcade.

It keeps running when the player leaves the Lab and ends with the arcade: a normal exit kills it, and after a crash it
exits because its standard input is closed.
"""

import sys
from threading import Lock
from typing import TYPE_CHECKING

from pigaming_app.sim.kernel import can_compile
from pigaming_app.storage.background import launch

if TYPE_CHECKING:
    from subprocess import Popen

COMMAND = (sys.executable, "-m", "pigaming_app.ai.learning.evaluation")


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
