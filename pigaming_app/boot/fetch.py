"""Fetches an extra into the environment of a running arcade, in a process of its own. Standard library only.

python -m pigaming_app.boot.fetch EXTRA    prints the share that is fetched, from 0 to 1, and last DONE or a reason
"""

import contextlib
import os
import re
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Event, Thread

from pigaming_app.boot import environment
from pigaming_app.boot.interpreter import (
    ARCADE,
    StartError,
    environment_folders,
    installed_groups,
    packages,
    site_packages,
)

COMMAND = (sys.executable, "-m", "pigaming_app.boot.fetch", "train")
DONE, RESTART = "done", "restart"  # RESTART: packages that the arcade has loaded were replaced
OFFLINE, FULL, FOREIGN, FAILED = "offline", "full", "foreign", "failed"
UNITS = {"B": 1, "kB": 1e3, "MB": 1e6, "GB": 1e9}
EVERY = 0.2  # s between two lines
EXPECTED = 60e6  # bytes of the extra "train": pip announces a large file only once it has fetched the small one before
LAST = 0.95  # share at which everything is fetched, and still to be unpacked


class FetchProgress:
    """Prints the share that is fetched: bytes in the folder of pip's temporary files, of all expected."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.announced, self.most, self._over = folder, 0.0, 0.0, Event()
        self._thread = Thread(target=self._print, daemon=True)

    def __enter__(self) -> "FetchProgress":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._over.set()
        self._thread.join()

    def announce(self, name: str, version: str, size: str) -> None:
        """Note the size of another file, such as 3.8 MB."""
        if match := re.match(r"([\d.]+)\s*(\w+)", size):
            self.announced += float(match[1]) * UNITS.get(match[2], 0.0)

    def _print(self) -> None:
        while not self._over.wait(EVERY):
            there = sum(_size(Path(place, name)) for place, _, names in os.walk(self.folder) for name in names)
            share = min(1.0, there / max(self.announced, EXPECTED))
            self.most = max(self.most, LAST * share)
            say(f"{self.most:.3f}")


def fetch(extra: str) -> str:
    """Install an extra, and record it so that the next start keeps it; returns DONE or the reason why not."""
    own = Path(sys.prefix).resolve()
    place = next((place for place in environment_folders() if place.resolve() == own), None)
    if place is None:
        return FOREIGN
    try:
        with environment.lock_of(place) as lock:
            environment.wait_for(lock)
            return _install(place, extra)
    except StartError as trouble:
        print(trouble, file=sys.stderr)
        return _reason(str(trouble))
    except OSError as error:
        print(error, file=sys.stderr)
        return FAILED


def _install(place: Path, extra: str) -> str:
    before, complete = packages([site_packages(place)]), installed_groups(place) | {ARCADE}
    with TemporaryDirectory(dir=place) as folder, FetchProgress(Path(folder)) as progress:
        os.environ.update(dict.fromkeys(("TMPDIR", "TEMP", "TMP"), folder))
        try:
            environment.install(place, complete | {extra}, progress.announce)
        except StartError:
            environment.install(place, complete)
            raise
    after = packages([site_packages(place)])
    return RESTART if any(after.get(name) != version for name, version in before.items()) else DONE


def _reason(sentence: str) -> str:
    return OFFLINE if "internet" in sentence else FULL if "disk is full" in sentence else FAILED


def _size(file: Path) -> int:
    try:
        return file.stat().st_size
    except OSError:  # pip has moved it
        return 0


def say(line: str) -> None:
    """Print a line for the arcade, which may have ended."""
    with contextlib.suppress(OSError):
        print(line, flush=True)


if __name__ == "__main__":
    say(fetch(sys.argv[1]))
