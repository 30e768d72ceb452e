"""Choice of the Python that runs the job. Standard library only, and fast: it runs before every start.

`.venv` beside main.py is used once it is ready. Otherwise this Python is used if it has every package; failing that,
environment.py makes `.venv` ready.
"""

import os
import sys
from pathlib import Path

from pigaming_app.boot.interpreter import (
    ARCADE,
    ROOT,
    WINDOWS,
    Trouble,
    both_pygames,
    lacks,
    packages,
    places,
    python_of,
    ready,
    requirements,
    say,
    site_packages,
)

NEEDED = {"test": {"test"}}
WISHED = {job: {"train"} for job in ("bench", "duel", "league", "train")}  # optional: the job runs without
WISHED |= {"test": {"train", "hardware", "plots"}}
MEANT = {  # words that ask for an extra anywhere on the command line
    **dict.fromkeys(("robots", "calibrate", "fidelity", "--emulate", "--real"), "hardware"),
    **dict.fromkeys(("--curve", "--plots"), "plots"),
}
HANDED_OVER = "pigaming"  # python -X pigaming: main.py need not ask again


def start(args: list[str]) -> int | None:
    """Hand the job over to the Python that has its packages; its exit code. None: that is this Python.

    2 where it cannot start, 130 where the installation was interrupted.
    """
    job = "" if not args or {"-h", "--help"} & set(args) else args[0]
    try:
        words = {arg.partition("=")[0] for arg in args}
        wished = WISHED.get(job, set()) | {MEANT[word] for word in words if word in MEANT}
        place = environment({ARCADE} | NEEDED.get(job, set()), wished)
        return None if place is None else hand_over(place, args)
    except Trouble as trouble:
        say(str(trouble))
        return 2
    except KeyboardInterrupt:
        say("stopped. Start it again, and it goes on from there.")
        return 130


def hand_over(place: Path, args: list[str]) -> int:
    """Run main.py in that environment: instead of this process, or on Windows as its child. Raises Trouble."""
    if both_pygames(packages([site_packages(place)])):
        say(f"{place} holds both pygame and pygame-ce, which overwrite each other: delete it and start again.")
    command = [str(python_of(place)), "-X", HANDED_OVER, str(ROOT / "main.py"), *args]
    try:
        if not WINDOWS:
            os.execv(command[0], command)
        import subprocess

        process = subprocess.Popen(command)
    except OSError as error:
        raise Trouble(f"{command[0]} cannot be run ({error.strerror}).") from error
    while True:
        try:
            return process.wait()
        except KeyboardInterrupt:  # the job received it as well, and decides
            continue


def environment(needed: set[str], wished: set[str]) -> Path | None:
    """The environment that has these groups, made ready if none has; None: this Python. Raises Trouble."""
    groups = needed | wished
    place = next((place for place in places() if groups <= ready(place)), None)
    if place and sys.prefix == sys.base_prefix:
        return place
    own = packages([Path(folder) for folder in sys.path if folder.endswith("-packages")])
    if not both_pygames(own) and not any(lacks(own, one) for one in requirements(groups)):
        return None
    if place:
        return place
    if both_pygames(own):
        say(f"{sys.prefix} holds both pygame and pygame-ce, which overwrite each other: it is not used.")
    from pigaming_app.boot.environment import prepared

    return prepared(needed, wished)
