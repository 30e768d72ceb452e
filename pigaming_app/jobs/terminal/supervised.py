"""The supervised side: an arcade that beats, and ends when its supervisor ends."""

import _thread
import contextlib
import os
import signal
import sys
import time
from pathlib import Path
from threading import Thread

from pigaming_app.storage.heartbeat import Heartbeat

VARIABLE = "PIGAMING_HEARTBEAT"  # of the environment: the file of the heartbeat
GRACE = 5.0  # s for the arcade to close


def is_supervised() -> bool:
    """True in a process that a supervisor has started."""
    return VARIABLE in os.environ


def heartbeat() -> Heartbeat | None:
    """The heartbeat that the supervisor reads; None without one. Call once. Raises OSError.

    From now on this process closes when its standard input does, as after the end of the supervisor.
    """
    if (name := os.environ.pop(VARIABLE, None)) is None:
        return None
    found = Heartbeat(Path(name))
    if os.name != "nt":  # Windows cannot delete open files; the supervisor does it in the end
        with contextlib.suppress(OSError):
            os.unlink(name)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    Thread(target=_end_with_supervisor, daemon=True).start()
    return found


def _end_with_supervisor() -> None:
    with contextlib.suppress(OSError):
        os.read(sys.__stdin__.fileno() if sys.__stdin__ else 0, 1)
    _thread.interrupt_main(signal.SIGTERM)
    time.sleep(GRACE)
    os._exit(1)
