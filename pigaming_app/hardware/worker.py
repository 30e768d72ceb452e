"""Work that is done bit by bit beside the pictures of the arcade, so that nobody has to wait for a camera.

A thread does it, which ends soon after `close`, or, where time is made up, whoever owns the time calls `pump`.
"""

import logging
import threading
from typing import Self

PERIOD = 0.005  # s between two bits of work

log = logging.getLogger("pigaming")


class BackgroundWorker:
    """Subclasses give `step`, one bit of work, and `end`, which lets go of what they hold."""

    def __init__(self) -> None:
        self._closing = threading.Event()
        self._thread: threading.Thread | None = None
        self._before: BackgroundWorker | None = None

    def start(self, before: "BackgroundWorker | None" = None) -> Self:
        """Work in a thread until close(), but not before another one has ended, which may hold the same camera."""
        self._before = before
        self._thread = threading.Thread(target=self._run, name=type(self).__name__.lower(), daemon=True)
        self._thread.start()
        return self

    def pump(self) -> None:
        """Do one bit of work, if no thread does it."""
        if self._thread is None and not self._closing.is_set():
            self.step()

    def close(self) -> None:
        """Ask the work to end; its thread lets go of everything within a second. May be called again."""
        if self._thread is None and not self._closing.is_set():
            self.end()
        self._closing.set()

    def wait(self, seconds: float) -> None:
        """Wait for the thread to end, at most so long."""
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join(seconds)

    def step(self) -> None:
        """One bit of work."""
        raise NotImplementedError

    def end(self) -> None:
        """Let go of everything."""

    def failed(self, error: Exception) -> None:
        """Something broke that should not; by now it is in the log."""

    def _run(self) -> None:
        if self._before is not None:
            self._before.wait(2.0)
        try:
            while not self._closing.wait(PERIOD):
                self.step()
        except Exception as error:
            log.exception("%s failed", type(self).__name__)
            self.failed(error)
        finally:
            self.end()
