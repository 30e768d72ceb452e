"""A serial line to a radio that may be absent, in use, denied or unplugged at any time.

A `SerialLine` never raises: it reports faults as `fault` and reopens a lost port with exponential backoff. A write
that times out because this computer or the radio is busy leaves the port open; only STUCK seconds without a successful
write are a fault. pyserial is imported when a port is opened, not before.
"""

import errno
import re
import select
import socket
from collections.abc import Callable
from contextlib import suppress
from typing import Any, NamedTuple

from pigaming_app.hardware.signals import SERIAL_FAILURES, Clock, SerialPort
from pigaming_app.storage.messages import OperatorMessage

CANNOT_OPEN: tuple[type[Exception], ...] = (*SERIAL_FAILURES, ImportError, ValueError)  # no pyserial; invalid baud rate

BAUD = 57600  # bit/s of the radios and of our firmware
FIRST, LONGEST = 0.25, 2.0  # s between two attempts to open, doubled every time
WRITE_TIMEOUT = 0.05  # s
CONNECT = 0.5  # s until a TCP connection counts as refused
LARGEST = 1 << 16  # bytes read at once
TCP = re.compile(r"tcp:(\[?[\w.:-]+?\]?):(\d{1,5})")
STUCK = 1.0  # s without a successful write after which a port is reported

OpenPort = Callable[[], SerialPort]


ERRORS = {
    errno.ENOENT: "absent",
    errno.ENODEV: "absent",
    errno.ENXIO: "absent",
    errno.ECONNREFUSED: "absent",
    errno.EHOSTUNREACH: "absent",
    errno.EACCES: "denied",
    errno.EPERM: "denied",
    errno.EBUSY: "busy",
    errno.EADDRINUSE: "busy",  # of a UDP port
    errno.EAGAIN: "busy",  # another program holds the lock that pyserial requests
    errno.ENOTTY: "wrong",
    errno.EINVAL: "wrong",
    errno.EISDIR: "wrong",
    errno.EIO: "dead",
}


def radio_message(reason: str, port: str, detail: str = "") -> OperatorMessage:
    """Operator message for a radio fault; `reason` selects the text `hardware.radio_REASON`."""
    return OperatorMessage(f"radio_{reason}", port=port, detail=detail)


class PortInfo(NamedTuple):
    """A serial port of this computer."""

    device: str  # path or name, e.g. /dev/ttyUSB0, COM3
    description: str  # as given by the operating system


def ports() -> list[PortInfo]:
    """Serial ports of this computer, USB first; empty if pyserial is missing."""
    try:
        from serial.tools import list_ports
    except ImportError:
        return []
    available = sorted(list_ports.comports(), key=lambda port: (port.vid is None, port.device))
    return [PortInfo(port.device, port.description or port.device) for port in available]


def serial_port(device: str, baud: int = BAUD, stop_bits: int = 1) -> OpenPort:
    """A function that opens a serial port exclusively, or a TCP connection: tcp:HOST:PORT.

    Two stop bits help a radio with a slow clock.
    """

    def open_port() -> SerialPort:
        if address := TCP.fullmatch(device):
            return TcpPort(address[1], int(address[2]))
        import serial

        port: SerialPort = serial.Serial(
            device, baud, stopbits=stop_bits, timeout=0, write_timeout=WRITE_TIMEOUT, exclusive=True
        )
        return port

    return open_port


class TcpPort:
    """A TCP connection as a SerialPort. Raises OSError if nobody answers."""

    def __init__(self, host: str, port: int) -> None:
        self._socket = socket.create_connection((host, port), CONNECT)
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket.settimeout(WRITE_TIMEOUT)
        self._received = b""

    @property
    def in_waiting(self) -> int:
        """Bytes that have arrived."""
        while select.select([self._socket], [], [], 0)[0]:
            if not (data := self._socket.recv(LARGEST)):
                raise ConnectionResetError(errno.ENXIO, "closed by the other end")
            self._received += data
        return len(self._received)

    def read(self, size: int = 1) -> bytes:
        """Read at most `size` of the bytes that have arrived."""
        data, self._received = self._received[:size], self._received[size:]
        return data

    def write(self, data: bytes) -> int:
        """Send all bytes; one that the other end does not take in time is lost with its connection."""
        self._socket.sendall(data)
        return len(data)

    def close(self) -> None:
        """Close the connection."""
        self._socket.close()


def failure_message(error: Exception, port: str) -> OperatorMessage:
    """Operator message for an error in opening a port."""
    if isinstance(error, ImportError):
        return radio_message("missing", port)
    number = next((word for word in error.args if isinstance(word, int)), None)
    if number is None and (match := re.search(r"\((\d+),", str(error))):  # pyserial puts errno into the text only
        number = int(match[1])
    reason = ERRORS.get(number or 0, "failed")
    if reason == "denied" and "PermissionError(13" in str(error):  # Windows reports a port in use as denied
        reason = "busy"
    return radio_message(reason, port, " ".join(str(error).split()).rstrip("."))


class SerialLine:
    """A port that opens when possible and reopens after it is lost."""

    def __init__(self, open_port: OpenPort, clock: Clock, name: str) -> None:
        self.fault: OperatorMessage | None = None
        self.name = name
        self._open_port, self._clock = open_port, clock
        self._port: SerialPort | None = None
        self._was_open = False
        self._retry_at = float("-inf")  # s, time of the next attempt to open
        self._pause = FIRST
        self._blocked_since: float | None = None  # s, time of the first of the present write timeouts

    @property
    def is_open(self) -> bool:
        return self._port is not None

    def open(self) -> bool:
        """Try to open a closed port when a retry is due; True if this call opened it."""
        if self._port is not None or self._clock() < self._retry_at:
            return False
        try:
            self._port = self._open_port()
        except CANNOT_OPEN as error:
            reason = failure_message(error, self.name)
            gone = self._was_open and reason.key in ("radio_absent", "radio_dead")
            self.fault = radio_message("unplugged", self.name) if gone else reason
            self._wait()
            return False
        self.fault, self._was_open, self._pause, self._blocked_since = None, True, FIRST, None
        return True

    def read(self) -> bytes:
        """Bytes received since the last call; empty while the port is closed."""
        if self._port is None:
            return b""
        try:
            return self._port.read(waiting) if (waiting := self._port.in_waiting) else b""
        except SERIAL_FAILURES:
            self._lose()
            return b""

    def write(self, data: bytes) -> None:
        """Write `data`; dropped while the port is closed."""
        if self._port is None or not data:
            return
        try:
            self._port.write(data)
        except SERIAL_FAILURES as error:
            if type(error).__name__ == "SerialTimeoutException":
                self._timed_out(self._port)
            else:
                self._lose()
            return
        self._blocked_since = self.fault = None

    def close(self) -> None:
        """Close the port; `open` may reopen it."""
        port, self._port = self._port, None
        if port is not None:
            with suppress(*SERIAL_FAILURES):
                port.close()

    def _timed_out(self, port: Any) -> None:
        """Handle a write timeout: flush the buffer, as its commands would arrive stale."""
        now = self._clock()
        if self._blocked_since is None:
            self._blocked_since = now
        if now - self._blocked_since >= STUCK:
            self.fault = radio_message("stuck", self.name)
        if hasattr(port, "reset_output_buffer"):
            try:
                port.reset_output_buffer()
            except SERIAL_FAILURES:
                self._lose()

    def _lose(self) -> None:
        self.close()
        self.fault = radio_message("unplugged", self.name)
        self._wait()

    def _wait(self) -> None:
        self._retry_at = self._clock() + self._pause
        self._pause = min(2 * self._pause, LONGEST)
