"""A board with MicroPython on USB becomes a robot: its files are written, checked and put in place one by one.

A cable that is pulled at any moment does no harm: a file gets its name only when it is complete, `main.py` last, and
the next attempt writes what is missing. A micro:bit cannot rename: a part of its only file does nothing, since the last
line starts it. `mpremote` talks to the board.
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
from typing import Any, NamedTuple, TypeVar

from pigaming_app.hardware.robot_kinds import PROGRAM, RELAY, microbit_program, robot_config
from pigaming_app.hardware.signals import SERIAL_FAILURES
from pigaming_app.storage.messages import OperatorError, OperatorMessage

Tell = Callable[[str, bool], None]


class BoardKind(NamedTuple):
    """A kind of board: its proper name, the names of its board file and of its radio's program."""

    name: str
    file: str  # of a micro:bit: its chassis, see robot_kinds
    radio: str


WIFI, XBEE, MICROBIT = "wifi", "serial_radio", "radio"
KINDS = {
    "pico_w": BoardKind("Pico W", "board_pico_w", WIFI),
    "esp32": BoardKind("ESP32", "board_esp32", WIFI),
    "pololu_2040": BoardKind("Pololu 2040", "board_pololu_2040", XBEE),
    "microbit": BoardKind("micro:bit", "", MICROBIT),
    "cutebot": BoardKind("Cutebot", "cutebot", MICROBIT),
    "maqueen": BoardKind("Maqueen", "maqueen", MICROBIT),
    "relay": BoardKind("micro:bit", "", MICROBIT),  # on the computer's USB port
}
BOARDS = {"rp2": "pico_w", "esp32": "esp32"}  # kind by `sys.platform`, of boards with Wi-Fi
MAKER = "pololu"  # in the name of the machine, by Pololu's own MicroPython
OTHERS = re.compile(r"ESP32-?[SCHP]\d")  # chips of other pins
OLDEST, OLDEST_MICROBIT = (1, 22), (1, 15)  # versions of MicroPython; that of a micro:bit V1 is 1.9
DAPLINK = 0x0D28  # vendor of a micro:bit's USB chip
USB = {  # by vendor; radios have FTDI's
    0x2E8A: "Raspberry Pi",
    0x303A: "Espressif",
    0x1FFB: "Pololu",
    0x10C4: "CP210x",
    0x1A86: "CH340",
    DAPLINK: "micro:bit",
}
RATE, SILENT = 115_200, 3.0  # bit/s; s
RELAY_RATE, END_RELAY = 57_600, 64 * b"\3"  # bit/s; bytes that end the program of a relay
RELAY_ENDS = 0.2  # s
TURNS = {"left": (16, 0), "right": (0, 16), "back": (-16, -16)}  # speed codes of left and right wheel; 63 is full speed
TURN_MS = 1200
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


class SetupFailed(OperatorError):
    """A board cannot be set up; the message says why."""


def only_port() -> str:
    """The serial port of the only board on USB, known by the vendor of its chip. Raises SetupFailed."""
    ports = [port for port, vendor in _vendors().items() if vendor in USB]
    if len(ports) != 1:
        there = ", ".join(ports)
        raise SetupFailed(OperatorMessage("board_several" if ports else "board_none", ports=there))
    return ports[0]


def _vendors() -> dict[str, int | None]:
    """The serial ports of this computer, each with the vendor of its USB chip."""
    from serial.tools.list_ports import comports

    return {port.device: port.vid for port in comports()}


def set_up(port: str, board: str, files: Callable[[str], Mapping[str, bytes]], tell: Tell) -> str:
    """Make the board at a port a robot, and start it; its kind of board. Raises SetupFailed.

    `board`: one of KINDS, empty: found out, and a board file that is there is kept; `files`: those for a kind;
    `tell`: see `BoardOnUsb.write`.
    """
    return _repeated(lambda: _set_up(port, board, files, tell))


def try_on_blocks(port: str, board: str, tell: Callable[[str], None]) -> int:
    """Turn the wheels of the robot at a port, which stands on blocks, and light its lamp; then start its program.

    `board`: as of `set_up`; `tell` gets the name of each of TURNS, and `lamp`, before it happens. Returns the battery's
    voltage in mV, 0 where it is not measured. Raises SetupFailed.
    """
    return _repeated(lambda: _try_on_blocks(port, board, tell))


T = TypeVar("T")


def _repeated(action: Callable[[], T]) -> T:
    """Its value, at the second attempt if a board fell silent."""
    try:
        return action()
    except SetupFailed as failed:
        if failed.message.key not in ("board_gone", "board_silent", "board_microbit"):
            raise
    sleep(AGAIN)
    return action()


def _set_up(port: str, board: str, files: Callable[[str], Mapping[str, bytes]], tell: Tell) -> str:
    with BoardOnUsb(port) as connected:
        kind = connected.kind_or(board)
        wanted = dict(files(kind))
        if not board and PINS in wanted and connected.has(PINS):
            del wanted[PINS]
        connected.write(wanted, tell)
        connected.restart()
    return kind


def _try_on_blocks(port: str, board: str, tell: Callable[[str], None]) -> int:
    with BoardOnUsb(port) as connected:
        kind = connected.kind_or(board)
        folder = PROGRAM / "microbit" if KINDS[kind].radio == MICROBIT else PROGRAM
        folder = PROGRAM / "microbit" if KINDS[kind].radio == MICROBIT else PROGRAM
        connected.begin_anew()
        connected.ask((folder / "on_blocks.py").read_text("utf-8"))
        for name, (left, right) in TURNS.items():
            tell(name)
            connected.ask(f"turn({left}, {right}, {TURN_MS})")
        tell("lamp")
        millivolts = int(connected.ask(f"light({TURN_MS})\nprint(battery())"))
        connected.restart()
    return millivolts


def files_of(kind: str, robot: int, arena: int, key: bytes, network: str, password: str) -> dict[str, bytes]:
    """The files of a robot (1 to 4) by their names on the board, in the order in which they are written.

    `kind`: one of KINDS. Raises SetupFailed if it needs a network and has none.
    """
    board = KINDS[kind]
    if board.radio == MICROBIT:
        return {MAIN: microbit_program(RELAY if kind == "relay" else robot, arena, board.file).encode()}
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
        microbit = _vendors().get(self.port) == DAPLINK
        with self._plugged():
            self._transport = SerialTransport(self.port, RATE, timeout=SILENT)
        try:
            with self._plugged():
                if microbit:
                    self._end_relay()
                self._transport.enter_raw_repl(soft_reset=False, timeout_overall=SILENT)
        except SetupFailed as failed:
            self.__exit__()
            if microbit and failed.message.key == "board_silent":
                raise SetupFailed(OperatorMessage("board_microbit", port=self.port)) from None
            raise
        return self

    def __exit__(self, *_: object) -> None:
        if self._transport:
            with self._plugged(quiet=True):
                self._transport.exit_raw_repl()
            with self._plugged(quiet=True):
                self._transport.close()

    def kind_or(self, board: str) -> str:
        """The given one of KINDS, or that of the board if empty. Raises SetupFailed if neither or both are known."""
        kind = self.kind()
        if not (board or kind):
            raise SetupFailed(OperatorMessage("board_unknown", port=self.port, kinds=", ".join(KINDS)))
        if board and kind and (KINDS[board].radio == MICROBIT) != (KINDS[kind].radio == MICROBIT):
            raise SetupFailed(OperatorMessage("board_other", port=self.port, kind=KINDS[kind].name))
        return board or kind

    def kind(self) -> str:
        """One of KINDS, or empty for an unknown board. Raises SetupFailed for an old MicroPython."""
        try:
            told = json.loads(self.ask(ASK))
        except ValueError:  # it printed something else
            raise SetupFailed(OperatorMessage("board_silent", port=self.port)) from None
        if told["platform"] == "microbit":
            if tuple(told["version"]) < OLDEST_MICROBIT:
                raise SetupFailed(OperatorMessage("board_microbit", port=self.port))
            return "microbit"
        if told["name"] != "micropython" or tuple(told["version"]) < OLDEST:
            raise SetupFailed(OperatorMessage("board_old", version=".".join(map(str, told["version"]))))
        if told["platform"] == "rp2" and MAKER in told["machine"].lower():
            return "pololu_2040"
        return BOARDS.get(told["platform"], "") if told["wifi"] and not OTHERS.search(told["machine"]) else ""

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

    def _end_relay(self) -> None:
        """End the program of a relay, to which Ctrl-C is data; others take it for noise."""
        line = self._transport.serial
        line.baudrate = RELAY_RATE
        line.write(END_RELAY)
        line.flush()
        sleep(RELAY_ENDS)
        line.baudrate = RATE

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
