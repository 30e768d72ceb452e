"""Starts the robot's program. On the robot this file is `main.py`, and stays as USB has written it.

The program stands beside it, or in the folder `a` or `b` if it came over the air (see update.py). The file `kept`
names the folder of the program that has proven itself, `trial` that of a new one, which is started once: if it is not
kept, it starves its watchdog, and the next start is that of the program before.
"""

import os
import sys

from machine import WDT

FOLDERS = "a", "b"


def named(file):
    """The folder in a file; empty if there is none."""
    try:
        with open(file) as text:
            folder = text.read()
    except OSError:
        return ""
    return folder if folder in FOLDERS else ""


folder, watchdog = named("trial"), None
if folder:
    os.remove("trial")  # whatever happens from here on, it is not tried again
    watchdog = WDT(timeout=8000)
else:
    folder = named("kept")
if folder:
    sys.path.insert(0, folder)

import robot  # noqa: E402

robot.main(watchdog)
