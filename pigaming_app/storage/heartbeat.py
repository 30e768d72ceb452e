"""Heartbeat of a process: a counter and a small picture in a file that two processes map into memory.

Beating costs no system call, never blocks, and needs no reader. The picture may be torn if its writer is killed.
"""

import mmap
import struct
from pathlib import Path

PICTURE = (640, 360)  # px, the largest picture
_HEADER = struct.Struct("<QHH")  # beats, width and height of the picture
_SIZE = _HEADER.size + 3 * PICTURE[0] * PICTURE[1]


class Heartbeat:
    """The beats of the process that writes them, in an existing file. Raises OSError."""

    def __init__(self, path: Path) -> None:
        with path.open("r+b") as file:
            if file.seek(0, 2) < _SIZE:
                file.truncate(_SIZE)
            self._memory = mmap.mmap(file.fileno(), _SIZE)

    @property
    def beats(self) -> int:
        """The number of beats so far."""
        return int(_HEADER.unpack_from(self._memory)[0])

    @property
    def picture(self) -> tuple[tuple[int, int], bytes] | None:
        """Size in px and RGB bytes, row by row, of the latest picture; None before the first."""
        _, w, h = _HEADER.unpack_from(self._memory)
        if not 0 < w * h <= PICTURE[0] * PICTURE[1]:
            return None
        return (w, h), self._memory[_HEADER.size : _HEADER.size + 3 * w * h]

    def beat(self) -> None:
        beats, *size = _HEADER.unpack_from(self._memory)
        _HEADER.pack_into(self._memory, 0, beats + 1, *size)

    def show(self, size: tuple[int, int], rgb: bytes) -> None:
        """Replace the picture: its size in px, at most that of PICTURE, and 3 bytes a pixel, row by row."""
        self._memory[_HEADER.size : _HEADER.size + len(rgb)] = rgb
        _HEADER.pack_into(self._memory, 0, self.beats, *size)

    def close(self) -> None:
        self._memory.close()
