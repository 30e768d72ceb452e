"""A small disk for the files of the arcades, which can be full: a file system in memory, in a mount namespace.

`python -m tests.bench.open_day --week` runs in one of its own (`unshare`), so that the mount ends with it.
"""

import os
import shutil
import subprocess
from contextlib import suppress
from pathlib import Path
from types import TracebackType

MEGABYTES = 400
BLOCK = bytes(65536)


class Disk:
    """A folder that is a disk of MEGABYTES if `needed`. `troubles`: why it is not, if so."""

    def __init__(self, folder: Path, needed: bool) -> None:
        self.folder, self.troubles, self.full = folder, list[str](), False
        self._needed, self._mounted = needed, False

    def __enter__(self) -> "Disk":
        self.folder.mkdir(parents=True)
        if self._needed:
            command = ["mount", "-t", "tmpfs", "-o", f"size={MEGABYTES}m", "tmpfs", str(self.folder)]
            done = subprocess.run(command, check=False, stderr=subprocess.PIPE, text=True)
            self._mounted = done.returncode == 0
            self.troubles = [] if self._mounted else [f"no disk could be filled: {done.stderr.strip()}"]
        return self

    def fill(self, full: bool) -> None:
        """Use up all that is left of the disk, or give it back."""
        if not self._mounted or full == self.full:
            return
        self.full, file = full, self.folder / "full"
        if not full:
            file.unlink()
            return
        handle = os.open(file, os.O_WRONLY | os.O_CREAT)
        with suppress(OSError):  # it is full
            while os.write(handle, BLOCK) == len(BLOCK):
                pass
            while os.write(handle, b"0"):
                pass
        os.close(handle)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Keep the files where the disk was."""
        if self._mounted:
            self.fill(False)
            copy = self.folder.with_name("copy")
            shutil.copytree(self.folder, copy, symlinks=True)
            subprocess.run(["umount", str(self.folder)], check=True)
            self.folder.rmdir()
            copy.rename(self.folder)
