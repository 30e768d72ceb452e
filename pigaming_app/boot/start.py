"""Choice of the Python that runs the job. Standard library only; it must be fast, since it runs at every start.

`.venv` next to main.py is used if it is ready; otherwise this Python, if it has every package; otherwise environment.py
creates or completes `.venv`.
"""

import os
import signal
import sys
from pathlib import Path

from pigaming_app.boot.interpreter import (
    ARCADE,
    ROOT,
    WINDOWS,
    StartError,
    environment_folders,
    has_both_pygames,
    installed_groups,
    is_missing,
    packages,
    python_of,
    report,
    requirements,
    site_packages,
)

NEEDED = {"test": {"test"}, "bundle": {"bundle"}}
OPTIONAL = {
    job: {"train"} for job in ("bench", "duel", "exploit", "league", "train")
}  # extras that a job also runs without
OPTIONAL |= {"test": {"train", "hardware", "plots", "gym", "onnx", "phones"}, "bench": {"train", "gym", "bench"}}
OPTIONAL |= {"bundle": {"train", "hardware", "phones", "events"}}
WITH_WIFI = {"hardware", "phones"}  # extras that come with `keyring`, for the Wi-Fi's password
EXTRA_OF_WORD = {  # words that require an extra anywhere on the command line
    **dict.fromkeys(("robots", "calibrate", "fidelity", "ros", "--emulate", "--real"), "hardware"),
    **dict.fromkeys(("--curve", "--plots"), "plots"),
    **dict.fromkeys(("phones", "--phones", "desk", "bots"), "phones"),
    "--poster": "events",
    "--certificates": "events",
    **dict.fromkeys(("--ray", "--long"), "ray"),  # the long proofs train on several machines
}
EXTRA_OF_FILE = {".onnx": "onnx", "bot:": "phones"}  # parts of names of AIs that require an extra
HANDED_OVER = "pigaming"  # python -X pigaming: main.py skips boot


def start(args: list[str]) -> int | None:
    """Run the job in the Python that has its packages and return its exit code. None: that is this Python.

    Returns 2 if it cannot start, 130 if the installation was interrupted.
    """
    try:
        place = environment({ARCADE} | NEEDED.get(job_of(args), set()), extras(args))
        return None if place is None else hand_over(place, args)
    except StartError as trouble:
        report(str(trouble))
        return 2
    except KeyboardInterrupt:
        report("stopped. Start it again, and it goes on from there.")
        return 130


def job_of(args: list[str]) -> str:
    """The job of a command line, or nothing where only its help is asked for."""
    return "" if not args or {"-h", "--help"} & set(args) else args[0]


def extras(args: list[str]) -> set[str]:
    """The extras that a command line may use."""
    found = {EXTRA_OF_WORD[word] for word in (arg.partition("=")[0] for arg in args) if word in EXTRA_OF_WORD}
    found |= {extra for suffix, extra in EXTRA_OF_FILE.items() if any(suffix in arg.lower() for arg in args)}
    found |= OPTIONAL.get(job_of(args), set())
    return found | {"keyring"} if found & WITH_WIFI else found


def hand_over(place: Path, args: list[str]) -> int:
    """Run main.py in an environment, replacing this process, or on Windows as its child. Raises StartError."""
    if has_both_pygames(packages([site_packages(place)])):
        report(f"{place} holds both pygame and pygame-ce, which overwrite each other: delete it and start again.")
    command = [str(python_of(place)), "-X", HANDED_OVER, str(ROOT / "main.py"), *args]
    try:
        if not WINDOWS:
            os.execv(command[0], command)
        import subprocess

        process = subprocess.Popen(command)
    except OSError as error:
        raise StartError(f"{command[0]} cannot be run ({error.strerror}).") from error
    while True:
        try:
            return process.wait()
        except KeyboardInterrupt:  # the job receives it as well, and handles it
            continue


def environment(needed: set[str], optional: set[str]) -> Path | None:
    """An environment with these groups, prepared if there is none; None: this Python has them. Raises StartError."""
    groups = needed | optional
    place = next((place for place in environment_folders() if groups <= installed_groups(place)), None)
    if place and sys.prefix == sys.base_prefix:
        return place
    own = packages([Path(folder) for folder in sys.path if folder.endswith("-packages")])
    if not has_both_pygames(own) and not any(is_missing(own, requirement) for requirement in requirements(groups)):
        return None
    if place:
        return place
    if has_both_pygames(own):
        report(f"{sys.prefix} holds both pygame and pygame-ce, which overwrite each other: it is not used.")
    from pigaming_app.boot.environment import prepare

    _answer_interrupts(True)
    place = prepare(needed, optional)
    _answer_interrupts(False)
    return place


def _answer_interrupts(answer: bool) -> None:
    """Raise KeyboardInterrupt at Ctrl-C, or leave it pending for the job. Windows always raises it."""
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK if answer else signal.SIG_BLOCK, {signal.SIGINT})
