"""Fresh processes that measure beside each other, and end at the latest with what asked for them."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import active_children, get_context, resource_tracker
from tempfile import TemporaryDirectory
from typing import Any

from pigaming_app import ROOT


def figures_of(module: str, *words: str) -> Any:
    """The JSON in the last line that a module prints, without a window and with files of its own.

    Raises subprocess.CalledProcessError.
    """
    with TemporaryDirectory() as home:
        headless = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PIGAMING_HOME": home}
        command = [sys.executable, "-m", f"pigaming_app.{module}", *words]
        done = subprocess.run(
            command, env={**os.environ, **headless}, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True
        )
    return json.loads(done.stdout.splitlines()[-1])


@contextmanager
def processes(count: int, initializer: Callable[[], object] | None = None) -> Iterator[ProcessPoolExecutor]:
    """A pool of `count` processes, which are killed if the context ends by an exception, as by Ctrl-C."""
    if hasattr(signal, "pthread_sigmask"):
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, ())
        resource_tracker.ensure_running()  # its start unblocks SIGINT, which the processes must not receive
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
    with ProcessPoolExecutor(count, get_context("spawn"), initializer) as pool:
        try:
            yield pool
        except BaseException:
            for process in active_children():
                process.kill()
            raise
