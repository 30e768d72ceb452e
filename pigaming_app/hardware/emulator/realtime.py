"""The emulated arena in real time: a thread lets its time pass, and a pseudo-terminal is its serial port.

The port can be opened by name like that of a real radio, by this program or by another. When whoever drives is killed,
the robots here stop by themselves.
"""

import os
import time
from contextlib import suppress
from select import select
from threading import Event, Thread
from typing import Self

from pigaming_app.hardware.emulator.arena import EmulatedArena

LOOK_EVERY = 0.002  # s
CHUNK = 4096  # bytes
LATE = 0.5  # s: time that a busy machine lost beyond this is skipped


class PseudoTerminal:
    """A pseudo-terminal in raw mode. `name` is what to open; only on systems that have such things (OSError)."""

    def __init__(self) -> None:
        try:
            import tty
        except ImportError as error:  # Windows
            raise OSError("this system has no pseudo-terminals") from error
        self._master, self._slave = os.openpty()  # the slave stays open: else a master hears EIO between two users
        tty.setraw(self._slave)
        os.set_blocking(self._master, False)
        self.name = os.ttyname(self._slave)

    def read(self, patience: float) -> bytes:
        """What was written at the other end; waits for it at most so many seconds."""
        if not select([self._master], [], [], patience)[0]:
            return b""
        return os.read(self._master, CHUNK)

    def write(self, data: bytes) -> None:
        """Send to the other end; what finds no room there because nobody reads is lost, as on a real line."""
        with suppress(BlockingIOError):
            os.write(self._master, data)

    def close(self) -> None:
        """Hang up."""
        os.close(self._master)
        os.close(self._slave)


class RealtimeArena:
    """Lets an arena's time pass as fast as real time, whose clock is `time.monotonic`, until close().

    With a terminal, that is the radio's port; without one, use `arena.radio` in this program.
    """

    def __init__(self, arena: EmulatedArena, terminal: PseudoTerminal | None = None) -> None:
        self.arena, self.terminal = arena, terminal
        self._ended = Event()
        self._thread = Thread(target=self._run, name="emulated arena", daemon=True)

    def start(self) -> Self:
        """Begin; the arena should have been made with `begin=time.monotonic()`."""
        self._thread.start()
        return self

    def close(self) -> None:
        """Stop time. May be called again."""
        if not self._ended.is_set():
            self._ended.set()
            self._thread.join(timeout=1.0)
            if self.terminal is not None:
                self.terminal.close()

    def __enter__(self) -> Self:
        return self.start()

    def __exit__(self, *_: object) -> None:
        self.close()

    def _run(self) -> None:
        arena = self.arena
        while not self._ended.is_set():
            self._carry()
            behind = time.monotonic() - arena.clock()
            if behind > LATE:
                arena.skip(behind)
            elif behind > 0.0:
                arena.advance(behind)

    def _carry(self) -> None:
        """Bytes between the terminal and the radio, or a short wait."""
        if self.terminal is None:
            self._ended.wait(LOOK_EVERY)
            return
        heard = self.terminal.read(LOOK_EVERY)
        with suppress(OSError):  # an unplugged radio hears and says nothing
            if heard:
                self.arena.radio.write(heard)
            said = self.arena.radio.read(CHUNK)
            if said:
                self.terminal.write(said)
