"""Owner of the process in which a network learns: orders go out, reports come in, and neither delays a frame."""

import contextlib
import logging
import pickle
import sys
from collections import deque
from threading import Thread
from typing import TYPE_CHECKING, Any

from pigaming_app.ai.ppo.lab.messages import Report
from pigaming_app.storage.background import launch

if TYPE_CHECKING:
    from subprocess import Popen

COMMAND = (sys.executable, "-m", "pigaming_app.ai.ppo.lab.process")

log = logging.getLogger("pigaming")


class TrainingProcess:
    """The process; it ends with the arcade."""

    def __init__(self, command: tuple[str, ...] = COMMAND) -> None:
        self._command = command
        self._process: Popen[bytes] | None = None
        self._reports: deque[Report] = deque()

    @property
    def code(self) -> int | None:
        """Exit code of the process; None before it starts and while it runs."""
        return self._process.poll() if self._process else None

    @property
    def running(self) -> bool:
        return self._process is not None and self._process.poll() is None

    def start(self) -> None:
        """Start the process, again if it has ended. Raises OSError."""
        self.end()
        self._process, self._reports = launch(self._command, answers=True), deque()
        Thread(target=_read, args=(self._process, self._reports), name="lab reports", daemon=True).start()

    def send(self, message: Any) -> None:
        """Send a message; one to a process that has ended is lost."""
        if self._process and self._process.stdin:
            try:
                pickle.dump(message, self._process.stdin)
                self._process.stdin.flush()
            except OSError as error:
                log.warning("the training process cannot be reached: %s", error)

    def reports(self) -> list[Report]:
        """The reports since the last call."""
        return [self._reports.popleft() for _ in range(len(self._reports))]

    def end(self) -> None:
        """Kill the process, if it was started."""
        if self._process:
            self._process.kill()
            self._process.wait()
            for pipe in (self._process.stdin, self._process.stdout):
                if pipe:
                    with contextlib.suppress(OSError):  # what was still to be sent
                        pipe.close()
            self._process = None


def _read(process: "Popen[bytes]", reports: "deque[Report]") -> None:
    """Thread body: collect reports until the process ends."""
    assert process.stdout
    with contextlib.suppress(EOFError, OSError, ValueError, pickle.UnpicklingError):  # it ended, perhaps in a report
        while True:
            reports.append(pickle.load(process.stdout))
