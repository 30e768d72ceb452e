"""A board with MicroPython on USB becomes a robot: its files are written, checked and put in place one by one.

A cable that is pulled at any moment does no harm: a file gets its name only when it is complete, `main.py` last, and
the next attempt writes what is missing. `mpremote` talks to the board.
"""

import errno
import hashlib
import json
import os
import re
import struct
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, redirect_stdout
from io import StringIO
from time import sleep
from typing import Any, NamedTuple

from pigaming_app.hardware.robot_kinds import PROGRAM, robot_config
from pigaming_app.hardware.signals import SERIAL_FAILURES
from pigaming_app.storage.messages import OperatorError, OperatorMessage

Tell = Callable[[str, bool], None]


class BoardKind(NamedTuple):
    """A kind of board: the names of its board file and of its radio's program."""

    file: str
    radio: str


WIFI, XBEE = "wifi", "serial_radio"
KINDS = {
    "pico_w": BoardKind("board_pico_w", WIFI),
    "esp32": BoardKind("board_esp32", WIFI),
    "pololu_2040": BoardKind("board_pololu_2040", XBEE),
}
BOARDS = {"rp2": "pico_w", "esp32": "esp32"}  # kind by `sys.platform`, of boards with Wi-Fi
MAKER = "pololu"  # in the name of the machine, by Pololu's own MicroPython
OTHERS = re.compile(r"ESP32-?[SCHP]\d")  # chips of other pins
OLDEST = (1, 22)  # version of MicroPython
USB = {  # by vendor; radios have FTDI's
    0x2E8A: "Raspberry Pi",
    0x303A: "Espressif",
    0x1FFB: "Pololu",
    0x10C4: "CP210x",
    0x1A86: "CH340",
}
RATE, SILENT = 115_200, 3.0  # bit/s; s
AGAIN = 3.0  # s after which a board is tried once more: a running program's watchdog may have restarted it
AIR_FILES = ("robot.py", "motors.py", "wifi.py", "update.py")  # those that updates over the air replace, in this order
POINTERS = ("kept", "trial")  # files that name the program that came over the air
PINS = "board.py"  # the file with pins and divider, which its owner may have changed
MAIN, PART = "main.py", ".part"  # the file that starts the robot; suffix of files that are not complete
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
import hashlib, binascii
def h(n):
    s = hashlib.sha256()
    try:
        with open(n, 'rb') as f:
            while True:
                d = f.read(256)
                if not d:
                    return binascii.hexlify(s.digest()).decode()
                s.update(d)
    except OSError:
        return ''
"""
PUT = """
import os
def p(a, b):
    try:
        os.remove(b)
    except OSError:
        pass
    os.rename(a, b)
"""


class SetupFailed(OperatorError):
    """A board cannot be set up; the message says why."""


def only_port() -> str:
    """The serial port of the only board on USB, known by the vendor of its chip. Raises SetupFailed."""
    from serial.tools.list_ports import comports

    ports = [port.device for port in comports() if port.vid in USB]
    if len(ports) != 1:
        there = ", ".join(ports)
        raise SetupFailed(OperatorMessage("board_several" if ports else "board_none", ports=there))
    return str(ports[0])


def set_up(port: str, board: str, files: Callable[[str], Mapping[str, bytes]], tell: "Tell") -> str:
    """Make the board at a port a robot, and start it; its kind of board. Raises SetupFailed.

    `board`: one of KINDS, empty: found out, and a board file that is there is kept; `files`: those for a kind;
    `tell`: see `BoardOnUsb.write`.
    """
    try:
        return _set_up(port, board, files, tell)
    except SetupFailed as failed:
        if failed.message.key not in ("board_gone", "board_silent"):
            raise
    sleep(AGAIN)
    return _set_up(port, board, files, tell)


def _set_up(port: str, board: str, files: Callable[[str], Mapping[str, bytes]], tell: "Tell") -> str:
    with BoardOnUsb(port) as connected:
        kind = connected.kind()
        if not (board or kind):
            raise SetupFailed(OperatorMessage("board_unknown", port=port, kinds=", ".join(KINDS)))
        wanted = dict(files(board or kind))
        if not board and connected.has(PINS):
            del wanted[PINS]
        connected.write(wanted, tell)
        connected.restart()
    return board or kind


def files_of(kind: str, robot: int, arena: int, key: bytes, network: str, password: str) -> dict[str, bytes]:
    """The files of a robot (1 to 4) by their names on the board, in the order in which they are written.

    `kind`: one of KINDS. Raises SetupFailed if it needs a network and has none.
    """
    board = KINDS[kind]
    if board.radio == WIFI and not network:
        raise SetupFailed(OperatorMessage("board_no_network"))
    config = robot_config(robot, arena, key).replace(f'"{WIFI}"', f'"{board.radio}"')
    config = config.replace('"name of the network"', json.dumps(network, ensure_ascii=False))
    config = config.replace('"its password"', json.dumps(password, ensure_ascii=False))
    names = AIR_FILES if board.radio == WIFI else ("motors.py", f"{board.radio}.py", "robot.py")
    files = {name: (PROGRAM / name).read_bytes() for name in names}
    files |= {"board.py": (PROGRAM / f"{board.file}.py").read_bytes(), "config.py": config.encode()}
    return {**files, MAIN: (PROGRAM / "start.py").read_bytes()}


class BoardOnUsb:
    """A board at a serial port; a context manager. Raises SetupFailed, also for a cable that is pulled."""

    def __init__(self, port: str) -> None:
        self.port = port
        self._transport: Any = None

    def __enter__(self) -> "BoardOnUsb":
        from mpremote.transport_serial import SerialTransport

        if not os.access(self.port, os.R_OK | os.W_OK) and os.path.exists(self.port):
            raise SetupFailed(OperatorMessage("board_denied", port=self.port))
        with self._plugged():
            self._transport = SerialTransport(self.port, RATE, timeout=SILENT)
        try:
            with self._plugged():
                self._transport.enter_raw_repl(soft_reset=False)
        except SetupFailed:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        if self._transport:
            with self._plugged(quiet=True):
                self._transport.exit_raw_repl()
            with self._plugged(quiet=True):
                self._transport.close()

    def kind(self) -> str:
        """One of KINDS, or empty for an unknown board. Raises SetupFailed for an old MicroPython."""
        try:
            told = json.loads(self._ask(ASK))
        except ValueError:  # it printed something else
            raise SetupFailed(OperatorMessage("board_silent", port=self.port)) from None
        if told["name"] != "micropython" or tuple(told["version"]) < OLDEST:
            raise SetupFailed(OperatorMessage("board_old", version=".".join(map(str, told["version"]))))
        if told["platform"] == "rp2" and MAKER in told["machine"].lower():
            return "pololu_2040"
        return BOARDS.get(told["platform"], "") if told["wifi"] and not OTHERS.search(told["machine"]) else ""

    def has(self, name: str) -> bool:
        """True if a file is on the board."""
        return self._ask(f"import os\nprint({name!r} in os.listdir())") == "True"

    def write(self, files: Mapping[str, bytes], tell: Tell = lambda name, new: None) -> None:
        """Write the files that differ; `tell` gets the name of each, and whether it was written."""
        self._ask(HASH + PUT)
        differ = [name for name, data in files.items() if self._ask(f"print(h({name!r}))") != _hash(data)]
        if differ and MAIN not in differ:  # a robot never starts with files of two versions
            differ.append(MAIN)
        for pointer in POINTERS:
            self._ask(f"try:\n os.remove({pointer!r})\nexcept OSError:\n pass")
        if MAIN in differ:
            self._ask(f"try:\n os.remove({MAIN!r})\nexcept OSError:\n pass")
        for name, data in files.items():
            if name in differ:
                with self._plugged():
                    self._transport.fs_writefile(name + PART, data)
                if self._ask(f"print(h({name + PART!r}))") != _hash(data):
                    raise SetupFailed(OperatorMessage("board_damaged", file=name))
                self._ask(f"p({name + PART!r}, {name!r})")
            tell(name, name in differ)

    def restart(self) -> None:
        """Start the robot's program."""
        with self._plugged():
            self._transport.exec_raw_no_follow("import machine\nmachine.reset()")  # also the Wi-Fi begins anew

    def _ask(self, program: str) -> str:
        """What a program on the board prints."""
        with self._plugged():
            answer: bytes = self._transport.exec(program)
        return answer.decode().strip()

    @contextmanager
    def _plugged(self, quiet: bool = False) -> Iterator[None]:
        from mpremote.transport import TransportError, TransportExecError

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
