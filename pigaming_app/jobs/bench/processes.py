"""Fresh processes that measure beside each other, and end at the latest with what asked for them."""

import signal
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import active_children, get_context, resource_tracker


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
