"""Start of an arcade under a supervisor."""

import logging
import signal
import sys
import time
from collections.abc import Callable, Sequence
from datetime import datetime
from pathlib import Path

from pigaming_app.jobs.kiosk.crash_reports import Evidence, crash_log_size, keep_report
from pigaming_app.jobs.kiosk.process import ArcadeProcess
from pigaming_app.jobs.kiosk.supervisor import Child, Limits, RunEnd, Supervisor
from pigaming_app.scenes.kiosk import safe_start
from pigaming_app.storage.log import append_line
from pigaming_app.storage.safe_mode import VARIABLE
from pigaming_app.storage.settings import folders

ONCE_TAKEN_BACK, ONCE_SAFE = 2, 5  # restarts in a row, each within a minute of a start or of a setting's change

log = logging.getLogger("pigaming")


class SafeStart:
    """Watches the settings in the folder `config` while arcades run. `safe`: the next one starts in safe mode."""

    def __init__(self, config: Path, data: Path, clock: Callable[[], float] = time.monotonic) -> None:
        self.config, self.data, self.clock = config, data, clock
        self.safe, self.restarts = False, 0
        self._contents, self._since = safe_start.contents(config), clock()  # of the settings, unchanged since then
        self._kept = False
        self._try(lambda: safe_start.begin(config))

    def start(self) -> None:
        """An arcade starts."""
        self._contents, self._since, self._kept = safe_start.contents(self.config), self.clock(), False

    def watch(self, beats: int) -> None:
        """An arcade is running: keep settings with which it has drawn pictures for a minute."""
        contents = safe_start.contents(self.config)
        if contents != self._contents or not beats:
            self._contents, self._since, self._kept = contents, self.clock(), False
        elif not self._kept and self.clock() - self._since >= safe_start.MINUTE:
            self._kept = True
            if not self.safe:
                self._try(lambda: safe_start.keep(self.config, contents))

    def restart(self) -> None:
        """An arcade has crashed or hung: take changes back, or choose safe mode."""
        self.restarts = 0 if self._kept else self.restarts + 1
        if self.restarts in (ONCE_TAKEN_BACK, ONCE_SAFE):
            self._try(self._take_back)
        if self.restarts == ONCE_SAFE:
            self.safe = True
            self._tell("Five starts have failed: screens, phones and plug-ins have defaults until the kiosk is closed.")

    def _take_back(self) -> None:
        if names := safe_start.take_back(self.config):
            self._tell(f"Two starts have failed: these settings were taken back: {', '.join(names)}.")

    def _tell(self, sentence: str) -> None:
        print(f"PiGaming: {sentence}", file=sys.stderr, flush=True)
        append_line(self.data, sentence)

    def _try(self, change: Callable[[], object]) -> None:
        """A full disk must not keep the arcade from starting."""
        try:
            change()
        except OSError:
            log.exception("the settings could not be kept or taken back")


def supervise(command: Sequence[str], limits: Limits | None = None) -> int:
    """Keep an arcade running until the operator closes it. Returns the exit code. Raises OSError.

    `command` starts the arcade, which gets its heartbeat by `child.heartbeat`. SIGTERM ends both, like Ctrl+C.
    """
    data = folders().data
    safe_start = SafeStart(folders().config, data)
    stacks_from = 0

    def start() -> Child:
        nonlocal stacks_from
        stacks_from = crash_log_size(data)
        safe_start.start()
        return ArcadeProcess(command, {VARIABLE: "1"} if safe_start.safe else {})

    def report(child: Child, ending: RunEnd) -> None:
        assert isinstance(child, ArcadeProcess)
        safe_start.restart()
        keep_report(data, ending, Evidence(tuple(child.errors), child.picture, stacks_from), datetime.now())

    before = [(number, signal.signal(number, signal.default_int_handler)) for number in (signal.SIGTERM, signal.SIGINT)]
    try:
        return Supervisor(start, report, limits or Limits(), safe_start.watch).run()
    finally:
        for number, handler in before:
            signal.signal(number, handler)
