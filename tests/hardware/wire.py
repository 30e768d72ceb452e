"""The far side of the link: a fake serial port and XBee, a settable clock, and what robots read and report."""

from typing import NamedTuple

from pigaming_app.hardware.radio import xbee_frames
from pigaming_app.hardware.radio.packets import (
    OLD_REPORT,
    REPORT,
    ROBOTS,
    STOP,
    PacketDecoder,
    RobotReport,
    crc8,
    with_crc,
)
from pigaming_app.hardware.radio.xbee_frames import FrameDecoder
from pigaming_app.hardware.signals import WheelCommand

ARENA = 4711  # of the tests


class Drive(NamedTuple):
    """Commands of all robots; None: motors off."""

    arena: int
    seq: int
    wheels: tuple[WheelCommand | None, ...]


def drive_from(packet: bytes) -> Drive:
    """Parse a drive packet validated by PacketDecoder. The unused speed 127 is a stop."""
    speeds = [0.0 if byte > 2 * STOP else (byte - STOP) / STOP for byte in packet[5 : 5 + 2 * ROBOTS]]
    wheels = (WheelCommand(*speeds[2 * robot : 2 * robot + 2]) for robot in range(ROBOTS))
    enabled = (pair if packet[4] >> robot & 1 else None for robot, pair in enumerate(wheels))
    return Drive(packet[1] | packet[2] << 7, packet[3], tuple(enabled))


def report_packet(report: RobotReport) -> bytes:
    """Encode a robot's report; the battery voltage is truncated to 14 bits."""
    arena, address, version, seq, flags, millivolts = report
    fields = (arena, arena >> 7, address, version, seq, flags, millivolts, millivolts >> 7)
    return with_crc(bytes((REPORT, *(field & 0x7F for field in fields))))


def old_report(address: int, millivolts: int = 5000) -> bytes:
    """A report of firmware 1, whose motors are stopped."""
    packet = bytes((OLD_REPORT, address, 0, 1, millivolts & 0x7F, millivolts >> 7))
    return packet + bytes((crc8(packet) & 0x7F,))


class Time:
    """A clock that a test sets."""

    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now


class Wire:
    """A fake serial port: `written` with times, `coming` to be read; `cut` makes it fail."""

    def __init__(self, time):
        self.time = time
        self.written = []  # (s, bytes)
        self.coming = b""
        self.cut = None  # an error that all methods raise
        self.is_closed = False

    @property
    def in_waiting(self):
        self._check()
        return len(self.coming)

    def read(self, size=1):
        self._check()
        given, self.coming = self.coming[:size], self.coming[size:]
        return given

    def write(self, data):
        self._check()
        self.written.append((self.time(), data))
        return len(data)

    def close(self):
        self.is_closed = True

    def _check(self):
        assert not self.is_closed
        if self.cut:
            raise self.cut


class Radio(Wire):
    """A port with an XBee that answers every broadcast."""

    def __init__(self, time, escaped=True, ap=None):
        super().__init__(time)
        self.escaped, self.ap = escaped, 2 if escaped else 1
        self.ap = ap or self.ap
        self.status = 0
        self._frames = FrameDecoder(escaped)
        self.drives = []  # (s, Drive)

    def write(self, data):
        super().write(data)
        for frame in self._frames.feed(data):
            match xbee_frames.decode(frame):
                case xbee_frames.TransmitRequest(number, xbee_frames.BROADCAST, packet):
                    self.drives += [(self.time(), drive_from(found)) for found in PacketDecoder().feed(packet)]
                    self.say(xbee_frames.TransmitStatus(number, self.status))
                case xbee_frames.ATCommand(number, "AP", b""):
                    self.say(xbee_frames.ATResponse(number, "AP", 0, bytes((self.ap,))))
        return len(data)

    def say(self, message):
        self.coming += xbee_frames.frame(xbee_frames.encode(message), self.escaped)


def run(link, time, seconds, each=lambda: None):
    """Call `each` and pump the link every 10 ms of simulated time."""
    begun = time.now
    for tick in range(round(seconds * 100)):
        time.now = begun + tick / 100
        each()
        link.pump()
    time.now = begun + seconds


def heard(decoder, data, sizes=()):
    """What a decoder finds in data that arrive in chunks of these sizes, then the rest."""
    found = []
    for size in (*sizes, len(data)):
        found += decoder.feed(data[:size])
        data = data[size:]
    return found
