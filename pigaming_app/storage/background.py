"""Processes in the background of the arcade, which delay no frame and end with it."""

import contextlib
import os
import sys
from threading import Thread
from typing import TYPE_CHECKING

from pigaming_app import ROOT

if TYPE_CHECKING:
    from subprocess import Popen

PATIENCE = 10  # POSIX nice value of such a process
BLAS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")  # threads of NumPy's matrix products


def launch(command: tuple[str, ...], answers: bool = False) -> "Popen[bytes]":
    """Start a background process with a pipe as standard input, and with `answers` as standard output. Raises OSError.

    NumPy's matrix products stay in the threads that call them.
    """
    import subprocess  # late, for the start of the arcade

    null = subprocess.DEVNULL
    names = ("CREATE_NO_WINDOW", "BELOW_NORMAL_PRIORITY_CLASS")  # defined on Windows only
    flags: int = sum(getattr(subprocess, name, 0) for name in names)
    process = subprocess.Popen(
        command,
        cwd=ROOT,
        env=os.environ | dict.fromkeys(BLAS, "1"),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE if answers else null,
        stderr=null,
        creationflags=flags,
    )
    if hasattr(os, "setpriority"):  # not on Windows
        with contextlib.suppress(OSError):
            os.setpriority(os.PRIO_PROCESS, process.pid, PATIENCE)
    return process


def exit_with_parent() -> None:
    """Exit this process with code 1 as soon as its standard input closes, as it does when the parent ends."""

    def wait() -> None:
        os.read(sys.stdin.fileno(), 1)  # a buffered read would abort the interpreter at its normal end
        os._exit(1)

    Thread(target=wait, daemon=True).start()
