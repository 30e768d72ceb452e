"""The watchdog: it ends foreign code that does not come back, and nothing else."""

import subprocess
import sys
from contextlib import suppress
from time import monotonic, sleep
from weakref import ref

import pytest

from pigaming_app import ROOT
from pigaming_app.storage.plugins.time_limit import TookTooLong, Watchdog

LIMIT = 0.05  # s
PROFILED = """
import cProfile
from contextlib import suppress
from time import monotonic
from pigaming_app.storage.plugins.time_limit import TookTooLong, Watchdog, time_limit

def loop():
    end = monotonic() + {seconds}
    while monotonic() < end:
        pass

with suppress(TimeoutError), time_limit({limit}):
    loop()
with Watchdog({limit}, lambda frame: frame.f_code is loop.__code__) as watchdog:
    with suppress(TookTooLong):
        loop()
    watchdog.beat()
    cProfile.run("sum(map(abs, range(9)))")
"""


def endless(seconds: float = 30.0) -> None:
    """A loop that catches all exceptions of programs, for so long at most."""
    end = monotonic() + seconds
    while monotonic() < end:
        with suppress(Exception):
            sleep(0.001)


def test_it_ends_foreign_code_each_time() -> None:
    watchdog = Watchdog(LIMIT, lambda frame: frame.f_code is endless.__code__)
    with watchdog:
        for _ in range(2):
            watchdog.beat()
            with pytest.raises(TookTooLong, match="did not end"):
                endless()


def test_our_own_code_may_take_longer() -> None:
    with Watchdog(LIMIT, lambda frame: False):
        endless(6 * LIMIT)


def test_nothing_is_raised_between_beats_or_after_the_end() -> None:
    with Watchdog(1.0, lambda frame: True) as watchdog:
        for _ in range(4):
            watchdog.beat()
            endless(0.3)
    with Watchdog(LIMIT, lambda frame: True):
        pass
    endless(6 * LIMIT)


def test_it_keeps_no_variable_of_a_frame_alive() -> None:
    """A view of a surface that lives longer than its function locks the surface."""

    def painted() -> "ref[Watchdog]":
        view = Watchdog(LIMIT, lambda frame: False)
        endless(3 * LIMIT)
        return ref(view)

    with Watchdog(10 * LIMIT, lambda frame: True):
        for _ in range(3):
            assert painted()() is None


@pytest.mark.parametrize(("limit", "seconds"), [(60.0, 0.0), (0.02, 30.0)])
def test_nothing_stays_pending_which_would_keep_a_profiler_in_one_instruction(limit: float, seconds: float) -> None:
    code = PROFILED.format(limit=limit, seconds=seconds)
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")
    assert "function calls" in done.stdout
