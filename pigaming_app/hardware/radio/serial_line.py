"""A serial line to a radio, which may be absent, in use, forbidden or pulled out at any moment.

Opening reports what is wrong. A `SerialLine` never raises: it reads and writes what it can, and when the port
is gone it tries again, at longer and longer intervals. A write that times out, because this computer or the radio is
busy, leaves the port open; only a port that has taken nothing for STUCK seconds is reported. pyserial is imported when
a port is opened, not before.
"""

import errno
import re
from collections.abc import Callable
from contextlib import suppress
from typing import NamedTuple, Protocol, runtime_checkable

from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.signals import Clock, SerialPort

try:
    from termios import error as termios_error
except ImportError:  # Windows
    FAILURES: tuple[type[Exception], ...] = (OSError,)
else:
    FAILURES = (OSError, termios_error)  # pyserial's SerialException is an OSError; termios.error is none
CANNOT_OPEN: tuple[type[Exception], ...] = (
    *FAILURES,
    ImportError,
    ValueError,
)  # no pyserial; a baud rate that the port cannot have

BAUD = 57600  # bit/s, of the radios and of our firmware
FIRST, LONGEST = 0.25, 2.0  # s between two attempts to open: doubled every time
WRITE_TIMEOUT = 0.05  # s
STUCK = 1.0  # s without a successful write after which a port is reported

OpenPort = Callable[[], SerialPort]


@runtime_checkable
class BufferedPort(Protocol):
    """A port whose unsent bytes can be dropped, as pyserial's can."""

    def reset_output_buffer(self) -> None: ...


ERRORS = {
    errno.ENOENT: "absent",
    errno.ENODEV: "absent",
    errno.ENXIO: "absent",
    errno.EACCES: "denied",
    errno.EPERM: "denied",
    errno.EBUSY: "busy",
    errno.EAGAIN: "busy",  # another program holds the lock that pyserial asks for
    errno.ENOTTY: "wrong",
    errno.EINVAL: "wrong",
    errno.EISDIR: "wrong",
    errno.EIO: "dead",
}


def radio_message(reason: str, port: str, detail: str = "") -> OperatorMessage:
    """Why there is no radio at a port; `reason` is a key of `hardware.radio_REASON`."""
    return OperatorMessage(f"radio_{reason}", port=port, detail=detail)


class PortInfo(NamedTuple):
    """A serial port of this computer."""

    device: str  # what to open: /dev/ttyUSB0, COM3
    description: str  # in words of the system


def ports() -> list[PortInfo]:
    """The serial ports of this computer, those on USB first; none where pyserial is missing."""
    try:
        from serial.tools import list_ports
    except ImportError:
        return []
    found = sorted(list_ports.comports(), key=lambda port: (port.vid is None, port.device))
    return [PortInfo(port.device, port.description or port.device) for port in found]


def serial_port(device: str, baud: int = BAUD, stop_bits: int = 1) -> OpenPort:
    """What opens a serial port of this computer for us alone. Two stop bits help a radio whose clock is slow."""

    def open_it() -> SerialPort:
        import serial

        port: SerialPort = serial.Serial(
            device, baud, stopbits=stop_bits, timeout=0, write_timeout=WRITE_TIMEOUT, exclusive=True
        )
        return port

    return open_it


def trouble_of(error: Exception, port: str) -> OperatorMessage:
    """Why a port could not be opened."""
    if isinstance(error, ImportError):
        return radio_message("missing", port)
    number = next((word for word in error.args if isinstance(word, int)), None)
    if number is None and (told := re.search(r"\((\d+),", str(error))):  # pyserial tucks it into its text
        number = int(told[1])
    reason = ERRORS.get(number or 0, "failed")
    if reason == "denied" and "PermissionError(13" in str(error):  # Windows says so of a port that is in use
        reason = "busy"
    return radio_message(reason, port, " ".join(str(error).split()).rstrip("."))


class SerialLine:
    """A port that is opened when it can be, and again when it was lost."""

    def __init__(self, open_port: OpenPort, clock: Clock, name: str) -> None:
        self.trouble: OperatorMessage | None = None
        self.name = name
        self._open_port, self._clock = open_port, clock
        self._port: SerialPort | None = None
        self._lost = False  # whether it was open before
        self._again = float("-inf")  # s, when opening may be tried
        self._pause = FIRST
        self._held_up: float | None = None  # s, when writes began to time out

    @property
    def is_open(self) -> bool:
        return self._port is not None

    def open(self) -> bool:
        """Open the port if it is closed and the time has come; whether it is open now and was not before."""
        if self._port is not None or self._clock() < self._again:
            return False
        try:
            self._port = self._open_port()
        except CANNOT_OPEN as error:
            reason = trouble_of(error, self.name)
            gone = self._lost and reason.key in ("radio_absent", "radio_dead")
            self.trouble = radio_message("unplugged", self.name) if gone else reason
            self._wait()
            return False
        self.trouble, self._lost, self._pause, self._held_up = None, True, FIRST, None
        return True

    def read(self) -> bytes:
        """What has come in; nothing while there is no port."""
        if self._port is None:
            return b""
        try:
            return self._port.read(waiting) if (waiting := self._port.in_waiting) else b""
        except FAILURES:
            self._lose()
            return b""

    def write(self, data: bytes) -> None:
        """Send, or forget it while there is no port."""
        if self._port is None or not data:
            return
        try:
            self._port.write(data)
        except FAILURES as error:
            if type(error).__name__ == "SerialTimeoutException":
                self._hold_up(self._port)
            else:
                self._lose()
            return
        self._held_up = self.trouble = None

    def close(self) -> None:
        """Close the port; it may be opened again."""
        port, self._port = self._port, None
        if port is not None:
            with suppress(*FAILURES):
                port.close()

    def _hold_up(self, port: SerialPort) -> None:
        """A write timed out. What waits in the buffer is dropped: by the time it got through, it would be stale."""
        now = self._clock()
        if self._held_up is None:
            self._held_up = now
        if now - self._held_up >= STUCK:
            self.trouble = radio_message("stuck", self.name)
        if isinstance(port, BufferedPort):
            try:
                port.reset_output_buffer()
            except FAILURES:
                self._lose()

    def _lose(self) -> None:
        self.close()
        self.trouble = radio_message("unplugged", self.name)
        self._wait()

    def _wait(self) -> None:
        self._again = self._clock() + self._pause
        self._pause = min(2 * self._pause, LONGEST)
