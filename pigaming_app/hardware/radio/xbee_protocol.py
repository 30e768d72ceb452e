"""Protocol of our firmware: packets broadcast through an XBee in API mode 1 or 2, or over a transparent line.

In the API modes the radio acknowledges every frame, so silence means that it is missing, and it measures signal
strength. On a transparent line the robots' reports are the only feedback.
"""

from collections import Counter, deque
from collections.abc import Mapping, Sequence
from enum import StrEnum

from pigaming_app.hardware.radio import packets, xbee_frames
from pigaming_app.hardware.radio.packets import NO_ARENA, ROBOTS, SEQUENCE, RobotReport
from pigaming_app.hardware.radio.protocol import LinkQuality, Misfit
from pigaming_app.hardware.radio.xbee_frames import BROADCAST, ATResponse, ReceivedPacket, TransmitStatus
from pigaming_app.hardware.signals import Telemetry, WheelCommand

REPORTS = 5  # reports per second and robot
WINDOW = 2.0  # s over which reports are counted
SILENCE = 1.0  # s without an acknowledgement after which the radio counts as missing


class XBeeMode(StrEnum):
    """Mode of the radio, its AP parameter."""

    TRANSPARENT = "transparent"  # AP=0, or a cable
    API1 = "api1"
    API2 = "api2"


class XBeeProtocol:
    """RadioProtocol of our firmware, for the robots of one arena (1 to packets.LAST_ARENA)."""

    boards: Mapping[int, int] = {}

    def __init__(self, arena: int, mode: XBeeMode = XBeeMode.API2) -> None:
        self.arena, self.mode = arena, mode
        self.outcomes: Counter[int] = Counter()  # broadcasts by status, see xbee_frames.TransmitStatus
        self.broadcasts = 0
        self._telemetry: dict[int, Telemetry] = {}
        self._misfits: dict[int, Misfit] = {}
        self._strength: dict[int, int] = {}  # dBm, by robot
        self._echo: dict[int, float] = {}  # s, by robot
        self._reported: dict[int, deque[float]] = {
            robot: deque(maxlen=int(REPORTS * WINDOW)) for robot in range(ROBOTS)
        }  # s, times of reports by robot
        self._sent = [float("-inf")] * SEQUENCE  # s, by sequence number
        self._seq = 0
        self.open(0.0)

    def open(self, now: float) -> bytes:
        """Reset the decoders; query the radio's mode.

        On a transparent line a decoder of escaped frames detects both API modes: most plain frames pass it unchanged.
        """
        self._frames = xbee_frames.FrameDecoder(escaped=self.mode is not XBeeMode.API1)
        self._packets: dict[int, packets.PacketDecoder] = {}  # by source
        self._opened = self._decoded = now  # s
        self._garbage = 0  # bytes discarded until the last successful decoding
        self._wrong_mode = ""  # the radio's mode if it is another one
        return b"" if self.mode is XBeeMode.TRANSPARENT else self._framed(xbee_frames.ATCommand(1, "AP"))

    @property
    def telemetry(self) -> Mapping[int, Telemetry]:
        return self._telemetry

    @property
    def misfits(self) -> Mapping[int, Misfit]:
        return self._misfits

    def command(self, wheels: Sequence[WheelCommand | None], now: float) -> bytes:
        """A broadcast for all robots."""
        self._seq = (self._seq + 1) % SEQUENCE
        self._sent[self._seq] = now
        self.broadcasts += 1
        packet = packets.drive_packet(self.arena, self._seq, wheels)
        if self.mode is XBeeMode.TRANSPARENT:
            return packet
        return self._framed(xbee_frames.TransmitRequest(1 + self.broadcasts % 255, BROADCAST, packet))

    def receive(self, received: bytes, now: float) -> None:
        """Process the frames of the radio and the reports of the robots."""
        if self.mode is XBeeMode.TRANSPARENT:
            self._decode_reports(0, received, now)
            if any(isinstance(xbee_frames.decode(data), ReceivedPacket) for data in self._frames.feed(received)):
                self._wrong_mode = "1 or 2"
            return
        for data in self._frames.feed(received):
            self._note_decoded(now)
            match xbee_frames.decode(data):
                case ReceivedPacket(source, strength, _, part):
                    for robot in self._decode_reports(source, part, now):
                        self._strength[robot] = strength
                case TransmitStatus(_, status):
                    self.outcomes[status] += 1
                case ATResponse(_, "AP", 0, value):
                    self._wrong_mode = "" if value == self._ap else str(int.from_bytes(value))

    def quality(self, robot: int, now: float) -> LinkQuality:
        """Quality over the last WINDOW seconds."""
        expected = max(1.0, REPORTS * min(WINDOW, now - self._opened))
        fresh = sum(time > now - WINDOW for time in tuple(self._reported[robot]))
        return LinkQuality(min(1.0, fresh / expected), self._strength.get(robot), self._echo.get(robot))

    def fault(self, now: float) -> tuple[str, str] | None:
        """A radio in another mode, noise, or silence."""
        if self._wrong_mode:
            return "mode", self._wrong_mode
        if now - self._decoded <= SILENCE:
            return None
        if self._discarded() > self._garbage:
            return "garbled", ""
        return None if self.mode is XBeeMode.TRANSPARENT else ("mute", "")

    def _decode_reports(self, source: int, received: bytes, now: float) -> list[int]:
        """Store the reports in these bytes; returns the robots of this arena among them, in order."""
        robots = []
        for packet in self._packets.setdefault(source, packets.PacketDecoder()).feed(received):
            self._note_decoded(now)
            if packet[0] == packets.OLD_REPORT:
                self._note_misfit(packet[1], "old", NO_ARENA, now)
            elif packet[0] == packets.REPORT:
                report = packets.report_from(packet)
                if report.arena != self.arena:
                    reason = "no_arena" if report.arena == NO_ARENA else "foreign"
                    self._note_misfit(report.address, reason, report.arena, now)
                elif 1 <= report.address <= ROBOTS:
                    robots.append(self._store(report, now))
        return robots

    def _note_misfit(self, address: int, reason: str, arena: int, now: float) -> None:
        if 1 <= address <= ROBOTS:
            self._misfits[address - 1] = Misfit(reason, arena, now)

    def _store(self, report: RobotReport, now: float) -> int:
        robot = report.address - 1
        self._telemetry[robot] = Telemetry(robot, report.millivolts / 1000, report.flags, now)
        self._reported[robot].append(now)
        if now - self._sent[report.seq] < 1.0:  # else it acknowledges an old broadcast with the same number
            self._echo[robot] = now - self._sent[report.seq]
        return robot

    def _note_decoded(self, now: float) -> None:
        self._decoded, self._garbage = now, self._discarded()

    def _discarded(self) -> int:
        frames = 0 if self.mode is XBeeMode.TRANSPARENT else self._frames.garbage
        return frames + sum(decoder.garbage for decoder in self._packets.values())

    @property
    def _ap(self) -> bytes:
        return b"\x02" if self.mode is XBeeMode.API2 else b"\x01"

    def _framed(self, message: xbee_frames.Message) -> bytes:
        return xbee_frames.frame(xbee_frames.encode(message), self.mode is XBeeMode.API2)
