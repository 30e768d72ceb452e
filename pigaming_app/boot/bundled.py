"""Start of a bundle, whose program takes the place of a Python interpreter for its own processes."""

import multiprocessing
import runpy
import sys

PACKAGE = "pigaming_app."


def run_module(args: list[str]) -> bool:
    """Run `-m MODULE ARGUMENTS…` like an interpreter, for modules of this package only. False: they are for a job.

    Processes of multiprocessing run here, too, and never return.
    """
    multiprocessing.freeze_support()
    if args[:1] != ["-m"] or not args[1:] or not args[1].startswith(PACKAGE):
        return False
    sys.argv = args[1:]
    runpy.run_module(args[1], run_name="__main__", alter_sys=True)
    return True
