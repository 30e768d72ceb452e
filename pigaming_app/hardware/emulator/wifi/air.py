"""The emulated network between an arcade and its Wi-Fi robots: datagrams are delayed, lost, duplicated and overtake.

All ends are UDP sockets on loopback. A robot has an address of its own towards the arcade, and sees it at another.
"""

import socket
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from heapq import heappop, heappush
from random import Random

LOOPBACK = "127.0.0.1"


@dataclass(frozen=True)
class WifiChannel:
    """Quality of the network."""

    soonest: float = 0.002  # s under way
    latest: float = 0.010
    loss: float = 0.0  # share of datagrams
    duplicates: float = 0.0


class Air:
    """The network of some robots. Owners of a clock call `pump`."""

    def __init__(self, robots: int, arcade: int, channel: WifiChannel, seed: int) -> None:
        self.channel, self.arcade = channel, arcade
        self.dead = False  # True: nothing gets through
        self.extra_loss = 0.0
        self.mute: set[int] = set()  # robots whose datagrams get lost
        self.robots: Sequence[int] = []  # UDP ports of the boards, to be set before the first `pump`
        self.delivered = [0] * robots  # datagrams sent on to each board
        self.seen: list[tuple[int, bytes]] = []  # the newest datagrams to robots, as an eavesdropper records them
        self._to_arcade, self._to_robot = [_udp() for _ in range(robots)], [_udp() for _ in range(robots)]
        self._random = Random(f"air {seed}")
        self._events: list[tuple[float, int, bool, int, bytes]] = []  # s, order, towards a robot, robot, datagram
        self._order = 0

    def port(self, robot: int) -> int:
        """The UDP port at which a robot finds the arcade."""
        return int(self._to_robot[robot].getsockname()[1])

    def address(self, robot: int) -> tuple[str, int]:
        """The address at which the arcade finds a robot."""
        return LOOPBACK, int(self._to_arcade[robot].getsockname()[1])

    def pump(self, now: float) -> None:
        """Take in what was sent and deliver what is due at `now`, s."""
        for robot, (to_arcade, to_robot) in enumerate(zip(self._to_arcade, self._to_robot, strict=True)):
            for datagram in _received(to_arcade):
                self.seen = [*self.seen[-99:], (robot, datagram)]
                self._carry(datagram, robot, True, now)
            for datagram in _received(to_robot):
                if robot not in self.mute:
                    self._carry(datagram, robot, False, now)
        while self._events and self._events[0][0] <= now:
            _, _, down, robot, datagram = heappop(self._events)
            if down:
                self.delivered[robot] += 1
                self._to_robot[robot].sendto(datagram, (LOOPBACK, self.robots[robot]))
            else:
                self._to_arcade[robot].sendto(datagram, (LOOPBACK, self.arcade))

    def inject(self, robot: int, datagram: bytes) -> None:
        """Send a datagram of a stranger to a robot, from the arcade's own address."""
        self.delivered[robot] += 1
        self._to_robot[robot].sendto(datagram, (LOOPBACK, self.robots[robot]))

    def close(self) -> None:
        """Close all sockets. Idempotent."""
        for end in (*self._to_arcade, *self._to_robot):
            end.close()

    def _carry(self, datagram: bytes, robot: int, down: bool, now: float) -> None:
        channel, random = self.channel, self._random
        if self.dead or random.random() < channel.loss + self.extra_loss:
            return
        for _ in range(2 if random.random() < channel.duplicates else 1):
            self._order += 1
            due = now + random.uniform(channel.soonest, channel.latest)
            heappush(self._events, (due, self._order, down, robot, datagram))


def _udp() -> socket.socket:
    end = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    end.bind((LOOPBACK, 0))
    end.setblocking(False)
    return end


def _received(end: socket.socket) -> list[bytes]:
    """The datagrams that have arrived at a socket."""
    found = []
    with suppress(BlockingIOError):
        while True:
            found.append(end.recv(512))
    return found
