"""The job `doctor`: what is there, what is missing, and what to do about it."""

import json
import os
import platform
import shutil
import sys
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from importlib.metadata import PackageNotFoundError, version

from pigaming_app import ASSETS
from pigaming_app.settings import folders

NEEDED = ("pygame-ce", "numpy", "platformdirs", "tomli-w")
OPTIONAL = {
    "numba": "training and bench are slow without it: pip install numba",
    "opencv-python-headless": "only real robots need it",
    "pyserial": "only real robots need it",
}
ROOM = 100_000_000  # bytes of free disk, below which it is said


@dataclass(frozen=True)
class Line:
    """One thing that was looked at. `state`: ok, note (one can play all the same) or problem."""

    what: str
    state: str
    found: str
    advice: str = ""


def run(as_json: bool) -> int:
    """Print the report; 1 if something prevents playing."""
    lines = report()
    if as_json:
        print(json.dumps({"lines": [asdict(line) for line in lines]}))
    else:
        for line in lines:
            print(f"{line.state:8} {line.what:24} {line.found}{'  ->  ' + line.advice if line.advice else ''}")
    return int(any(line.state == "problem" for line in lines))


def report() -> list[Line]:
    """Everything worth looking at. It never raises: what fails becomes a line."""
    return [*_system(), *_packages(), *_folders(), *_devices(), *_engine()]


def _system() -> Iterator[Line]:
    good = sys.version_info >= (3, 11)
    yield Line(
        "Python", "ok" if good else "problem", platform.python_version(), "" if good else "3.11 or newer is needed"
    )
    yield Line(
        "system", "ok", f"{platform.system()} {platform.release()}, {platform.machine()}, {os.cpu_count()} cores"
    )


def _packages() -> Iterator[Line]:
    for name in NEEDED:
        found = _version(name)
        yield Line(name, "ok" if found else "problem", found or "missing", "" if found else "start main.py once more")
    if _version("pygame"):
        advice = "they overwrite each other: uninstall both, then install pygame-ce"
        yield Line("pygame", "problem", "installed beside pygame-ce", advice)
    for name, advice in OPTIONAL.items():
        found = _version(name)
        yield Line(name, "ok" if found else "note", found or "not installed", "" if found else advice)


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def _folders() -> Iterator[Line]:
    where = folders()
    for what, folder in (("settings", where.config), ("scores, pictures, log", where.data)):
        try:
            folder.mkdir(parents=True, exist_ok=True)
            writable = os.access(folder, os.W_OK)
        except OSError:
            writable = False
        advice = "" if writable else "it cannot be written to: nothing will be kept"
        yield Line(what, "ok" if writable else "note", str(folder), advice)
        if writable and (room := shutil.disk_usage(folder).free) < ROOM:
            yield Line("disk", "note", f"{room // 1_000_000} MB free", "scores may not be saved")
    missing = [name for name in ("arenas", "fonts", "sounds", "text") if not (ASSETS / name).is_dir()]
    found = "all there" if not missing else "missing: " + ", ".join(missing)
    yield Line("assets", "problem" if missing else "ok", found, "clone the repository anew" if missing else "")


def _devices() -> Iterator[Line]:
    if not _version("pygame-ce"):
        return
    from pigaming_app.scenes import probe

    yield _looked(
        "displays", lambda: ", ".join(probe.displays()), "use play --headless, or connect a screen", "problem"
    )
    yield _looked("sound", probe.sound, "no sound card: the arcade is silent", "note")
    yield _looked("pads", lambda: ", ".join(probe.pads()) or "none; the keyboard does too", "", "note")
    yield _looked("fonts", lambda: "readable" if probe.fonts() else "", "clone the repository anew", "problem")


def _engine() -> Iterator[Line]:
    def played() -> str:
        from pigaming_app.games.choices import choose
        from pigaming_app.playing import seated

        match = seated(choose("pitanks", ["easy", "hard"], "classic", 1, 1, None, None, ["easy", "hard"]))
        for _ in range(50):
            match.tick()
        return "a second of a match was played"

    yield _looked("engine", played, "clone the repository anew", "problem")


def _looked(what: str, look: Callable[[], str], advice: str, otherwise: str) -> Line:
    """What a look found; nothing, or a failure, is `otherwise`."""
    try:
        found = look()
    except Exception as trouble:
        return Line(what, otherwise, f"{trouble}", advice)
    return Line(what, "ok", found) if found else Line(what, otherwise, "none", advice)
