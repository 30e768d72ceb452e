"""A board with MicroPython at a serial port, to which `mpremote` talks: files are written, checked and put in place.

A cable that is pulled at any moment does no harm: a file gets its name only when it is complete, MAIN last, and the
next attempt writes what is missing.
"""

import errno
import hashlib
import json
import os
import struct
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, redirect_stdout
from io import StringIO
from typing import Any

from pigaming_app.hardware.commissioning.boards import microbit
from pigaming_app.hardware.commissioning.boards.kind import MAIN, BoardAnswer, SetupFailed
from pigaming_app.hardware.signals import SERIAL_FAILURES
from pigaming_app.storage.messages import OperatorMessage

Tell = Callable[[str, bool], None]
RATE, SILENT = 115_200, 3.0  # bit/s; s
ENTERS, LONGEST = 6.0, 60.0  # s: for the prompt, and for any other step, at a device that sends without end
POINTERS = ("kept", "trial")  # files that name the program that came over the air
PART = ".part"  # suffix of files that are not complete
ASK = """
import sys
u = sys.implementation
try:
    import network
    w = hasattr(network, 'WLAN')
except ImportError:
    w = False
m = getattr(u, '_machine', '')
print('{"name": "%s", "version": [%d, %d], "platform": "%s", "wifi": %d, "machine": "%s"}' % (
    u[0], u[1][0], u[1][1], sys.platform, w, m.replace('"', '')))
"""
HASH = """
import os
try:
    import hashlib, binascii
except ImportError:
    hashlib = None
def h(n):
    try:
        with open(n, 'rb') as f:
            if not hashlib:
                return '?'
            s = hashlib.sha256()
            while True:
                d = f.read(256)
                if not d:
                    return binascii.hexlify(s.digest()).decode()
                s.update(d)
    except OSError:
        return ''
"""
PUT = """
def p(a, b):
    try:
        os.remove(b)
    except OSError:
        pass
    os.rename(a, b)
"""


def vendors() -> dict[str, int | None]:
    """The serial ports of this computer, each with the vendor of its USB chip."""
    from serial.tools.list_ports import comports

    return {port.device: port.vid for port in comports()}


class BoardOnUsb:
    """A board at a serial port; a context manager. Raises SetupFailed, also for a cable that is pulled."""

    def __init__(self, port: str) -> None:
        self.port = port
        self._transport: Any = None
        self._deadline = 0.0  # of the present step, as of time.monotonic

    def __enter__(self) -> "BoardOnUsb":
        from mpremote.transport_serial import SerialTransport

        if not os.access(self.port, os.R_OK | os.W_OK) and os.path.exists(self.port):
            raise SetupFailed(OperatorMessage("board_denied", port=self.port))
        is_microbit = vendors().get(self.port) == microbit.VENDOR
        with self._plugged():
            self._transport = SerialTransport(self.port, RATE, timeout=SILENT)
        self._limit()
        try:
            with self._plugged(seconds=ENTERS):
                if is_microbit:
                    microbit.end_relay(self._transport.serial, RATE)
                self._transport.enter_raw_repl(soft_reset=False, timeout_overall=SILENT)
        except SetupFailed as failed:
            self.__exit__()
            if is_microbit and failed.message.key == "board_silent":
                raise SetupFailed(OperatorMessage("board_microbit", port=self.port)) from None
            raise
        return self

    def __exit__(self, *_: object) -> None:
        if self._transport:
            with self._plugged(quiet=True):
                self._transport.exit_raw_repl()
            with self._plugged(quiet=True):
                self._transport.close()

    def answer(self) -> BoardAnswer:
        """What it tells of itself. Raises SetupFailed if it is something else."""
        try:
            told = json.loads(self.ask(ASK))
        except ValueError:  # it printed something else
            raise SetupFailed(OperatorMessage("board_silent", port=self.port)) from None
        version = tuple(told["version"])
        return BoardAnswer(told["name"], version, told["platform"], bool(told["wifi"]), told["machine"])

    def has(self, name: str) -> bool:
        """True if a file is on the board."""
        return self.ask(f"import os\nprint({name!r} in os.listdir())") == "True"

    def write(self, files: Mapping[str, bytes], tell: Tell = lambda name, new: None) -> None:
        """Write the files that differ; `tell` gets the name of each, and whether it was written."""
        renames = self.ask(HASH + PUT + "print(hasattr(os, 'rename'))") == "True"
        differ = [name for name, data in files.items() if self._hash(name) != _hash(data)]
        if differ and MAIN not in differ:  # a robot never starts with files of two versions
            differ.append(MAIN)
        for pointer in POINTERS:
            self.ask(f"try:\n os.remove({pointer!r})\nexcept OSError:\n pass")
        if MAIN in differ:
            self.ask(f"try:\n os.remove({MAIN!r})\nexcept OSError:\n pass")
        for name, data in files.items():
            if name in differ:
                part = name + PART if renames else name
                with self._plugged():
                    self._transport.fs_writefile(part, data)
                if self._hash(part) != _hash(data):
                    raise SetupFailed(OperatorMessage("board_damaged", file=name))
                if renames:
                    self.ask(f"p({part!r}, {name!r})")
            tell(name, name in differ)

    def begin_anew(self) -> None:
        """Restart the interpreter without the robot's program: the timers of that end."""
        with self._plugged():
            self._transport.enter_raw_repl(soft_reset=True, timeout_overall=SILENT)

    def restart(self) -> None:
        """Start the robot's program."""
        with self._plugged():
            self._transport.exec_raw_no_follow("import machine\nmachine.reset()")  # also the Wi-Fi begins anew

    def ask(self, program: str) -> str:
        """What a program on the board prints. Raises SetupFailed."""
        with self._plugged():
            answer: bytes = self._transport.exec(program)
        return answer.decode().strip()

    def _hash(self, name: str) -> str:
        """The hash of a file on the board, empty without one; a micro:bit, which makes none, sends the file."""
        if (made := self.ask(f"print(h({name!r}))")) != "?":
            return made
        with self._plugged():
            return _hash(self._transport.fs_readfile(name))

    def _limit(self) -> None:
        """Let reading fail after the deadline: `mpremote` ends no step while bytes come."""
        from mpremote.transport import TransportError

        read = self._transport.serial.read

        def limited(size: int = 1) -> bytes:
            if time.monotonic() > self._deadline:
                raise TransportError("no end")
            return bytes(read(size))

        self._transport.serial.read = limited

    @contextmanager
    def _plugged(self, quiet: bool = False, seconds: float = LONGEST) -> Iterator[None]:
        from mpremote.transport import TransportError, TransportExecError

        self._deadline = time.monotonic() + seconds
        try:
            with redirect_stdout(StringIO()):  # mpremote prints what it did not expect
                yield
        except TransportExecError as error:  # of the program on the board
            if not quiet:
                detail = (error.error_output or str(error)).strip().splitlines()[-1][:80]
                raise SetupFailed(OperatorMessage("board_failed", detail=detail)) from None
        except (TransportError, struct.error) as error:  # the latter: silence amid an answer
            if not quiet:
                key = "board_gone" if "access" in str(error) else "board_silent"
                raise SetupFailed(OperatorMessage(key, port=self.port)) from None
        except SERIAL_FAILURES as error:
            if not quiet and getattr(error, "errno", 0) in (errno.ENOSPC, errno.EROFS):  # of the board's disk
                raise SetupFailed(OperatorMessage("board_failed", detail=str(error)[:80])) from None
            if not quiet:
                raise SetupFailed(OperatorMessage("board_gone", port=self.port)) from None


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
