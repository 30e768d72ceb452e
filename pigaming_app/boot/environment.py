"""The first start: make the environment and fetch the packages into it, one start at a time. Standard library only.

It can be stopped at any moment and started again. Whatever goes wrong is one sentence that says what to do.
"""

import errno
import importlib.util
import os
import platform
import re
import subprocess
import sys
import time
from pathlib import Path
from typing import IO

from pigaming_app.boot.interpreter import (
    Trouble,
    lacks,
    packages,
    places,
    python_of,
    ready,
    requirements,
    say,
    site_packages,
    standing_on,
)
from pigaming_app.storage.safe_files import write_atomic

PIP_OPTIONS = ("--only-binary=:all:", "--no-input", "--disable-pip-version-check", "--retries=2", "--progress-bar=off")
NOT_ALLOWED = {errno.EACCES, errno.EPERM, errno.EROFS}
NO_VENV = (
    "Python's venv module is missing: install it (Debian, Ubuntu, Raspberry Pi OS: sudo apt install python3-venv) "
    "and start again."
)
NO_ROOM = "the disk is full: free about 1 GB and start again."
OFFLINE = "{names} could not be fetched: connect this machine to the internet, this once, and start again."
UNKNOWN = "{names} is not to be had: if this machine is online, use a Python from 3.11 to 3.14 (this is {python})."
CAUSES = (  # the first of these words in what a tool said decides
    (r"No space left|Errno 28|not enough space|Disk quota", NO_ROOM),
    (r"ensurepip is not|No module named (ensurepip|venv)", NO_VENV),
    (r"Permission denied|Access is denied|Errno 13|Read-only file system", "no permission to write in {place}."),
    (r"Retrying|resol(?:ve|ution)|getaddrinfo|unreachable|refused|[Tt]imed out|[Pp]roxy|SSL|CERTIFICATE", OFFLINE),
    (r"from versions: none|No matching distribution", UNKNOWN),
)


def prepared(needed: set[str], wished: set[str]) -> Path:
    """An environment with these groups; another start that makes one is waited for. Raises Trouble."""
    place, lock = _claimed()
    with lock:
        if not works(place):
            make(place)
        if not needed <= ready(place):
            install(place, needed | ready(place))
        whole = ready(place)
        if not wished <= whole:
            try:
                install(place, whole | wished)
            except Trouble as trouble:
                say(f"{trouble} Going on without {_names(requirements(wished))}.")
                install(place, whole)
    return place


def _claimed() -> tuple[Path, IO[str]]:
    """The first place that can be written, locked until the file is closed or this process dies."""
    for place in places():
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
            lock = open(place.with_name(f"{place.name}.lock"), "a", encoding="utf-8")  # noqa: SIM115
        except OSError as error:
            if error.errno not in NOT_ALLOWED:
                raise Trouble(_cause(str(error), place, [])) from error
            continue
        if not place.exists() or os.access(place, os.W_OK):
            _wait_for(lock)
            return place, lock
        lock.close()
    raise Trouble(f"neither {' nor '.join(str(place.parent) for place in places())} can be written: allow one of them.")


def _wait_for(lock: IO[str]) -> None:
    told = False
    while not _locked(lock):
        if not told:
            say("another start is installing at this moment; waiting for it.")
        told = True
        time.sleep(0.2)


def _locked(lock: IO[str]) -> bool:
    """Take the lock, which the system gives back when the process ends, however it ends. False: someone has it."""
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(lock.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return error.errno not in (errno.EWOULDBLOCK, errno.EACCES, errno.EDEADLK)  # a disk without locks: go on
    return True


def works(place: Path) -> bool:
    """Whether an environment is there with a Python that runs, is new enough and finds its pip."""
    if not python_of(place).exists():
        return False
    look = "import os, sys, sysconfig; print(sys.version_info >= (3, 11), os.path.isdir(sysconfig.get_path('purelib')))"
    python = [str(python_of(place)), "-I"]
    if _run([*python, "-c", look]) != (0, "True True\n"):
        return False
    return _run([*python, "-m", "pip", "--version"])[0] == 0 or _run([*python, "-m", "ensurepip"])[0] == 0


def make(place: Path) -> None:
    """Make an empty environment, in the place of a broken one if there is any. Raises Trouble."""
    if not (importlib.util.find_spec("venv") and importlib.util.find_spec("ensurepip")):
        raise Trouble(NO_VENV)
    if place.exists():
        say(f"{place} is not whole, or its Python has gone; making it again.")
    else:
        say(f"first start: making {place}, for this program only.")
    code, said = _run([sys.executable, "-I", "-m", "venv", "--clear", str(place)])
    if code:
        raise Trouble(_cause(said, place, []))


def install(place: Path, groups: set[str]) -> None:
    """Fetch what is missing of these groups, and note that they are whole. Raises Trouble."""
    wanted = requirements(groups)
    try:
        (place / "ready").unlink(missing_ok=True)
        installed = packages([site_packages(place)])
        if fetched := [one for one in wanted if lacks(installed, one)]:
            say(f"fetching {_names(fetched)} (only once; it may take a minute).")
        code, said = _run([str(python_of(place)), "-I", "-m", "pip", "install", *PIP_OPTIONS, *wanted], tell=True)
        if code:
            raise Trouble(_cause(said, place, wanted))
        write_atomic(place / "ready", "\n".join([standing_on(place), *sorted(groups)]).encode())
    except OSError as error:
        raise Trouble(_cause(str(error), place, wanted)) from error


def _run(command: list[str], tell: bool = False) -> tuple[int, str]:
    """Run a tool to its end; its exit code and all that it said. `tell`: name every file that it downloads."""
    surroundings = {**os.environ, "PIP_USER": "0", "PIP_REQUIRE_VIRTUALENV": "0"}
    try:
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env=surroundings,
            encoding="utf-8",
            errors="replace",
        )
    except OSError as error:
        return 1, str(error)
    said = []
    with process:
        try:
            for line in process.stdout or []:
                said.append(line)
                if tell and (match := re.match(r"\s*Downloading (?:\S*/)?(\w+)-([^-]+)-\S+\.whl \((.+?)\)", line)):
                    say(f"  {match[1]} {match[2]}, {match[3]}")
        except KeyboardInterrupt:
            process.terminate()
            raise
    return process.returncode, "".join(said)


def _names(wanted: list[str]) -> str:
    return ", ".join(re.split("[<>]", one)[0] for one in wanted)


def _cause(said: str, place: Path, wanted: list[str]) -> str:
    """One sentence for what a tool said."""
    missing = re.search(r"requirement ([\w.-]+)", said)
    about = {"place": place, "names": missing[1] if missing else _names(wanted), "python": platform.python_version()}
    for words, sentence in CAUSES:
        if re.search(words, said):
            return sentence.format(**about)
    return (said.strip() or "the installing failed.").splitlines()[-1]
