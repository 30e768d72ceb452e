"""Inspection of interpreters, environments and installed packages. Standard library only.

The file `ready` in an environment lists the groups of packages that are complete, and a fingerprint of its base Python.
"""

import os
import re
import sys
import zlib
from collections.abc import Iterable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROJECT = ROOT / "pyproject.toml"
ARCADE = "arcade"  # group of packages that every job needs; the other groups are the extras of pyproject.toml
WINDOWS = sys.platform == "win32"


class StartError(Exception):
    """The program cannot start. The text is a sentence with the remedy."""


def report(text: str) -> None:
    """Print a line on standard error; standard output is reserved for the job."""
    print(f"PiGaming: {text}", file=sys.stderr, flush=True)


def requirements(groups: Iterable[str]) -> list[str]:
    """The packages of these groups, as pyproject.toml lists them. Raises StartError."""
    import tomllib

    try:
        project = tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]
        listed = {**project["optional-dependencies"], ARCADE: project["dependencies"]}
        return [requirement for group in sorted(groups) for requirement in listed[group]]
    except (OSError, ValueError, KeyError) as error:
        raise StartError(f"{PROJECT} cannot be read ({error}): get the whole folder again.") from error


def packages(folders: Iterable[Path]) -> dict[str, str]:
    """Versions by name of the packages installed in the folders. Ten times faster than importlib.metadata."""
    versions: dict[str, str] = {}
    for folder in folders:
        for entry in os.listdir(folder) if folder.is_dir() else []:
            if match := re.fullmatch(r"(.+?)-(\d[^-]*)(?:-py[\d.]+)?\.(?:dist|egg)-info", entry):
                versions.setdefault(re.sub(r"[-_.]+", "-", match[1]).lower(), match[2])
    return versions


def is_missing(installed: dict[str, str], requirement: str) -> bool:
    """True if no installed package satisfies the requirement, of the form `name>=1.2,<3`."""
    name, *bounds = re.split(r"(?=[<>])|,", requirement)
    if name not in installed:
        return True
    version = _numbers(installed[name])
    return any(
        version < _numbers(bound) if bound.startswith(">=") else version >= _numbers(bound) for bound in bounds if bound
    )


def _numbers(text: str) -> list[int]:
    """The leading numbers of a version or a bound: [2, 5, 8] of 2.5.8.dev1."""
    match = re.search(r"\d+(\.\d+)*", text)
    return [int(part) for part in match[0].split(".")] if match else []


def has_both_pygames(installed: dict[str, str]) -> bool:
    """True if both pygame and pygame-ce are installed; they overwrite each other's files."""
    return "pygame" in installed and "pygame-ce" in installed


def environment_folders() -> list[Path]:
    """Possible folders of the environment, in order: next to main.py, and in the user's data folder, if there is one."""
    try:
        return [ROOT / ".venv", _data_folder() / f"venv-{zlib.crc32(bytes(ROOT)):08x}"]
    except RuntimeError:
        return [ROOT / ".venv"]


def _data_folder() -> Path:
    """The user's data folder. Raises RuntimeError for a user without a home folder."""
    if override := os.environ.get("PIGAMING_HOME"):
        return Path(override)
    if WINDOWS:
        return Path(os.environ.get("LOCALAPPDATA") or Path.home(), "pigaming")
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Application Support" / "pigaming"
    return Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share", "pigaming")


def python_of(place: Path) -> Path:
    """The interpreter of an environment."""
    return place / "Scripts" / "python.exe" if WINDOWS else place / "bin" / "python"


def site_packages(place: Path) -> Path:
    """The folder of an environment's packages."""
    if WINDOWS:
        return place / "Lib" / "site-packages"
    return next(place.glob("lib/python3*/site-packages"), place / "lib")


def installed_groups(place: Path) -> set[str]:
    """The groups that are complete; none if pyproject.toml or the base Python has changed since."""
    try:
        fingerprint_then, *groups = (place / "ready").read_text(encoding="utf-8").splitlines()
        return set(groups) if fingerprint_then == fingerprint(place) else set()
    except (OSError, ValueError):
        return set()


def fingerprint(place: Path) -> str:
    """A fingerprint of pyproject.toml and of an environment's base Python. Raises OSError if either is missing."""
    python = python_of(place).resolve()
    if WINDOWS:  # python.exe of an environment is only a launcher
        lines = (place / "pyvenv.cfg").read_text(encoding="utf-8").splitlines()
        python = Path(next(line.partition("=")[2].strip() for line in lines if line.startswith("home")), "python.exe")
    status = python.stat()
    return f"{zlib.crc32(PROJECT.read_bytes()):08x} {python} {status.st_size} {int(status.st_mtime)}"
