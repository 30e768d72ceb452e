"""A board on USB: a pseudo-terminal that leads to MicroPython's own interpreter. The cable can be pulled."""

import json
import os
import select
import subprocess
import threading
from contextlib import suppress
from itertools import groupby
from typing import Self

from pigaming_app.hardware.emulator.wifi.boards import HERE, WIRING, Shares, interpreter

PROMPT = b">>> "
CHUNK = 64  # bytes of a USB packet
LOOK = 0.02  # s between two looks whether the cable is still there


class UsbBoard:
    """A context manager. `port`: its present device; `sent`: bytes to the board since it was plugged in.

    `board`: one of boards.WIRING, whose hardware is then emulated, too: `pins` holds the values at its pins, one set
    after another, `motors` the voltages of its wheels. Its files stay, as on a board with a battery. Raises
    NoMicroPython.
    """

    def __init__(self, board: str = "") -> None:
        self._board = board
        self.pins: list[dict[str, int]] = []

    def __enter__(self) -> Self:
        command = ["node", str(HERE / "usb.mjs"), str(interpreter()), self._board]
        pipe = subprocess.PIPE
        self._node = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, bufsize=0)
        self._master, self.sent, self.port = -1, 0, ""
        self._lock = threading.Lock()
        self._reader: threading.Thread | None = None
        heard = b""
        assert self._node.stdout
        while PROMPT not in heard:
            heard += self._node.stdout.read(CHUNK) or b""
        threading.Thread(target=self._down, name="usb down", daemon=True).start()
        self._watcher = threading.Thread(target=self._watch, name="usb pins", daemon=True)
        self._watcher.start()
        self.plug()
        return self

    def __exit__(self, *_: object) -> None:
        self.pull()
        self._node.kill()
        self._node.wait()
        self._watcher.join()
        for pipe in (self._node.stdin, self._node.stdout, self._node.stderr):
            assert pipe
            pipe.close()

    @property
    def motors(self) -> list[Shares]:
        """The voltages of left and right wheel, as shares of the battery's, each change once."""
        left, right = WIRING[self._board]
        return [shares for shares, _ in groupby((left.share(pins), right.share(pins)) for pins in self.pins)]

    def plug(self, cut_after: int | None = None) -> None:
        """Plug the cable in; a new device appears. `cut_after`: bytes after which it is pulled again."""
        import pty  # not on Windows
        import tty

        self.pull()
        self.sent = 0
        self._master, self._slave = pty.openpty()
        tty.setraw(self._slave)
        self.port = os.ttyname(self._slave)
        self._reader = threading.Thread(target=self._up, args=(self._master, cut_after), name="usb up", daemon=True)
        self._reader.start()

    def pull(self) -> None:
        """Pull the cable: the device is gone."""
        with self._lock:
            master, self._master = self._master, -1
        if self._reader and self._reader is not threading.current_thread():
            self._reader.join()  # before its file number can be that of another file
        if master >= 0:
            os.close(self._slave)
            os.close(master)

    def _watch(self) -> None:
        """Note what happens at the pins."""
        assert self._node.stderr
        for line in self._node.stderr:
            self.pins.append(json.loads(line))

    def _up(self, master: int, cut_after: int | None) -> None:
        """From the computer to the board."""
        assert self._node.stdin
        with suppress(OSError, ValueError):
            while self._master == master:
                if not select.select([master], [], [], LOOK)[0]:
                    continue
                data = os.read(master, CHUNK)
                self.sent += len(data)
                if cut_after is not None and self.sent >= cut_after:
                    self.pull()
                    return
                self._node.stdin.write(data)

    def _down(self) -> None:
        """From the board to the computer, or to nobody."""
        assert self._node.stdout
        with suppress(OSError, ValueError):
            while data := self._node.stdout.read(CHUNK):
                with self._lock, suppress(OSError):
                    os.write(self._master, data)
