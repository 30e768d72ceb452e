"""Wi-Fi robots: a `WifiNetwork` is the serial port of a link, and a `WifiProtocol` its RadioProtocol.

Robots announce themselves by broadcast. Each drive packet that the link writes goes to every announced robot of the
arena in a datagram of its own; the reports in their answers are what the link reads. Datagrams without the right
message code, of another kind, repeated or out of order are dropped. Where the system can, each robot has a socket of
its own, connected to its address: no flood of others displaces its reports.
"""

import errno
import os
import socket
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import NamedTuple, Self

from pigaming_app.hardware.radio import envelope
from pigaming_app.hardware.radio.envelope import ANNOUNCE, ANSWER, DRIVE, LAST_COUNTER, REPORT, UPDATE, Announcement
from pigaming_app.hardware.radio.packets import LENGTHS, NO_ARENA, ROBOTS, VERSION
from pigaming_app.hardware.radio.packets import REPORT as REPORT_HEAD
from pigaming_app.hardware.radio.protocol import Misfit
from pigaming_app.hardware.radio.xbee_protocol import XBeeMode, XBeeProtocol
from pigaming_app.hardware.signals import Clock

PORT = 47474  # UDP
SILENT = 0.5  # s without a report after which another robot may take over a number, or the same one after a restart
GONE = 4.0  # s without a datagram after which a robot is forgotten
BUFFER = 1 << 20  # bytes that the system keeps for a late reader, if it allows as many
MOST = 64  # robots remembered
TURN, AT_ONCE = 0.005, 2000  # s and datagrams of one socket, after which the next command has its turn
LARGEST = 1 << 16  # bytes; a shorter buffer is an error on Windows when a longer datagram comes
NO_NETWORK = (errno.ENETDOWN, errno.ENETUNREACH, errno.EADDRNOTAVAIL)

Address = tuple[str, int]


class WifiRobot(NamedTuple):
    """A robot on the network, for the operator."""

    announced: Announcement
    address: str
    status: str  # "ours", or why it cannot be driven: "foreign" arena, "no_arena", "key", "old", "taken" number, or a
    # "number" that no robot has


@dataclass
class WifiConnection:
    """Connection to a robot since its start."""

    announced: Announcement
    address: Address
    sent: int  # counter of the newest DRIVE
    received: int  # counter of the newest REPORT or ANNOUNCE
    heard: float  # s, when the newest datagram came
    replaces: bytes = b""  # nonce of the session before, void from the first REPORT of this one
    reported: float = float("-inf")  # s, when the newest REPORT came
    own: socket.socket | None = None  # for datagrams from `address` alone


class WifiNetwork:
    """The network as a SerialPort for the robots of one arena. `key`: 16 bytes, the same in their configuration.

    `port` 0 takes any free UDP port (`bound` tells it).
    """

    def __init__(self, arena: int, key: bytes, clock: Clock, port: int = PORT, host: str = "") -> None:
        self.arena, self.key, self.bound = arena, key, port
        self.offline = False  # True if this computer has no network
        self.dropped = 0  # datagrams that were not for us, forged, repeated or out of order
        self._clock, self._host = clock, host
        self._socket: socket.socket | None = None
        self._sessions: dict[int, WifiConnection] = {}  # by address of the robot, 1 to 4
        self._strangers: dict[Address, tuple[WifiRobot, float]] = {}  # robots not driven, in order of their calls, s
        self._void: set[bytes] = set()  # nonces of robots that have restarted since
        self._reports = bytearray()
        self._answers: dict[int, bytes] = {}  # the newest one of each robot to `ask`

    def open(self) -> Self:
        """Open the socket. Raises OSError, e.g. if another program has the port."""
        self.close()
        self._socket = self._bound_socket()
        self.bound = self._socket.getsockname()[1]
        for session in self._sessions.values():
            self._connect(session)
        return self

    def _bound_socket(self, beside: socket.socket | None = None, to: Address | None = None) -> socket.socket:
        """A socket at our port; `beside`: ours that has it, and shares it for now; `to`: the only other end.

        Raises OSError.
        """
        port = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            port.setblocking(False)
            port.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER)
            for one in (beside, port) if beside is not None else ():
                one.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            port.bind((self._host, self.bound))
            if to is not None:
                port.connect(to)
        except BaseException:
            port.close()
            raise
        finally:
            if beside is not None:
                beside.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 0)
        return port

    def _connect(self, session: WifiConnection) -> None:
        """Give a session a socket of its own; none where two at one port are refused, or ambiguous as on Windows."""
        if session.own is not None:
            if session.own.getpeername() == session.address:
                return
            session.own.close()
            session.own = None
        if os.name == "posix":
            with suppress(OSError):
                session.own = self._bound_socket(beside=self._socket, to=session.address)

    @property
    def robots(self) -> list[WifiRobot]:
        """The robots of the network that have called lately, those of this arena first."""
        now = self._clock()
        sessions = [session for session in [*self._sessions.values()] if now - session.heard < GONE]
        ours = sorted(WifiRobot(session.announced, session.address[0], "ours") for session in sessions)
        return ours + [robot for robot, called in [*self._strangers.values()] if now - called < GONE]

    @property
    def boards(self) -> dict[int, int]:
        """Board number of every robot of this arena, by robot from 0."""
        return {address - 1: session.announced.board for address, session in [*self._sessions.items()]}

    @property
    def misfits(self) -> dict[int, Misfit]:
        """Robots that cannot be driven, by robot from 0."""
        now = self._clock()
        strangers = [robot for robot in self.robots if robot.status not in ("ours", "taken")]
        return {
            robot.announced.address - 1: Misfit(robot.status, robot.announced.arena, now)
            for robot in strangers
            if 1 <= robot.announced.address <= ROBOTS
        }

    @property
    def in_waiting(self) -> int:
        """Bytes of reports received by now."""
        self._receive()
        return len(self._reports)

    def read(self, size: int = 1) -> bytes:
        """Bytes of whole reports."""
        data = bytes(self._reports[:size])
        del self._reports[:size]
        return data

    def write(self, data: bytes) -> int:
        """Send a drive packet to every robot of this arena."""
        assert self._socket is not None
        now, faults, reached = self._clock(), list[int | None](), False
        for session in [*self._sessions.values()]:
            if now - session.heard >= GONE or session.sent == LAST_COUNTER:
                continue
            session.sent += 1
            datagram = envelope.seal(self.key, session.announced.nonce, DRIVE, session.sent, data)
            try:
                self._socket.sendto(datagram, session.address)
                reached = True
            except BlockingIOError:
                reached = True  # busy: this one counts as lost on the way
            except OSError as error:
                faults.append(error.errno)
        self.offline = not reached and bool(faults) and all(fault in NO_NETWORK for fault in faults)
        return len(data)

    def ask(self, address: int, body: bytes) -> None:
        """Send a message of an update to a robot (1 to 4) that has called; `answer` tells what it answers."""
        assert self._socket is not None
        session = self._sessions[address]
        session.sent += 1
        self._answers.pop(address, None)
        with suppress(OSError):  # counts as lost on the way
            datagram = envelope.seal(self.key, session.announced.nonce, UPDATE, session.sent, body)
            self._socket.sendto(datagram, session.address)

    def answer(self, address: int) -> bytes | None:
        """What a robot has answered to the last `ask`; None: nothing yet."""
        self._receive()
        return self._answers.get(address)

    def close(self) -> None:
        """Close the socket; sessions stay, so that `open` continues them."""
        for session in self._sessions.values():
            port, session.own = session.own, None
            if port is not None:
                port.close()
        port, self._socket = self._socket, None
        if port is not None:
            port.close()

    def _receive(self) -> None:
        """Handle the datagrams that have arrived, our robots' first. Raises OSError if a socket has failed."""
        assert self._socket is not None
        for one in [*(session.own for session in self._sessions.values()), self._socket]:
            if one is not None:
                self._drain(one)

    def _drain(self, port: socket.socket) -> None:
        """Handle the datagrams at a socket, for at most one TURN."""
        end = self._clock() + TURN
        for _ in range(AT_ONCE):
            try:
                datagram, sender = port.recvfrom(LARGEST)
            except BlockingIOError:
                return
            except ConnectionError:
                continue  # an earlier datagram met a closed port
            if not (
                self._take_report(datagram) or self._take_answer(datagram) or self._take_announcement(datagram, sender)
            ):
                self.dropped += 1
            if self._clock() >= end:
                return

    def _take_report(self, datagram: bytes) -> bool:
        """Accept a new report of one of our robots; its sender need not have kept its address."""
        for session in self._sessions.values():
            opened = envelope.unseal(self.key, session.announced.nonce, REPORT, datagram)
            if opened is not None:
                counter, report = opened
                valid = counter > session.received and len(report) == LENGTHS[REPORT_HEAD] and report[0] == REPORT_HEAD
                if valid and report[3] == session.announced.address:
                    session.received, session.heard = counter, self._clock()
                    session.reported = session.heard
                    self._void.add(session.replaces)
                    self._reports += report
                    return True
        return False

    def _take_answer(self, datagram: bytes) -> bool:
        """Accept a new answer of one of our robots."""
        for address, session in self._sessions.items():
            opened = envelope.unseal(self.key, session.announced.nonce, ANSWER, datagram)
            if opened is not None and opened[0] > session.received:
                session.received, self._answers[address] = opened
                session.heard = self._clock()
                return True
        return False

    def _take_announcement(self, datagram: bytes, sender: Address) -> bool:
        robot = envelope.announcement_from(datagram)
        if robot is None:
            return False
        opened = envelope.unseal(self.key, robot.nonce, ANNOUNCE, datagram)
        reason = self._reason(robot, genuine=opened is not None)
        if reason is None and opened is not None:
            return self._meet(robot, opened[0], sender)
        self._note_stranger(robot, sender, reason or "key")
        return True

    def _note_stranger(self, robot: Announcement, sender: Address, status: str) -> None:
        """List a robot; the one that called longest ago makes room, but none of this arena for one of another."""
        strangers = self._strangers
        strangers.pop(sender, None)
        strangers[sender] = WifiRobot(robot, sender[0], status), self._clock()
        if len(strangers) > MOST:
            others = (address for address, (known, _) in strangers.items() if known.announced.arena != self.arena)
            del strangers[next(others, next(iter(strangers)))]

    def _reason(self, robot: Announcement, genuine: bool) -> str | None:
        """Why a robot is not ours; None if it is."""
        if robot.arena != self.arena:
            return "no_arena" if robot.arena == NO_ARENA else "foreign"
        if not genuine:
            return "key"
        if robot.version < VERSION:
            return "old"
        return None if 1 <= robot.address <= ROBOTS else "number"

    def _meet(self, robot: Announcement, counter: int, sender: Address) -> bool:
        """Begin or refresh a session. A recorded announcement, of now or of before a restart, changes nothing."""
        now, known = self._clock(), self._sessions.get(robot.address)
        self._strangers.pop(sender, None)
        if robot.nonce in self._void:
            return False
        if known is None or known.announced.nonce != robot.nonce:
            if known is not None and now - known.reported < SILENT:
                self._note_stranger(robot, sender, "taken")
                return True
            begun = WifiConnection(robot, sender, robot.counter, counter, now)
            if known is not None:
                begun.replaces, begun.own = known.announced.nonce, known.own
            self._sessions[robot.address] = begun
            self._connect(begun)
            return True
        if counter <= known.received:
            return False
        known.announced, known.address, known.heard, known.received = robot, sender, now, counter
        known.sent = max(known.sent, robot.counter)
        self._connect(known)
        return True


class WifiProtocol(XBeeProtocol):
    """RadioProtocol of Wi-Fi robots: the packets of a transparent line, and what robots announce."""

    def __init__(self, network: WifiNetwork) -> None:
        self.network = network
        super().__init__(network.arena, XBeeMode.TRANSPARENT)

    @property
    def boards(self) -> Mapping[int, int]:  # type: ignore[override]
        return self.network.boards

    def fault(self, now: float) -> tuple[str, str] | None:
        """Only the lack of a network: what others send there is no fault."""
        return ("offline", "") if self.network.offline else None

    @property
    def misfits(self) -> Mapping[int, Misfit]:
        return {**super().misfits, **self.network.misfits}
