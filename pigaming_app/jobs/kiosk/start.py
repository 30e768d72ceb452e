"""Start of an arcade under a supervisor."""

import signal
from collections.abc import Sequence
from datetime import datetime

from pigaming_app.jobs.kiosk.crash_reports import Evidence, crash_log_size, keep_report
from pigaming_app.jobs.kiosk.process import ArcadeProcess
from pigaming_app.jobs.kiosk.safe_start import SafeStart
from pigaming_app.jobs.kiosk.supervisor import Child, Limits, RunEnd, Supervisor
from pigaming_app.storage.safe_mode import VARIABLE
from pigaming_app.storage.settings import folders


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
