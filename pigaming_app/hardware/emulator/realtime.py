"""The emulated arena in real time or at the pace of its user: a thread advances it; a pseudo-terminal is its port.

The port can be opened by name like that of a real radio, from any process. If the driving process is killed, the robots
stop by their deadman.
"""

import os
import time
from contextlib import suppress
from math import inf
from select import select
from threading import Event, Lock, Thread
from typing import Self

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.robots import STEP

LOOK_EVERY = 0.002  # s
CHUNK = 4096  # bytes
LATE = 0.5  # s; a longer lag is skipped
OVERDUE = 0.02  # s for which a picture may wait to be read
MAX_LAG = 0.1  # s that a paced arena catches up after a delay


class PseudoTerminal:
    """A pseudo-terminal in raw mode; `name` is the path to open. Raises OSError on systems without them."""

    def __init__(self) -> None:
        try:
            import tty
        except ImportError as error:  # Windows
            raise OSError("this system has no pseudo-terminals") from error
        self._master, self._slave = os.openpty()  # the slave stays open: else reads fail with EIO between two users
        tty.setraw(self._slave)
        os.set_blocking(self._master, False)
        self.name = os.ttyname(self._slave)

    def read(self, timeout: float) -> bytes:
        """Read bytes from the other end, or b"" after `timeout` s."""
        if not select([self._master], [], [], timeout)[0]:
            return b""
        return os.read(self._master, CHUNK)

    def write(self, data: bytes) -> None:
        """Write to the other end; bytes beyond its buffer are lost, as on a real line without a reader."""
        with suppress(BlockingIOError):
            os.write(self._master, data)

    def close(self) -> None:
        os.close(self._master)
        os.close(self._slave)


class ArenaThread:
    """A thread that advances an arena until `close`."""

    def __init__(self, arena: EmulatedArena) -> None:
        self.arena = arena
        self._ended = Event()
        self._thread = Thread(target=self._run, name="emulated arena", daemon=True)

    def start(self) -> Self:
        """Start the thread; create an arena for real time with `begin=time.monotonic()`."""
        self._thread.start()
        return self

    def close(self) -> None:
        """Stop time. Idempotent."""
        self._ended.set()
        self._thread.join(timeout=1.0)

    def __enter__(self) -> Self:
        return self.start()

    def __exit__(self, *_: object) -> None:
        self.close()

    def _run(self) -> None:
        raise NotImplementedError


class RealtimeArena(ArenaThread):
    """Advances an arena in real time (`time.monotonic`).

    With a terminal, that is the radio's port; without one, use `arena.radio` in this process.
    """

    def __init__(self, arena: EmulatedArena, terminal: PseudoTerminal | None = None) -> None:
        super().__init__(arena)
        self.terminal = terminal
        self._plug = Lock()  # held during a transfer

    def close(self) -> None:
        super().close()
        self.plug(None)

    def plug(self, terminal: PseudoTerminal | None) -> None:
        """Replace the terminal; the old one hangs up."""
        with self._plug:
            old, self.terminal = self.terminal, terminal
            if old is not None:
                old.close()

    def _run(self) -> None:
        arena = self.arena
        while not self._ended.is_set():
            self._transfer()
            behind = time.monotonic() - arena.clock()
            if behind > LATE:
                arena.skip(behind)
            elif behind > 0.0:
                arena.advance(behind)

    def _transfer(self) -> None:
        """Transfer bytes between terminal and radio, or wait briefly."""
        if self.terminal is None:
            self._ended.wait(LOOK_EVERY)
            return
        with self._plug:
            if self.terminal is None:
                return
            outgoing = self.terminal.read(LOOK_EVERY)
            with suppress(OSError):  # an unplugged radio neither receives nor sends
                if outgoing:
                    self.arena.radio.write(outgoing)
                incoming = self.arena.radio.read(CHUNK)
                if incoming:
                    self.terminal.write(incoming)


class PacedArena(ArenaThread):
    """Advances an arena up to `limit` (s of its clock), in real time, but no faster than its pictures are read.

    On a busy computer it slows down instead of losing pictures or delaying commands. It waits while `watched`.
    """

    def __init__(self, arena: EmulatedArena) -> None:
        super().__init__(arena)
        self.limit = inf
        self.watched = False

    def _run(self) -> None:
        last, owed = time.monotonic(), 0.0
        while not self._ended.wait(LOOK_EVERY):
            now = time.monotonic()
            owed, last = min(MAX_LAG, owed + now - last), now
            if self.watched and self.arena.camera.overdue > OVERDUE:
                owed = 0.0
            steps = int(min(owed, self.limit - self.arena.clock()) / STEP)
            for _ in range(steps):
                self.arena.advance(STEP)
                owed -= STEP
            if self.arena.clock() >= self.limit - STEP:
                owed = 0.0
