"""An arcade in a process of its own, as its supervisor sees it."""

import contextlib
import os
import signal
import subprocess
import sys
import tempfile
from collections import deque
from collections.abc import Mapping, Sequence
from pathlib import Path
from threading import Thread
from time import sleep

from pigaming_app.jobs.terminal.interrupt import OWN_GROUP
from pigaming_app.jobs.terminal.supervised import GRACE, VARIABLE
from pigaming_app.storage.heartbeat import Heartbeat

LINES = 200  # of standard error, the last ones of which are kept
DUMP_TIME = 0.3  # s for the stacks of a hung process to be written


class ArcadeProcess:
    """A started arcade; what it writes to standard error is passed on. `variables`: more of its environment.

    Raises OSError.
    """

    def __init__(self, command: Sequence[str], variables: Mapping[str, str] | None = None) -> None:
        handle, name = tempfile.mkstemp(prefix="pigaming-", suffix=".beat")
        os.close(handle)
        self._file = Path(name)
        self._heartbeat = Heartbeat(self._file)
        self.errors: deque[str] = deque(maxlen=LINES)
        environment = {**os.environ, **(variables or {}), VARIABLE: name}
        try:
            self._process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stderr=subprocess.PIPE, env=environment, errors="replace", **OWN_GROUP
            )
        except BaseException:  # Ctrl+C as well: a process that is half started ends by its closed input
            self._free()
            raise
        self._reader = Thread(target=self._read, daemon=True)
        self._reader.start()

    @property
    def pid(self) -> int:
        return self._process.pid

    @property
    def beats(self) -> int:
        return self._heartbeat.beats

    @property
    def picture(self) -> tuple[tuple[int, int], bytes] | None:
        """The latest copy of its screen, see `Heartbeat`."""
        return self._heartbeat.picture

    def poll(self) -> int | None:
        return self._process.poll()

    def end(self) -> None:
        """Close its standard input, at which it closes itself; after GRACE s kill it."""
        self._close_input()
        try:
            self._process.wait(2 * GRACE)
        except (subprocess.TimeoutExpired, KeyboardInterrupt):
            self._process.kill()

    def kill(self) -> None:
        """Kill it, after its stacks were written to its crash log where the system has the signal for that."""
        if self.beats and hasattr(signal, "SIGUSR1"):
            self._process.send_signal(signal.SIGUSR1)
            sleep(DUMP_TIME)
        self._process.kill()

    def close(self) -> None:
        self._close_input()
        self._process.kill()
        self._process.wait()
        self._reader.join(DUMP_TIME)  # its own processes may hold the pipe a little longer
        self._free()

    def _close_input(self) -> None:
        if self._process.stdin:
            with contextlib.suppress(OSError):
                self._process.stdin.close()

    def _free(self) -> None:
        self._heartbeat.close()
        with contextlib.suppress(OSError):
            self._file.unlink(missing_ok=True)

    def _read(self) -> None:
        """Thread body: keep and pass on the lines of standard error."""
        if self._process.stderr:
            with self._process.stderr as stream, contextlib.suppress(OSError, ValueError):
                for line in stream:
                    self.errors.append(line)
                    print(line, end="", file=sys.stderr, flush=True)
