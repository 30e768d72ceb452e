"""Background work in small steps, so that no frame of the arcade waits for a camera.

A thread carries out the steps until shortly after `close`; in simulated time the owner of the clock calls `pump`.
"""

import logging
import threading
from typing import Self

PERIOD = 0.005  # s between two steps

log = logging.getLogger("pigaming")


class BackgroundWorker:
    """Subclasses implement `step`, a small unit of work, and `end`, which releases their resources."""

    def __init__(self) -> None:
        self._closing = threading.Event()
        self._thread: threading.Thread | None = None
        self._predecessor: BackgroundWorker | None = None

    def start(self, before: "BackgroundWorker | None" = None) -> Self:
        """Run in a thread until `close`, once `before`, which may hold the same camera, has ended."""
        self._predecessor = before
        self._thread = threading.Thread(target=self._run, name=type(self).__name__.lower(), daemon=True)
        self._thread.start()
        return self

    def pump(self) -> None:
        """Carry out one step, unless a thread does."""
        if self._thread is None and not self._closing.is_set():
            self.step()

    def close(self) -> None:
        """Request the end; a thread releases its resources within a second. Idempotent."""
        if self._thread is None and not self._closing.is_set():
            self.end()
        self._closing.set()

    def wait(self, seconds: float) -> None:
        """Wait for the end of the thread, at most `seconds`."""
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join(seconds)

    def step(self) -> None:
        """Carry out one small unit of work."""
        raise NotImplementedError

    def end(self) -> None:
        """Release all resources."""

    def failed(self, error: Exception) -> None:
        """Handle an unexpected error of `step`; it has been logged."""

    def _run(self) -> None:
        if self._predecessor is not None:
            self._predecessor.wait(2.0)
        try:
            while not self._closing.wait(PERIOD):
                self.step()
        except Exception as error:
            log.exception("%s failed", type(self).__name__)
            self.failed(error)
        finally:
            self.end()
