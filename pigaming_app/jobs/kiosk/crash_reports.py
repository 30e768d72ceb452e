"""Crash reports of a supervised arcade: a text and a picture of the screen in the data folder, the newest ones only."""

import contextlib
import platform
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from datetime import datetime
from importlib import metadata
from pathlib import Path

from pigaming_app import __version__
from pigaming_app.jobs.kiosk.supervisor import RunEnd
from pigaming_app.storage.log import CRASH_FILE, FILE
from pigaming_app.storage.restarts import Restart, append_restart
from pigaming_app.storage.safe_files import write_atomic

FOLDER = "crashes"  # below the data folder
KEPT = 20  # reports
LOG_BYTES = 20_000  # at the end of a log
PACKAGES = ("pygame-ce", "numpy", "numba", "opencv-python-headless", "pyserial")


@dataclass(frozen=True)
class Evidence:
    """What a crashed or hung arcade left: its last lines on standard error, and its screen, see `Heartbeat`."""

    errors: Iterable[str]
    picture: tuple[tuple[int, int], bytes] | None
    stacks_from: int  # size in bytes of the crash log before it was started


def crash_log_size(data: Path) -> int:
    """Size of the crash log in bytes."""
    try:
        return (data / CRASH_FILE).stat().st_size
    except OSError:
        return 0


def keep_report(data: Path, ending: RunEnd, evidence: Evidence, now: datetime) -> None:
    """Write a report, delete the oldest ones, and add a line to the restarts. Raises OSError."""
    folder = data / FOLDER
    name = f"crash-{now:%Y%m%d-%H%M%S}-{now.microsecond // 1000:03}"
    report = f"{FOLDER}/{name}.txt"
    when = now.astimezone().isoformat(timespec="seconds")
    append_restart(data, Restart(when, ending.reason, ending.detail, round(ending.seconds, 1), report))
    text = "\n".join(_lines(data, ending, evidence, when))
    write_atomic(folder / f"{name}.txt", text.encode(errors="backslashreplace"))
    if evidence.picture:
        from pigaming_app.ui.png import png_of_rgb  # late: the supervisor needs no pygame while all is well

        write_atomic(folder / f"{name}.png", png_of_rgb(*evidence.picture))
    for path in sorted(folder.glob("crash-*.txt"))[:-KEPT]:
        for old in (path, path.with_suffix(".png")):
            with contextlib.suppress(OSError):
                old.unlink(missing_ok=True)


def _lines(data: Path, ending: RunEnd, evidence: Evidence, when: str) -> Iterator[str]:
    yield f"PiGaming {__version__}, {when}"
    yield f"{ending.reason}: {ending.detail}, after {ending.seconds:.1f} s and {ending.beats} frames"
    yield f"Python {platform.python_version()}, {platform.platform()}"
    yield ", ".join(f"{name} {_version(name)}" for name in PACKAGES)
    yield "\n== standard error"
    yield "".join(evidence.errors)
    yield "== stacks"
    yield _end_of(data / CRASH_FILE, evidence.stacks_from)
    yield "== log"
    yield _end_of(data / FILE)


def _version(package: str) -> str:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return "none"


def _end_of(path: Path, begin: int = 0) -> str:
    """The end of a file: at most LOG_BYTES, from `begin` on. Empty if it cannot be read."""
    try:
        with path.open("rb") as file:
            size = file.seek(0, 2)
            file.seek(max(begin, size - LOG_BYTES) if begin <= size else 0)
            return file.read(LOG_BYTES).decode(errors="replace")
    except OSError:
        return ""
