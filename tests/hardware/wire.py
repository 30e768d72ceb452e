"""A fake serial port, a settable clock and a fake XBee, for tests of the link; and byte streams in chunks."""

from pigaming_app.hardware.radio import xbee_frames
from pigaming_app.hardware.radio.packets import PacketDecoder
from pigaming_app.hardware.radio.xbee_frames import FrameDecoder
from tests.hardware.robot_packets import drive_from


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
