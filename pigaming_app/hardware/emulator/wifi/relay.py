"""Micro:bits that run their own programs: the relay on USB, robots, and the radio between them.

Each board is a datagram socket on loopback: its messages begin with `radio:` or `usb:`.
"""

import socket
from collections.abc import Callable
from contextlib import suppress
from random import Random
from typing import Self

from pigaming_app.hardware.emulator.robots import STEP
from pigaming_app.hardware.emulator.wifi.air import LOOPBACK
from pigaming_app.hardware.emulator.wifi.boards import Boards, MicrobitConfig

LARGEST = 512  # bytes of a message


class MicrobitAir:
    """Relay (board 0), robots 1 to `robots`, the radio between them, and the relay's USB line, a SerialPort.

    `dead`: nothing gets through the air; `loss`: share of the messages that each board misses; `mute`: boards whose
    messages get lost; `aired`: messages of the relay. Time passes in `advance`. Raises NoMicroPython.
    """

    def __init__(
        self, robots: int, arena: int, seed: int = 1, kind: Callable[[int, int], MicrobitConfig] = MicrobitConfig
    ) -> None:
        self.boards = Boards([MicrobitConfig(0, arena), *(kind(i + 1, arena) for i in range(robots))], paced=True)
        self.sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in self.boards.ports]
        for end in self.sockets:
            end.bind((LOOPBACK, 0))
            end.setblocking(False)
        self.now, self.dead, self.loss, self.mute = 0.0, False, 0.0, set[int]()
        self.aired: list[bytes] = []
        self._sent, self._reports = [0] * len(self.sockets), b""
        self._random = Random(f"micro:bits {seed}")

    def clock(self) -> float:
        """Simulated time, s."""
        return self.now

    def advance(self, seconds: float) -> None:
        """Let time pass for the boards, in steps of STEP."""
        for _ in range(round(seconds / STEP)):
            self.now += STEP
            self.boards.advance(self.now, self._sent)
            for board, end in enumerate(self.sockets):
                with suppress(BlockingIOError):
                    while True:
                        self._carry(board, end.recv(LARGEST))

    def put(self, board: int, data: bytes, line: bytes = b"radio") -> None:
        """Send a message to a board, by radio or USB."""
        self.sockets[board].sendto(line + b":" + data, (LOOPBACK, self.boards.ports[board]))
        self._sent[board] += 1

    def end(self) -> None:
        """End the boards. Idempotent."""
        self.boards.close()
        for end in self.sockets:
            end.close()

    def _carry(self, board: int, message: bytes) -> None:
        line, data = message.split(b":", 1)
        if line == b"usb":
            self._reports += data
            return
        if board == 0:
            self.aired.append(data)
        for other in range(len(self.sockets)):
            if other != board and not self.dead and board not in self.mute and self._random.random() >= self.loss:
                self.put(other, data)

    # ---- SerialPort

    def open(self) -> Self:
        """The relay's USB line."""
        return self

    @property
    def in_waiting(self) -> int:
        """Bytes that the relay has sent."""
        return len(self._reports)

    def read(self, size: int = 1) -> bytes:
        """Read at most `size` bytes."""
        data, self._reports = self._reports[:size], self._reports[size:]
        return data

    def write(self, data: bytes) -> int:
        """Write bytes to the relay."""
        self.put(0, data, b"usb")
        return len(data)

    def close(self) -> None:
        """No effect: the relay stays."""
