"""Emulated boards: MicroPython runs the robots' own program, in Node.js, one thread a robot, with UDP on loopback.

MicroPython is its WebAssembly build from npm, of the version in `micropython/package-lock.json`, installed into the
user's cache folder at first use. `micropython/` holds the scripts and the stand-ins for a board's hardware.
"""

import json
import queue
import shutil
import subprocess
import threading
from base64 import b64encode
from collections import deque
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import IO, Any, NamedTuple, Self, cast

from pigaming_app.hardware.robot_kinds import PROGRAM, microbit_program
from pigaming_app.storage.settings import folders

HERE = Path(__file__).parent / "micropython"
INTERPRETER = "node_modules/@micropython/micropython-webassembly-pyscript/micropython.mjs"
INSTALLING, ANSWER = 120.0, 60.0  # s, timeouts
FULL = 65535  # duty of a PWM pin
PRINTED = 100  # lines of a board that are kept

Shares = tuple[float, float]  # voltage of the left and the right motor, as shares of the battery's


class NoMicroPython(Exception):
    """MicroPython cannot be run here; the text says why."""


class WheelPins(NamedTuple):
    """Pins of a motor driver: a DRV8833 has two, a TB6612 three, Pololu's one for the direction and one for the PWM."""

    ahead: int | None
    back: int
    pwm: int | None = None

    def share(self, pins: Mapping[str, int]) -> float:
        """Voltage at the motor, as a share of the battery's."""
        back = pins.get(str(self.back), 0)
        if self.pwm is None:
            return (pins.get(str(self.ahead), 0) - back) / FULL
        way = 1 - 2 * back if self.ahead is None else pins.get(str(self.ahead), 0) - back
        return way * pins.get(str(self.pwm), 0) / FULL


WIRING: Mapping[str, tuple[WheelPins, WheelPins]] = {  # of the board files
    "board_esp32": (WheelPins(25, 26), WheelPins(32, 33)),
    "board_pico_w": (WheelPins(10, 11), WheelPins(12, 13)),
    "board_pololu_2040": (WheelPins(None, 11, 15), WheelPins(None, 10, 14)),
    "microbit": (WheelPins(8, 12), WheelPins(0, 16)),
    "cutebot": (WheelPins(100, 101), WheelPins(102, 103)),  # outputs of motor chips, see micropython/microbit.py
    "maqueen": (WheelPins(100, 101), WheelPins(102, 103)),
}
KEEPING = ("cutebot", "maqueen")  # boards whose motor chips keep their speeds while a program restarts
DIVIDERS = {"board_pololu_2040": 11}  # of the battery's voltage; on robots of one's own 3


class BoardConfig(NamedTuple):
    """`config.py` of a robot."""

    robot: int  # 1 to 4
    arena: int
    key: bytes
    port: int  # UDP port of the arcade
    name: str = ""
    board: str = "board_esp32"
    radio: str = "wifi"
    changed: Mapping[str, bytes | None] = {}  # files in place of the usual ones; None: none

    def files(self) -> dict[str, bytes]:
        """Files of the robot, by name."""
        files: dict[str, bytes | None] = {file.name: file.read_bytes() for file in PROGRAM.glob("*.py")}
        main, board = files.pop("start.py"), files.get(f"{self.board}.py")
        files |= {"main.py": main, "board.py": board, "config.py": self._config().encode()}
        return {name: data for name, data in {**files, **self.changed}.items() if data is not None}

    def _config(self) -> str:
        return (
            f'NETWORK, PASSWORD = "emulated", ""\nROBOT, NAME, ARENA = {self.robot}, {self.name!r}, {self.arena}\n'
            f'KEY, RADIO = "{self.key.hex()}", "{self.radio}"\nHOST, PORT = "127.0.0.1", {self.port}\n'
        )


class MicrobitConfig(NamedTuple):
    """A micro:bit: the relay (0) or a robot (1 to 4)."""

    number: int
    arena: int
    board: str = "microbit"

    def files(self) -> dict[str, bytes]:
        """Its only file."""
        chassis = self.board if self.board in KEEPING else ""
        return {"main.py": microbit_program(self.number, self.arena, chassis).encode()}


def interpreter() -> Path:
    """MicroPython's WebAssembly build, installed if necessary. Raises NoMicroPython."""
    node, npm = shutil.which("node"), shutil.which("npm")
    if not node:
        raise NoMicroPython("Node.js is not installed (apt-get install nodejs npm)")
    folder = folders().cache / "micropython"
    lock = HERE / "package-lock.json"
    found, installed = folder / INTERPRETER, folder / lock.name
    if found.is_file() and installed.is_file() and installed.read_bytes() == lock.read_bytes():
        return found
    if not npm:
        raise NoMicroPython("npm is not installed (apt-get install npm)")
    folder.mkdir(parents=True, exist_ok=True)
    for file in (HERE / "package.json", lock):
        shutil.copy(file, folder)
    command = [npm, "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--prefix", str(folder)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=INSTALLING, cwd=folder)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise NoMicroPython(f"npm cannot install MicroPython ({type(error).__name__})") from error
    if done.returncode or not found.is_file():
        raise NoMicroPython("npm cannot install MicroPython; is this computer online?")
    return found


def _spec(config: BoardConfig | MicrobitConfig) -> dict[str, Any]:
    """One robot for `boards.mjs`."""
    files = {file.name: file.read_bytes() for file in HERE.glob("*.py")} | config.files()
    encoded = {name: b64encode(data).decode() for name, data in files.items()}
    return {"board": config.board, "divider": DIVIDERS.get(config.board, 3), "files": encoded}


class Boards:
    """Running boards; a context manager. `paced`: their time passes in `advance` only, else it is the system's.

    `wiring`: the motors by board. `pins` holds the values at the pins of every robot, 0 to 65535, `printed` its lines
    on USB; times are s of `advance`, or of `time.monotonic`. Raises NoMicroPython.
    """

    def __init__(
        self,
        configs: Sequence[BoardConfig | MicrobitConfig],
        paced: bool = False,
        wiring: Mapping[str, tuple[WheelPins, WheelPins]] = WIRING,
    ) -> None:
        self.pins: list[Mapping[str, int]] = [{} for _ in configs]
        self.powered_until = [float("-inf")] * len(configs)  # s, when the motors were last switched off
        self.resets: list[tuple[int, int]] = []  # robot and cause (1 power, 2 program, 3 watchdog), in order
        self.printed = [deque[str](maxlen=PRINTED) for _ in configs]
        self._wiring = [wiring[config.board] for config in configs]
        self._keeping = [config.board in KEEPING for config in configs]
        first = {
            "robots": [_spec(config) for config in configs],
            "interpreter": interpreter().as_uri(),
            "paced": paced,
        }
        self._process = subprocess.Popen(
            ["node", str(HERE / "boards.mjs")], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        self._lines: queue.Queue[str] = queue.Queue()
        self._reader = threading.Thread(target=self._read, name="boards", daemon=True)
        self._reader.start()
        self._tell(first)
        self.ports: list[int] = self._await("ports")

    def advance(self, now: float, received: Sequence[int] = ()) -> None:
        """Let the boards run until `now`, s, once each has received so many datagrams. Only if `paced`."""
        self._tell({"now": round(1000 * now), "received": list(received)})
        self._await("now")

    def disturb(self, robot: int, **order: Any) -> None:
        """Disturb a board.

        `do`: "reboot", "off", "hang loop" (the timer runs on), "hang board", or in the main loop "error" or "interrupt"
        (Ctrl-C); `battery`, `reference` (of the ADC): mV; `button`, `offline`: 1 or 0; `pulses`: totals of the left and
        the right encoder; `cut`: the power is off after so many changes of the disk, 0: not.
        """
        self._tell({"robot": robot, **order})
        if order.get("do") == "off" and self._keeping[robot]:  # the chip has no power either
            self.pins[robot] = {}

    def motors(self, robot: int) -> Shares:
        """Voltages at the motors of a robot now."""
        self.poll()
        return self._shares(robot)

    def poll(self) -> None:
        """Take in everything that the boards have reported."""
        while not self._lines.empty():
            self._take(json.loads(self._lines.get()))

    def close(self) -> None:
        """End all boards. Idempotent."""
        if self._process.poll() is None:
            self._process.kill()
        self._process.wait()
        self._reader.join(1.0)
        for pipe in (self._process.stdin, self._process.stdout):
            with suppress(OSError):
                cast(IO[str], pipe).close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _shares(self, robot: int) -> Shares:
        left, right = self._wiring[robot]
        return left.share(self.pins[robot]), right.share(self.pins[robot])

    def _tell(self, order: Mapping[str, Any]) -> None:
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(json.dumps(order) + "\n")
            self._process.stdin.flush()
        except OSError as error:
            raise RuntimeError("the emulated boards have ended") from error

    def _read(self) -> None:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            self._lines.put(line)
        self._lines.put("{}")

    def _await(self, key: str) -> Any:
        """The value of the next message with this key."""
        while True:
            try:
                message = json.loads(self._lines.get(timeout=ANSWER))
            except queue.Empty:
                raise RuntimeError("the emulated boards do not answer") from None
            if not message or "failed" in message:
                raise RuntimeError(f"the emulated boards have ended: {message.get('failed', '')}")
            if key in message:
                return message[key]
            self._take(message)

    def _take(self, message: Mapping[str, Any]) -> None:
        if "pins" in message:
            robot = message["robot"]
            was_on = any(self._shares(robot))
            self.pins[robot] = {**self.pins[robot], **message["pins"]} if self._keeping[robot] else message["pins"]
            if was_on and not any(self._shares(robot)):
                self.powered_until[robot] = message["at"] / 1000
        elif "printed" in message:
            self.printed[message["robot"]].append(message["printed"])
        elif "reset" in message:
            self.resets.append((message["robot"], message["reset"]))
