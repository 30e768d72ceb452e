"""The emulated radio: a serial line to an XBee, the air, and an XBee with a serial line on every robot.

Bytes take ten bits at the baud rate on each line; packets are delayed in the air, and may be lost or duplicated. The
computer's end is a SerialPort. All times are those of the injected clock.
"""

from collections import deque
from dataclasses import dataclass
from errno import ENOENT
from heapq import heappop, heappush
from random import Random
from threading import Lock
from typing import Self

from pigaming_app.hardware.emulator import xbee
from pigaming_app.hardware.emulator.firmware import Firmware
from pigaming_app.hardware.signals import Clock

TRANSPARENT, API, API_ESCAPED = 0, 1, 2
SILENCE = 3  # character times without data that end a packet in transparent mode
LINE_HOLDS = 4096  # bytes in each queue; writes beyond it are refused


@dataclass(frozen=True)
class RadioChannel:
    """Quality of the radio channel."""

    mode: int = API_ESCAPED
    baud: int = 57600
    soonest: float = 0.002  # s in the air
    latest: float = 0.008
    loss: float = 0.0  # share of packets, for each robot independently
    duplicates: float = 0.0
    broken: float = 0.0  # share of packets with a wrong bit on the robot's line
    garbage: float = 0.0  # random bytes/s on the computer's line and on each robot's


MODERATE = RadioChannel(loss=0.005, duplicates=0.005, broken=0.002)


class EmulatedRadio:
    """The computer's end of the radio, a SerialPort. `dead`: nothing goes through; `unplugged`: the port is gone.

    `module` is the computer's XBee, `modules` are those of the robots: only equal channels and PANs hear each other.
    `neighbours`, the radios of other arenas in range, share their air.
    """

    def __init__(self, firmwares: list[Firmware], channel: RadioChannel, clock: Clock, seed: int) -> None:
        self.firmwares, self.channel, self.clock = firmwares, channel, clock
        self.dead = self.unplugged = False
        self.extra_loss = self.extra_garbage = 0.0  # in addition to those of `channel`
        self.frames = 0  # valid frames from the computer
        self.module = xbee.Module(channel.mode, 0, channel.baud)
        self.modules = [xbee.Module(TRANSPARENT, firmware.address, channel.baud) for firmware in firmwares]
        self.neighbours: list[EmulatedRadio] = []
        self._random = Random(f"radio {seed}")
        self._lock = Lock()
        self._receiver = xbee.FrameReceiver(channel.mode == API_ESCAPED)
        self._events: list[tuple[float, int, int, bytes]] = []  # s, order, robot, data
        self._order = 0
        self._out_free = self._in_free = self._last = clock()
        self._incoming: deque[tuple[float, int]] = deque(maxlen=LINE_HOLDS)  # without a reader, the oldest are lost

    def open(self) -> Self:
        """Open the port for a link. Raises FileNotFoundError when unplugged."""
        if self.unplugged:
            raise FileNotFoundError(ENOENT, "could not open port")
        return self

    @property
    def in_waiting(self) -> int:
        """Bytes received by now. Raises OSError when unplugged."""
        self._require_port()
        now = self.clock()
        with self._lock:
            return sum(1 for at, _ in self._incoming if at <= now)

    def read(self, size: int = 1) -> bytes:
        """Read at most `size` bytes without blocking. Raises OSError when unplugged."""
        self._require_port()
        out, now = bytearray(), self.clock()
        with self._lock:
            while self._incoming and self._incoming[0][0] <= now and len(out) < size:
                out.append(self._incoming.popleft()[1])
        return bytes(out)

    def write(self, data: bytes) -> int:
        """Write bytes to the line. Raises OSError when unplugged or when the queue is full."""
        self._require_port()
        with self._lock:
            byte = 10.0 / self.channel.baud
            self._out_free = max(self._out_free, self.clock())
            if (self._out_free - self.clock()) / byte + len(data) > LINE_HOLDS:
                raise OSError("the line is full")
            if self.channel.mode == TRANSPARENT:
                self._out_free += len(data) * byte
                self._send(xbee.BROADCAST, bytes(data), self._out_free + SILENCE * byte)
                return len(data)
            for value in data:
                self._out_free += byte
                frame = self._receiver.feed(value)
                if frame is not None:
                    self._take(frame, self._out_free)
        return len(data)

    def close(self) -> None:
        """No effect: the emulated radio stays."""

    def end(self) -> None:
        """Release what the radio holds."""

    def step(self) -> None:
        """Process all events that are due: robots receive, report, and apply their deadmen."""
        now = self.clock()
        with self._lock:
            while self._events and self._events[0][0] <= now:
                at, _, robot, data = heappop(self._events)
                self.firmwares[robot].receive(data, at)
            for robot, firmware in enumerate(self.firmwares):
                report = firmware.tick(now)
                if report:
                    self._report(robot, report, now)
            self._add_garbage(now - self._last)
            self._last = now

    def _require_port(self) -> None:
        if self.unplugged:
            raise OSError("device reports readiness to read but returned no data (device disconnected?)")

    def _take(self, frame: bytes, now: float) -> None:
        """Process a frame from the computer."""
        self.frames += 1
        if frame[0] == xbee.TX16 and len(frame) > 5:
            number, to = frame[1], frame[2] * 256 + frame[3]
            reached = self._send(to, frame[5:], now)
            if number:
                self._answer(bytes([xbee.TX_STATUS, number, 0 if reached else 1]), now + self._flight())
        elif frame[0] == xbee.AT and len(frame) >= 4:
            name, given = frame[2:4], frame[4:]
            status, value = self.module.command(name, given)
            self._answer(bytes([xbee.AT_ANSWER, frame[1], *name, status]) + value, now + 0.002)

    def _send(self, to: int, data: bytes, now: float) -> bool:
        """Send a packet to one robot or all; true if it counts as delivered."""
        if self.dead:
            return False
        for neighbour in self.neighbours:
            neighbour._arrive(to, data, now, self.module.network)
        return self._arrive(to, data, now, self.module.network) or to == xbee.BROADCAST

    def _arrive(self, to: int, data: bytes, now: float, network: tuple[int, int]) -> bool:
        """Pass a packet on the air of a network to the robots that it reaches; true if there is one."""
        reached = False
        for robot, firmware in enumerate(self.firmwares):
            in_network = self.modules[robot].network == network
            if in_network and to in (xbee.BROADCAST, firmware.address) and not self._lost(to):
                reached = reached or firmware.robot.alive
                for _ in range(2 if self._random.random() < self.channel.duplicates else 1):
                    self._deliver(robot, data, now + self._flight())
        return reached

    def _deliver(self, robot: int, data: bytes, now: float) -> None:
        """Queue data for a robot's controller, due at the end of its last byte."""
        if self._random.random() < self.channel.broken:
            at = self._random.randrange(len(data))
            data = data[:at] + bytes([data[at] ^ 1 << self._random.randrange(8)]) + data[at + 1 :]
        self._order += 1
        heappush(self._events, (now + len(data) * 10.0 / self.channel.baud, self._order, robot, data))

    def _report(self, robot: int, data: bytes, now: float) -> None:
        """Send a report of a robot to the computer, and to those of other arenas."""
        if self.dead:
            return
        sent = now + (len(data) + SILENCE) * 10.0 / self.channel.baud
        for radio in (self, *self.neighbours):
            if radio.module.network == self.modules[robot].network and not self._lost(0):
                radio._overhear(robot, self.firmwares[robot].address, data, sent + self._flight())

    def _overhear(self, robot: int, address: int, data: bytes, now: float) -> None:
        """Queue a report for the computer."""
        if self.channel.mode == TRANSPARENT:
            self._line(data, now)
            return
        strength = 38 + 2 * robot + self._random.randrange(6)  # -dBm
        self._answer(bytes([xbee.RX16, 0, address, strength, 0]) + data, now)

    def _answer(self, data: bytes, now: float) -> None:
        self._line(xbee.framed(data, self.channel.mode == API_ESCAPED), now)

    def _line(self, data: bytes, now: float) -> None:
        """Queue bytes on the line to the computer."""
        self._in_free = max(self._in_free, now)
        for value in data:
            self._in_free += 10.0 / self.channel.baud
            self._incoming.append((self._in_free, value))

    def _add_garbage(self, seconds: float) -> None:
        """Put random bytes on the lines, for `seconds` of time."""
        random, garbage = self._random, self.channel.garbage + self.extra_garbage
        for line in range(1 + len(self.firmwares)):
            if garbage and random.random() < garbage * seconds:
                noise = random.randbytes(1)
                if line:
                    self._deliver(line - 1, noise, self.clock())
                else:
                    self._line(noise, self.clock())

    def _lost(self, to: int) -> bool:
        """True if a packet is lost; the radio tries acknowledged packets four times."""
        tries = 1 if to == xbee.BROADCAST else 4
        return all(self._random.random() < self.channel.loss + self.extra_loss for _ in range(tries))

    def _flight(self) -> float:
        return self._random.uniform(self.channel.soonest, self.channel.latest)
