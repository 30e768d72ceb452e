"""Creation of the virtual environment and installation of its packages. Standard library only.

A lock admits one process at a time. An interrupted installation resumes at the next start. Every failure is reported
as a sentence with the remedy.
"""

import errno
import importlib.util
import os
import platform
import re
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import IO

from pigaming_app.boot.interpreter import (
    ROOT,
    StartError,
    environment_folders,
    fingerprint,
    installed_groups,
    is_missing,
    packages,
    python_of,
    report,
    requirements,
    site_packages,
)

PIP_OPTIONS = ("--only-binary=:all:", "--no-input", "--disable-pip-version-check", "--retries=2", "--progress-bar=off")
CONSTRAINTS = ROOT / "constraints.txt"  # the versions to install; `python -m tests.constraints` renews them
UNSUITABLE = r"No matching distribution|conflicting dependencies|Could not open requirements file"  # messages of pip
UNCONSTRAINED = (
    "constraints.txt does not suit this Python or system: taking the newest versions in pyproject.toml's ranges."
)
NOT_ALLOWED = {errno.EACCES, errno.EPERM, errno.EROFS}
NO_VENV = (
    "Python's venv module is missing: install it (Debian, Ubuntu, Raspberry Pi OS: sudo apt install python3-venv) "
    "and start again."
)
NO_ROOM = "the disk is full: free about 1 GB and start again."
OFFLINE = "{names} could not be fetched: connect this machine to the internet, this once, and start again."
UNKNOWN = (
    "no suitable version of {names} was found: if this machine is online, "
    "use a Python from 3.11 to 3.14 (this is {python})."
)
CAUSES = (  # (pattern in the output of a tool, message); the first match applies
    (r"No space left|Errno 28|not enough space|Disk quota", NO_ROOM),
    (r"ensurepip is not|No module named (ensurepip|venv)", NO_VENV),
    (r"Permission denied|Access is denied|Errno 13|Read-only file system", "no permission to write in {place}."),
    (r"Retrying|resol(?:ve|ution)|getaddrinfo|unreachable|refused|[Tt]imed out|[Pp]roxy|SSL|CERTIFICATE", OFFLINE),
    (r"from versions: none|No matching distribution", UNKNOWN),
)


def prepare(needed: set[str], optional: set[str]) -> Path:
    """An environment with the needed groups, and the optional ones if they can be installed. Raises StartError.

    Waits while another process is installing.
    """
    place, lock = _claimed()
    with lock:
        if not is_usable(place):
            create(place)
        if not needed <= installed_groups(place):
            install(place, needed | installed_groups(place))
        complete = installed_groups(place)
        if not optional <= complete:
            _add(place, sorted(optional - complete))
    return place


def _add(place: Path, extras: list[str]) -> None:
    """Install extras all together, or else each that can be. Raises StartError without what was there before."""
    complete = installed_groups(place)
    try:
        install(place, complete | {*extras})
    except StartError as trouble:
        if len(extras) == 1:
            report(f"{trouble} Going on without {_names(requirements(extras))}.")
        install(place, complete)
        for extra in extras if len(extras) > 1 else ():
            _add(place, [extra])


def _claimed() -> tuple[Path, IO[str]]:
    """The first writable place and its lock file, locked until it is closed or this process ends. Raises StartError."""
    for place in environment_folders():
        try:
            lock = lock_of(place)
        except OSError as error:
            if error.errno not in NOT_ALLOWED:
                raise StartError(_cause(str(error), place, [])) from error
            continue
        if not place.exists() or os.access(place, os.W_OK):
            wait_for(lock)
            return place, lock
        lock.close()
    parents = [str(place.parent) for place in environment_folders()]
    if len(parents) == 1:
        raise StartError(f"{parents[0]} cannot be written, and this user has no home folder: allow one of them.")
    raise StartError(f"neither {' nor '.join(parents)} can be written: allow one of them.")


def lock_of(place: Path) -> IO[str]:
    """The lock file of an environment, still unlocked. Raises OSError."""
    place.parent.mkdir(parents=True, exist_ok=True)
    return open(place.with_name(f"{place.name}.lock"), "a", encoding="utf-8")


def wait_for(lock: IO[str]) -> None:
    """Lock it, after another process that has it."""
    waited = False
    while not _locked(lock):
        if not waited:
            report("another start is installing at this moment; waiting for it.")
        waited = True
        time.sleep(0.2)


def _locked(lock: IO[str]) -> bool:
    """Take the lock, which the system releases when the process ends. Returns False if another process has it."""
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(lock.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return error.errno not in (errno.EWOULDBLOCK, errno.EACCES, errno.EDEADLK)  # no locks: proceed
    return True


def is_usable(place: Path) -> bool:
    """True if there is an environment with a Python that runs, is new enough and has pip."""
    if not python_of(place).exists():
        return False
    code = "import os, sys, sysconfig; print(sys.version_info >= (3, 11), os.path.isdir(sysconfig.get_path('purelib')))"
    python = [str(python_of(place)), "-I"]
    if _run([*python, "-c", code]) != (0, "True True\n"):
        return False
    return _run([*python, "-m", "pip", "--version"])[0] == 0 or _run([*python, "-m", "ensurepip"])[0] == 0


def create(place: Path) -> None:
    """Create an empty environment, replacing a broken one. Raises StartError."""
    if not (importlib.util.find_spec("venv") and importlib.util.find_spec("ensurepip")):
        raise StartError(NO_VENV)
    if place.exists():
        report(f"{place} is incomplete or its Python is missing; creating it again.")
    else:
        report(f"first start: creating {place}, for this program only.")
    code, output = _run([sys.executable, "-I", "-m", "venv", "--clear", str(place)])
    if code:
        raise StartError(_cause(output, place, []))


def report_file(name: str, version: str, size: str) -> None:
    """Report a file that is being downloaded."""
    report(f"  {name} {version}, {size}")


def install(place: Path, groups: set[str], downloads: Callable[[str, str, str], object] = report_file) -> None:
    """Install the missing packages of these groups, and record the groups as complete. Raises StartError.

    `downloads` is called for each file, with its name, version and size.
    """
    wanted = requirements(groups)
    try:
        (place / "ready").unlink(missing_ok=True)
        installed = packages([site_packages(place)])
        if missing := [requirement for requirement in wanted if is_missing(installed, requirement)]:
            report(f"fetching {_names(missing)} (only once; it may take a minute).")
        pip = [str(python_of(place)), "-I", "-m", "pip", "install", *PIP_OPTIONS]
        code, output = _run([*pip, f"--constraint={CONSTRAINTS}", *wanted], downloads)
        if code and re.search(UNSUITABLE, output):
            report(UNCONSTRAINED)
            code, output = _run([*pip, *wanted], downloads)
        if code:
            raise StartError(_cause(output, place, wanted))
        _write(place / "ready", "\n".join([fingerprint(place), *sorted(groups)]))
    except OSError as error:
        raise StartError(_cause(str(error), place, wanted)) from error


def _write(path: Path, text: str) -> None:
    """Replace a file atomically. Raises OSError."""
    draft = path.with_name(f"{path.name}.new")
    with open(draft, "w", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    os.replace(draft, path)


def _run(command: list[str], downloads: Callable[[str, str, str], object] | None = None) -> tuple[int, str]:
    """Run a tool to completion; returns exit code and output. `downloads`: called for each file that it downloads."""
    variables = {**os.environ, "PIP_USER": "0", "PIP_REQUIRE_VIRTUALENV": "0"}
    try:
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env=variables,
            encoding="utf-8",
            errors="replace",
        )
    except OSError as error:
        return 1, str(error)
    output = []
    with process:
        try:
            for line in process.stdout or []:
                output.append(line)
                match = re.match(r"\s*Downloading (?:\S*/)?(\w+)-([^-]+)-\S+\.whl \((.+?)\)", line)
                if downloads and match:
                    downloads(match[1], match[2], match[3])
        except KeyboardInterrupt:
            process.terminate()
            raise
    return process.returncode, "".join(output)


def _names(wanted: list[str]) -> str:
    return ", ".join(re.split("[<>]", requirement)[0] for requirement in wanted)


def _cause(output: str, place: Path, wanted: list[str]) -> str:
    """A message, with the remedy if known, for the output of a tool that failed."""
    missing = re.search(r"requirement ([\w.-]+)", output)
    names = missing[1] if missing else _names(wanted)
    for pattern, message in CAUSES:
        if re.search(pattern, output):
            return message.format(place=place, names=names, python=platform.python_version())
    return (output.strip() or "the installation failed.").splitlines()[-1]
