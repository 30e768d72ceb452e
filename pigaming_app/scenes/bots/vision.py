"""Poses as RoboCup's Small Size League sends them: `SSL_WrapperPacket`, protocol buffers by UDP multicast.

Source: the league's `messages_robocup_ssl_{wrapper,detection,geometry}.proto`. Lengths in mm from the middle of the
field, x right, y up; angles in rad, counter-clockwise. Robots of even teams are yellow, the others blue; their numbers
are those of their seats, from 0. A ball is what the game's state has as `ball`.
"""

import socket
import struct
from math import pi
from typing import Any

from pigaming_app.sim.world import HEIGHT, WIDTH, World

GROUP, PORT = "224.5.23.2", 10006  # the league's
HOPS = 1  # not beyond the local network
GEOMETRY_EVERY = 100  # frames between two descriptions of the field
CERTAIN = 1.0
VARINT, FIXED64, BYTES, FIXED32 = 0, 1, 2, 5  # wire types


def detection(state: World, mm: float, number: int, captured: float, sent: float) -> bytes:
    """A packet with the poses of a match. `mm`: of an arena px; `number`: of the frame; times in s since the epoch."""
    frame = _varint(1, number) + _double(2, captured) + _double(3, sent) + _varint(4, 0)
    ball = getattr(state, "ball", None)
    if ball is not None and not getattr(ball, "out", 0):
        x, y = _place(ball.x, ball.y, mm)
        frame += _bytes(5, _float(1, CERTAIN) + _float(3, x) + _float(4, y) + _float(6, ball.x) + _float(7, ball.y))
    for seat, robot in enumerate(state.robots):
        if robot.present:
            frame += _bytes(7 if robot.team % 2 else 6, _robot(seat, robot, mm))
    return _bytes(1, frame)


def geometry(mm: float) -> bytes:
    """A packet with the size of the field. `mm`: of an arena px."""
    sizes = round(WIDTH * mm), round(HEIGHT * mm), 0, 0, 0  # no goal: that of a game is a matter of its own
    return _bytes(2, _bytes(1, b"".join(_varint(number, size) for number, size in enumerate(sizes, 1))))


def _robot(seat: int, robot: Any, mm: float) -> bytes:
    x, y = _place(robot.x, robot.y, mm)
    where = _float(3, x) + _float(4, y) + _float(5, _turned(robot.heading))
    return _float(1, CERTAIN) + _varint(2, seat) + where + _float(6, robot.x) + _float(7, robot.y)


def _turned(heading: float) -> float:
    """A heading counter-clockwise, from -pi to pi."""
    return (pi - heading) % (2.0 * pi) - pi


def _place(x: float, y: float, mm: float) -> tuple[float, float]:
    return (x - WIDTH / 2) * mm, (HEIGHT / 2 - y) * mm


def _key(number: int, wire: int) -> bytes:
    return bytes((number << 3 | wire,))  # numbers below 16


def _number(value: int) -> bytes:
    encoded = bytearray()
    while value > 127:
        encoded.append(value & 127 | 128)
        value >>= 7
    encoded.append(value)
    return bytes(encoded)


def _varint(number: int, value: int) -> bytes:
    return _key(number, VARINT) + _number(value)


def _double(number: int, value: float) -> bytes:
    return _key(number, FIXED64) + struct.pack("<d", value)


def _float(number: int, value: float) -> bytes:
    return _key(number, FIXED32) + struct.pack("<f", value)


def _bytes(number: int, value: bytes) -> bytes:
    return _key(number, BYTES) + _number(len(value)) + value


class VisionSender:
    """Sends frames to the group on one interface of this computer."""

    def __init__(self, address: str) -> None:
        """Raises OSError."""
        self.address = address
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, HOPS)
        self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton(address))
        self._socket.setblocking(False)
        self._frames = 0

    def send(self, state: World, mm: float, captured: float, sent: float) -> None:
        """Send the poses; what the network does not take is lost."""
        packets = [detection(state, mm, self._frames, captured, sent)]
        if self._frames % GEOMETRY_EVERY == 0:
            packets.append(geometry(mm))
        self._frames += 1
        for packet in packets:
            try:
                self._socket.sendto(packet, (GROUP, PORT))
            except OSError:
                return

    def close(self) -> None:
        self._socket.close()
