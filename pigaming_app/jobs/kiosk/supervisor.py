"""Supervision of an arcade that nobody watches: started again after a crash, and after a hang, which ends by a kill."""

import logging
import signal
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

CLEAN = (0, 130)  # exit codes of an arcade that the operator has closed
REFUSED = 2  # exit code of one that cannot start, which its last line explains

log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class Limits:
    """Times in s. `delays`: before the first, second … restart in a row; the last one repeats."""

    poll: float = 0.25
    start: float = 60.0  # until the first beat
    hang: float = 5.0  # without a beat
    stable: float = 120.0  # after which a crash is the first in a row again
    delays: tuple[float, ...] = (0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 30.0)


@dataclass(frozen=True)
class RunEnd:
    """The end of a run. `code`: exit code, minus the signal if one ended it; None: it hung for `silent` s."""

    code: int | None
    seconds: float
    beats: int
    silent: float = 0.0

    @property
    def reason(self) -> str:
        return "hang" if self.code is None else "crash"

    @property
    def detail(self) -> str:
        """The cause as a phrase."""
        if self.code is None:
            return f"no frame for {self.silent:.0f} s"
        if self.code >= 0:
            return f"exit code {self.code}"
        try:
            return f"ended by {signal.Signals(-self.code).name}"
        except ValueError:
            return f"ended by signal {-self.code}"


class Child(Protocol):
    """A running arcade."""

    @property
    def beats(self) -> int:
        """The frames so far."""

    def poll(self) -> int | None:
        """Its exit code, None while it runs."""

    def end(self) -> None:
        """Ask it to close, and kill it if it does not."""

    def kill(self) -> None:
        """Kill it at once, after its stacks were written to its crash log."""

    def close(self) -> None:
        """Free its resources, once it has ended."""


class Supervisor:
    """Starts arcades by `start`, one after the other. `report` is called with each that crashed or hung, `watch` with
    the frames of one that is running.
    """

    def __init__(
        self,
        start: Callable[[], Child],
        report: Callable[[Child, RunEnd], None],
        limits: Limits,
        watch: Callable[[int], None] = lambda _: None,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._start, self._report, self._limits, self._also_watch = start, report, limits, watch
        self._clock, self._sleep = clock, sleep

    def run(self) -> int:
        """Supervise until the arcade is closed, also by Ctrl+C. Returns the exit code. Raises OSError."""
        try:
            return self._run()
        except KeyboardInterrupt:
            return 0

    def _run(self) -> int:
        crashes, shown = 0, False
        while True:
            child = self._start()
            try:
                ending = self._watch(child)
                if ending.code in CLEAN:
                    return 0
                shown = shown or ending.beats > 0
                if ending.code == REFUSED and not shown:
                    return REFUSED
                self._try_to_report(child, ending)
            except KeyboardInterrupt:
                child.end()
                raise
            finally:
                child.close()
            crashes = 1 if ending.seconds >= self._limits.stable else crashes + 1
            self._sleep(self._limits.delays[min(crashes, len(self._limits.delays)) - 1])

    def _watch(self, child: Child) -> RunEnd:
        """Wait for the end of an arcade; kill it if it hangs."""
        began = last = self._clock()
        beats, silent = 0, 0.0
        while (code := child.poll()) is None:
            now = self._clock()
            if child.beats != beats:
                beats, silent = child.beats, 0.0
            else:
                silent += min(now - last, 2 * self._limits.poll)  # this process may have been suspended as well
            last = now
            if silent > (self._limits.hang if beats else self._limits.start):
                child.kill()
                break
            self._also_watch(child.beats)
            self._sleep(self._limits.poll)
        return RunEnd(code, self._clock() - began, child.beats, silent)

    def _try_to_report(self, child: Child, ending: RunEnd) -> None:
        try:
            self._report(child, ending)
        except Exception:  # the arcade starts again, whatever is wrong with the disk
            log.exception("the crash could not be reported")
