"""Set-up of an XBee in its USB carrier: channel, PAN, address and mode, written and read back.

A radio in an API mode takes AT commands as frames; one in transparent mode, as those of the robots and new ones, takes
them as text after +++ between two pauses. New radios run at 9600 baud, so that rate is tried as well.
"""

from collections.abc import Callable, Generator
from contextlib import suppress
from typing import NamedTuple, TypeVar

from pigaming_app.hardware.radio.packets import ROBOTS
from pigaming_app.hardware.radio.serial_line import CANNOT_OPEN, failure_message, radio_message
from pigaming_app.hardware.radio.xbee_frames import ATCommand, ATResponse, FrameDecoder, decode, encode, frame
from pigaming_app.hardware.signals import SERIAL_FAILURES, Clock, SerialPort
from pigaming_app.storage.messages import OperatorError

FACTORY_BAUD = 9600
BOTH, FIRST_OF_BOTH = 12, 0x0C  # channels that both take
OWN_PANS = 0x4000  # added to the arena id: never the factory's PAN, 3332
BROADCAST = 0xFFFF
RATES = {1200: 0, 2400: 1, 4800: 2, 9600: 3, 19200: 4, 38400: 5, 57600: 6, 111111: 7, 115200: 7}  # value of BD, by baud
MODES = {"transparent": 0, "api1": 1, "api2": 2}  # value of AP
ANSWER = 0.4  # s, timeout of a command
REFUSED = -1  # answer to a command with a wrong value
GUARD, ENTER = 1.1, 1.6  # s of silence before +++, timeout of its answer

Value = TypeVar("Value")
Steps = Generator[None, None, Value]


class RadioNetwork(NamedTuple):
    """Channel and PAN; only radios with the same two receive each other."""

    channel: int
    pan: int

    def __str__(self) -> str:
        return f"CH {self.channel:X}, ID {self.pan:X}"


class Carrier(NamedTuple):
    """A radio on USB: `open_port` takes the baud rate and raises CANNOT_OPEN; `name` is for messages."""

    open_port: Callable[[int], SerialPort]
    clock: Clock
    name: str


def network_of(arena: int, channel: int = 0, pan: int = 0) -> RadioNetwork:
    """The network of an arena; 0: the channel or PAN that follows from its id."""
    return RadioNetwork(channel or FIRST_OF_BOTH + arena % BOTH, pan or OWN_PANS | arena)


def parameters(number: int, network: RadioNetwork, mode: str, baud: int) -> dict[str, int]:
    """AT parameters of the radio of the computer (`number` 0, `mode` of the settings) or of a robot, 1 to 4.

    Raises ValueError for a number or a baud rate that does not exist.
    """
    if not 0 <= number <= ROBOTS:
        raise ValueError(f"radio {number}; there are 0 to {ROBOTS}")
    if baud not in RATES:
        raise ValueError(f"an XBee has no rate of {baud} baud: choose 57600")
    api = MODES[mode] if number == 0 else 0
    to = BROADCAST if number == 0 and not api else 0  # in the API modes every packet names its address
    own = {"CH": network.channel, "ID": network.pan, "MY": number, "DH": 0, "DL": to}
    return {**own, "BD": RATES[baud], "AP": api}


class XBeeSetup:
    """Writes the `wanted` parameters into one radio that should answer at `baud`, a little at each of the `steps`."""

    def __init__(self, carrier: Carrier, wanted: dict[str, int], baud: int) -> None:
        self._carrier, self._wanted, self._baud = carrier, wanted, baud
        self._port: SerialPort | None = None
        self._api: int | None = None  # API mode of the radio; None: text
        self._entered = False  # true while the radio takes text commands, and so nothing else
        self._number = 0  # of the last command in an API mode

    def steps(self) -> Steps[None]:
        """Find the radio, write, save and read back. Each step takes no time. Raises OperatorError."""
        try:
            yield from self._find()
            wanted = {name: value for name, value in self._wanted.items() if name != "BD" or self._api is None}
            for name, value in wanted.items():
                yield from self._command(name, value)
                if name == "AP" and self._api is not None:
                    yield from self._follow(value)
            yield from self._command("WR")
            for name, value in wanted.items():
                if (yield from self._command(name)) != value:
                    raise self._error("setup_unsaved", f"{name} {value:X}")
            if self._api is None:
                yield from self._command("CN")
                self._entered = False
        except SERIAL_FAILURES:
            raise self._error("unplugged") from None
        finally:
            if self._entered:
                with suppress(*SERIAL_FAILURES):
                    self._write(b"ATCN\r")  # else it would answer no further attempt for 10 s
            self._close()

    def _find(self) -> Steps[None]:
        """Open the port and find the rate and mode to which the radio answers."""
        self._open(self._baud)
        self._api = 2  # the query of AP and its answer are the same frames in both API modes
        answer = yield from self._frame("AP", None)
        if answer is not None:
            self._api = answer
            return
        for baud in dict.fromkeys((self._baud, FACTORY_BAUD)):
            self._open(baud)
            if (yield from self._enter()):
                return
        raise self._error("setup_mute")

    def _follow(self, mode: int) -> Steps[None]:
        """Continue in the API mode that was just written, or as text."""
        self._api = mode
        if mode == 0 and not (yield from self._enter()):
            raise self._error("setup_mute")

    def _enter(self) -> Steps[bool]:
        """Begin the command mode; true if the radio agrees."""
        self._api = None
        end = self._carrier.clock() + GUARD
        while self._carrier.clock() < end:
            yield
        self._read()
        self._write(b"+++")
        self._entered = (yield from self._line(ENTER)) == b"OK"
        return self._entered

    def _command(self, name: str, value: int | None = None) -> Steps[int]:
        """Write a parameter, or query it; its value. Raises OperatorError when refused or unanswered."""
        answer = yield from self._text(name, value) if self._api is None else self._frame(name, value)
        if answer is None:
            raise self._error("setup_mute")
        if answer == REFUSED:
            raise self._error("setup_refused", name if value is None else f"{name} {value:X}")
        return answer

    def _text(self, name: str, value: int | None) -> Steps[int | None]:
        """A command as text; its value, REFUSED, or None without an answer."""
        self._write(f"AT{name}{'' if value is None else f'{value:X}'}\r".encode())
        answer = yield from self._line(ANSWER)
        if answer is None or answer == b"OK":
            return None if answer is None else 0
        try:
            return int(answer, 16)
        except ValueError:
            return REFUSED

    def _line(self, seconds: float) -> Steps[bytes | None]:
        """The next line of the radio; None if there is none for `seconds`."""
        end, received = self._carrier.clock() + seconds, b""
        while self._carrier.clock() < end:
            received += self._read()
            if b"\r" in received:
                return received.split(b"\r")[0].strip()
            yield
        return None

    def _frame(self, name: str, value: int | None) -> Steps[int | None]:
        """A command as an API frame; its value, REFUSED, or None without an answer."""
        self._number = self._number % 255 + 1
        data = b"" if value is None else value.to_bytes(max(1, (value.bit_length() + 7) // 8), "big")
        self._write(frame(encode(ATCommand(self._number, name, data)), self._api == 2))
        end, decoder = self._carrier.clock() + ANSWER, FrameDecoder(self._api == 2)
        while self._carrier.clock() < end:
            for found in decoder.feed(self._read()):
                match decode(found):
                    case ATResponse(self._number, answered, status, read) if answered == name:
                        return int.from_bytes(read, "big") if status == 0 else REFUSED
            yield
        return None

    def _open(self, baud: int) -> None:
        self._close()
        try:
            self._port = self._carrier.open_port(baud)
        except CANNOT_OPEN as error:
            raise OperatorError(failure_message(error, self._carrier.name)) from None

    def _close(self) -> None:
        port, self._port = self._port, None
        if port is not None:
            with suppress(*SERIAL_FAILURES):
                port.close()

    def _read(self) -> bytes:
        assert self._port is not None
        return self._port.read(waiting) if (waiting := self._port.in_waiting) else b""

    def _write(self, data: bytes) -> None:
        assert self._port is not None
        self._port.write(data)

    def _error(self, reason: str, detail: str = "") -> OperatorError:
        return OperatorError(radio_message(reason, self._carrier.name, detail))
