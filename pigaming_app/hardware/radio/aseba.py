"""Protocol of Thymios: Aseba's messages over the port of their dongle, or over TCP to its switch.

Robots that answer are described, get our program (thymio_program), and then obey one event for all, in which they are
asked for reports in turn. They are numbered by the numbers of their nodes. A robot that has lost the program, or whose
program somebody has halted, gets it again: until then its motors are off.

A message: length of its data, number of its node, type, data; all in words of 16 bits, low byte first (Aseba 1.6,
common/consts.h and common/msg).
"""

import struct
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from pigaming_app.hardware.radio import thymio_program
from pigaming_app.hardware.radio.packets import PARKED, ROBOTS
from pigaming_app.hardware.radio.protocol import LinkQuality, Misfit
from pigaming_app.hardware.radio.thymio_program import DRIVE, NEEDED, NEEDED_EVENTS, REPORT, STATUS
from pigaming_app.hardware.signals import Telemetry, WheelCommand

HEAD = struct.Struct("<HHH")
LARGEST = 516  # bytes of data
DESCRIPTION, VARIABLE, LOCAL_EVENT, NATIVE, GONE, VARIABLES = range(0x9000, 0x9006)
OUT_OF_BOUNDS, DIVIDED_BY_ZERO, KILLED, FAILED, STATE = range(0x9006, 0x900B)
PRESENT = 0x900C
LOST = GONE, OUT_OF_BOUNDS, DIVIDED_BY_ZERO, KILLED, FAILED  # the program may have ended
SET_BYTECODE, RUN, GET_VARIABLES = 0xA001, 0xA003, 0xA00B
DESCRIBE, LIST_NODES = 0xA010, 0xA011
VERSION = 5  # of Aseba's protocol
HALTED = 2  # flag of STATE

FULL = 500  # target of a motor at full speed
ROUND = 10  # commands in which each robot is asked for one report
SEQUENCE = 10_000  # commands are numbered below it
WINDOW = 2.0  # s over which reports are counted
VOLT = 397.8  # sum of both words of `_vbat`, by the firmware's behavior.c
CALL, SETTLED = 1.0, 1.0  # s between two calls for robots; s from the first answer until robots are numbered
UNDESCRIBED, PATIENCE = 2.0, 6.0  # s until a description is asked for again; until the others do not wait for it
SILENT, JUDGED = 3.0, 1.0  # s without a report until a robot gets its program again; until it may, having been halted
FOREIGN = 1.0  # s for which a report to another arcade counts


class AsebaMessage(NamedTuple):
    """A message of a node; the computer is node 0."""

    node: int
    kind: int
    data: bytes

    def encoded(self) -> bytes:
        """The message with its head."""
        return HEAD.pack(len(self.data), self.node, self.kind) + self.data


def message(kind: int, *words: int) -> bytes:
    """A message of this computer, of signed or unsigned words."""
    return AsebaMessage(0, kind, b"".join(struct.pack("<H", word & 0xFFFF) for word in words)).encoded()


def drive(arena: int, sequence: int, asked: int, wheels: Sequence[WheelCommand | None]) -> bytes:
    """The event for all robots; robot `asked` reports."""
    shares = [share for command in wheels for share in command or (0.0, 0.0)]
    return message(DRIVE, arena, sequence, asked, *(round(FULL * max(-1.0, min(1.0, share))) for share in shares))


class AsebaDecoder:
    """Messages from a stream; what cannot be the head of one is `garbage`, counted in bytes."""

    def __init__(self) -> None:
        self.garbage = 0
        self._rest = b""

    def feed(self, received: bytes) -> Iterator[AsebaMessage]:
        """The messages that are complete now."""
        self._rest += received
        while len(self._rest) >= HEAD.size:
            size, node, kind = HEAD.unpack_from(self._rest)
            if size > LARGEST or (size % 2 and not DESCRIPTION <= kind <= NATIVE):
                self.garbage, self._rest = self.garbage + 1, self._rest[1:]
            elif len(self._rest) < HEAD.size + size:
                return
            else:
                data, self._rest = self._rest[HEAD.size : HEAD.size + size], self._rest[HEAD.size + size :]
                yield AsebaMessage(node, kind, data)


@dataclass
class ThymioNode:
    """A node of the network, as far as it is known."""

    number: int
    met: float  # s
    asked: float = float("-inf")  # s, for its description
    missing: int = -1  # parts of the description; -1: all
    places: dict[str, int] = field(default_factory=dict)
    end: int = 0  # place behind the variables
    events: list[str] = field(default_factory=list)
    robot: int | None = None
    loaded: float = float("-inf")  # s, when it got our program
    heard: float = float("-inf")  # s, its last report to us
    foreign: float = float("-inf")  # s, its last report to another arcade
    battery: float = 0.0  # V, 0: not measured

    @property
    def fit(self) -> bool:
        """Whether it has been described, and our program can run on it."""
        return self.missing == 0 and {*NEEDED} <= {*self.places} and {*NEEDED_EVENTS} <= {*self.events}


class AsebaProtocol:
    """RadioProtocol of the Thymios of one arena."""

    boards: Mapping[int, int] = {}

    def __init__(self, arena: int) -> None:
        self.arena = arena
        self.telemetry: dict[int, Telemetry] = {}
        self.misfits: dict[int, Misfit] = {}
        self._echo: dict[int, float] = {}  # s, by robot
        self._reported = [deque[float](maxlen=round(WINDOW * 50 / ROUND)) for _ in range(ROBOTS)]
        self._sent = [float("-inf")] * ROUND  # s, by the last digit of their numbers
        self._sequence = 0
        self._nodes: dict[int, ThymioNode] = {}
        self.open(0.0)

    def open(self, now: float) -> bytes:
        """Call all robots; those that are known keep their numbers."""
        self._decoder, self._called, self._opened = AsebaDecoder(), now, now
        self._understood, self._garbage = now, 0  # s, and bytes until then
        return message(LIST_NODES, VERSION)

    def command(self, wheels: Sequence[WheelCommand | None], now: float) -> bytes:
        """The event for all robots, and at most one message that prepares one of them."""
        self._sequence = (self._sequence + 1) % SEQUENCE
        slot = self._sequence % ROUND
        self._sent[slot] = now
        asked, odd = divmod(slot, 2)
        return drive(self.arena, self._sequence, -1 if odd else asked, wheels) + self._preparation(slot, now)

    def receive(self, received: bytes, now: float) -> None:
        """Process messages."""
        for one in self._decoder.feed(received):
            node = self._nodes.get(one.node)
            try:
                if one.kind == PRESENT or node is None:
                    self._nodes.setdefault(one.node, ThymioNode(one.node, now))
                else:
                    self._take(node, one, now)
            except (struct.error, IndexError, UnicodeDecodeError):
                self._decoder.garbage += len(one.data)
            else:
                self._understood, self._garbage = now, self._decoder.garbage

    def quality(self, robot: int, now: float) -> LinkQuality:
        """Quality over the last WINDOW seconds."""
        expected = max(1.0, 50 / ROUND * min(WINDOW, now - self._opened))
        fresh = sum(time > now - WINDOW for time in tuple(self._reported[robot]))
        return LinkQuality(min(1.0, fresh / expected), None, self._echo.get(robot))

    def fault(self, now: float) -> tuple[str, str] | None:
        """Bytes that are no messages; silence is no fault: robots may be off."""
        garbled = now - self._understood > 1.0 and self._decoder.garbage > self._garbage
        return ("garbled", "") if garbled else None

    def _preparation(self, slot: int, now: float) -> bytes:
        if now - self._called >= CALL:
            self._called = now
            return message(LIST_NODES, VERSION)
        nodes = [*self._nodes.values()]
        if all(node.missing == 0 or now - node.met > PATIENCE for node in nodes):
            self._number(now)
        for node in nodes:
            if node.missing and now - node.asked >= UNDESCRIBED:
                node.asked, node.missing = now, -1
                return message(DESCRIBE, node.number, VERSION)
            if node.robot is not None and self._ours(node, now) and now - max(node.heard, node.loaded) >= SILENT:
                return self._load(node, node.robot, now)
        robot, asks = divmod(self._sequence // 2, 25)  # each robot once in 4 s
        for node in nodes if asks == 0 and slot % 2 else ():
            if node.robot == robot % ROBOTS and "_vbat" in node.places:
                return message(GET_VARIABLES, node.number, node.places["_vbat"], 2)
        return b""

    def _number(self, now: float) -> None:
        """Number the robots that have none yet, after a while in which all may have answered."""
        free = [robot for robot in range(ROBOTS) if all(node.robot != robot for node in self._nodes.values())]
        new = [node for _, node in sorted(self._nodes.items()) if node.robot is None and self._ours(node, now)]
        if all(now - node.met >= SETTLED for node in new):
            for robot, node in zip(free, new, strict=False):
                node.robot = robot

    def _ours(self, node: ThymioNode, now: float) -> bool:
        """Whether we may load our program: a robot that runs it, and no other arcade drives it."""
        return node.fit and now - node.foreign > FOREIGN

    def _load(self, node: ThymioNode, robot: int, now: float) -> bytes:
        node.loaded = now
        words = thymio_program.linked(node.places, node.end, node.events, self.arena, robot)
        return message(SET_BYTECODE, node.number, 0, *words) + message(RUN, node.number)

    def _take(self, node: ThymioNode, one: AsebaMessage, now: float) -> None:
        """A message of a node that is known."""
        kind, data = one.kind, one.data
        if kind == REPORT and len(data) == 2 * STATUS:
            self._take_report(node, struct.unpack("<4h", data), now)
        elif kind == DESCRIPTION:
            *_, variables, events, natives = struct.unpack_from("<7H", data, 1 + data[0])
            node.missing, node.places, node.end, node.events = variables + events + natives, {}, 0, []
        elif kind == VARIABLE and node.missing > 0:
            node.places[_text(data, 2)] = node.end
            node.end += struct.unpack_from("<H", data)[0]
            node.missing -= 1
        elif kind in (LOCAL_EVENT, NATIVE) and node.missing > 0:
            node.events += [_text(data, 0)] * (kind == LOCAL_EVENT)
            node.missing -= 1
        elif kind == VARIABLES and struct.unpack_from("<H", data)[0] == node.places.get("_vbat"):
            node.battery = sum(struct.unpack_from("<2h", data, 2)) / VOLT
        elif kind in LOST or (kind == STATE and struct.unpack_from("<2H", data)[1] & HALTED):
            self._doubt(node, now)

    def _doubt(self, node: ThymioNode, now: float) -> None:
        """A node may not run our program any more: it gets it again, unless it has just got it."""
        if now - node.loaded >= JUDGED:
            node.heard = node.loaded = float("-inf")

    def _take_report(self, node: ThymioNode, status: Sequence[int], now: float) -> None:
        arena, robot, sequence, parked = status
        if arena != self.arena:
            node.foreign = now
            self.misfits[robot] = Misfit("foreign", arena, now)
            return
        if robot != node.robot:
            return  # it has the program of an earlier link, and gets a new one
        node.heard = now
        self.telemetry[robot] = Telemetry(robot, node.battery, PARKED * bool(parked), now)
        self._reported[robot].append(now)
        if (self._sequence - sequence) % SEQUENCE < ROUND:
            self._echo[robot] = now - self._sent[sequence % ROUND]


def _text(data: bytes, start: int) -> str:
    return data[start + 1 : start + 1 + data[start]].decode()
