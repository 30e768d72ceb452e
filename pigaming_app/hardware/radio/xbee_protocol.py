"""How the link talks to our robots: packets broadcast through an XBee in API mode 1 or 2, or on a transparent line.

In the API modes the radio answers every frame, so that silence means that there is none, and tells how strong a robot
is heard. Transparent, the robots' reports are all that is known.
"""

from collections import Counter, deque
from collections.abc import Mapping, Sequence
from enum import StrEnum

from pigaming_app.hardware.radio import packets
from pigaming_app.hardware.radio.packets import (
    BROADCAST,
    ROBOTS,
    SEQUENCE,
    ATResponse,
    ReceivedPacket,
    RobotReport,
    TransmitStatus,
)
from pigaming_app.hardware.radio.protocol import LinkQuality
from pigaming_app.hardware.signals import Telemetry, WheelCommand

REPORTS = 5  # a second, of every robot
WINDOW = 2.0  # s over which reports are counted
SILENCE = 1.0  # s without an answer after which no radio is believed to be there


class XBeeMode(StrEnum):
    """How the radio is set."""

    TRANSPARENT = "transparent"  # AP=0, or a cable
    API1 = "api1"
    API2 = "api2"


class XBeeProtocol:
    """The dialect of our firmware."""

    def __init__(self, mode: XBeeMode = XBeeMode.API2) -> None:
        self.mode = mode
        self.outcomes: Counter[int] = Counter()  # of broadcasts, by status: see packets.Outcome
        self.broadcasts = 0
        self._telemetry: dict[int, Telemetry] = {}
        self._strength: dict[int, int] = {}  # dBm, by robot
        self._echo: dict[int, float] = {}  # s, by robot
        self._heard: dict[int, deque[float]] = {robot: deque(maxlen=int(REPORTS * WINDOW)) for robot in range(ROBOTS)}
        self._sent = [float("-inf")] * SEQUENCE  # s, by sequence number
        self._seq = 0
        self.open(0.0)

    def open(self, now: float) -> bytes:
        """Forget half of what was heard; ask the radio for its mode."""
        self._frames = packets.FrameDecoder(escaped=self.mode is XBeeMode.API2)
        self._packets: dict[int, packets.PacketDecoder] = {}  # by source
        self._begun = self._understood = now
        self._garbage = 0  # bytes, when something was understood last
        self._set_to = ""  # the radio's mode, where it differs
        return b"" if self.mode is XBeeMode.TRANSPARENT else self._framed(packets.ATCommand(1, "AP"))

    @property
    def telemetry(self) -> Mapping[int, Telemetry]:
        return self._telemetry

    def command(self, wheels: Sequence[WheelCommand | None], now: float) -> bytes:
        """One broadcast for all robots."""
        self._seq = (self._seq + 1) % SEQUENCE
        self._sent[self._seq] = now
        self.broadcasts += 1
        packet = packets.drive_packet(self._seq, wheels)
        if self.mode is XBeeMode.TRANSPARENT:
            return packet
        return self._framed(packets.TransmitRequest(1 + self.broadcasts % 255, BROADCAST, packet))

    def hear(self, heard: bytes, now: float) -> None:
        """Take in what the radio and the robots say."""
        if self.mode is XBeeMode.TRANSPARENT:
            self._take_in(0, heard, now)
            if any(isinstance(packets.decode(data), ReceivedPacket) for data in self._frames.feed(heard)):
                self._set_to = "1 or 2"
            return
        for data in self._frames.feed(heard):
            self._understand(now)
            match packets.decode(data):
                case ReceivedPacket(source, strength, _, part):
                    for robot in self._take_in(source, part, now):
                        self._strength[robot] = strength
                case TransmitStatus(_, status):
                    self.outcomes[status] += 1
                case ATResponse(_, "AP", 0, value):
                    self._set_to = "" if value == self._ap else str(int.from_bytes(value))

    def quality(self, robot: int, now: float) -> LinkQuality:
        """The share is of the reports of the last two seconds."""
        expected = max(1.0, REPORTS * min(WINDOW, now - self._begun))
        fresh = sum(heard > now - WINDOW for heard in tuple(self._heard[robot]))
        return LinkQuality(min(1.0, fresh / expected), self._strength.get(robot), self._echo.get(robot))

    def trouble(self, now: float) -> tuple[str, str] | None:
        """A radio of another mode, noise, or silence."""
        if self._set_to:
            return "mode", self._set_to
        if now - self._understood <= SILENCE:
            return None
        if self._thrown_away() > self._garbage:
            return "garbled", ""
        return None if self.mode is XBeeMode.TRANSPARENT else ("mute", "")

    def _take_in(self, source: int, heard: bytes, now: float) -> list[int]:
        """Note what robots say in these bytes; the robots, in the order of their reports."""
        robots = []
        for packet in self._packets.setdefault(source, packets.PacketDecoder()).feed(heard):
            self._understand(now)
            if packet[0] == packets.REPORT and 1 <= packet[1] <= ROBOTS:
                robots.append(self._note(packets.report_from(packet), now))
        return robots

    def _note(self, report: RobotReport, now: float) -> int:
        robot = report.address - 1
        self._telemetry[robot] = Telemetry(robot, report.millivolts / 1000, report.flags, now)
        self._heard[robot].append(now)
        if now - self._sent[report.seq] < 1.0:  # else it tells of a broadcast long ago, of the same number
            self._echo[robot] = now - self._sent[report.seq]
        return robot

    def _understand(self, now: float) -> None:
        self._understood, self._garbage = now, self._thrown_away()

    def _thrown_away(self) -> int:
        frames = 0 if self.mode is XBeeMode.TRANSPARENT else self._frames.garbage
        return frames + sum(decoder.garbage for decoder in self._packets.values())

    @property
    def _ap(self) -> bytes:
        return b"\x02" if self.mode is XBeeMode.API2 else b"\x01"

    def _framed(self, message: packets.Message) -> bytes:
        return packets.frame(packets.encode(message), self.mode is XBeeMode.API2)
