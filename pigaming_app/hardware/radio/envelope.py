"""Datagrams between the arcade and Wi-Fi robots: our packets with a counter and a message code.

    PG2, kind (1 byte), counter (8 bytes, high first), body, code (8 bytes)

The code is the start of HMAC-SHA-256, by the key of the arena, over the robot's nonce and all bytes before it. A robot
draws its nonce at every start, so nothing recorded before is valid after. The counter of each direction only grows.
"""

import hmac
import struct
from typing import NamedTuple

MAGIC = b"PG2"
DRIVE, REPORT, ANNOUNCE = b"D", b"T", b"A"  # kinds: arcade to robot, robot to arcade, robot to everybody
UPDATE, ANSWER = b"U", b"V"  # arcade to a robot that stands, and back: see firmware/micropython/update.py
NONCE, CODE, HEAD = 8, 8, 12  # bytes
FIELDS = struct.Struct(">HBBB8sQHB")  # of an announcement, see there; the name follows
NAME = 16  # bytes, at most
LAST_COUNTER = (1 << 64) - 1  # after it only a restart of the robot helps


class Announcement(NamedTuple):
    """Body of an ANNOUNCE datagram."""

    arena: int
    address: int  # 1 to 4
    board: int  # kind of robot, see robot_kinds
    version: int  # of the firmware
    nonce: bytes
    counter: int  # of the newest DRIVE that the robot has accepted
    millivolts: int  # 0: not measured
    flags: int  # see packets.RobotReport
    name: str


def seal(key: bytes, nonce: bytes, kind: bytes, counter: int, body: bytes) -> bytes:
    """The datagram."""
    data = MAGIC + kind + counter.to_bytes(8, "big") + body
    return data + _code(key, nonce, data)


def unseal(key: bytes, nonce: bytes, kind: bytes, datagram: bytes) -> tuple[int, bytes] | None:
    """Counter and body of a datagram of this kind; None if it is another one or its code is wrong."""
    data, code = datagram[:-CODE], datagram[-CODE:]
    if len(data) < HEAD or data[:4] != MAGIC + kind or not hmac.compare_digest(_code(key, nonce, data), code):
        return None
    return int.from_bytes(data[4:HEAD], "big"), data[HEAD:]


def announcement_from(datagram: bytes) -> Announcement | None:
    """The announcement in a datagram whose code is not checked yet; None if it is none."""
    body = datagram[HEAD:-CODE]
    if datagram[:4] != MAGIC + ANNOUNCE or not FIELDS.size <= len(body) <= FIELDS.size + NAME:
        return None
    name = body[FIELDS.size :].decode("utf-8", "ignore")  # a robot may have cut it within a letter
    shown = "".join(letter for letter in name if letter.isprintable())
    arena, address, board, version, nonce, counter, millivolts, flags = FIELDS.unpack_from(body)
    return Announcement(arena, address, board, version, nonce, counter, millivolts, flags, shown)


def announce(key: bytes, counter: int, robot: Announcement) -> bytes:
    """The datagram of an announcement."""
    body = FIELDS.pack(*robot[:-1]) + robot.name.encode()[:NAME]
    return seal(key, robot.nonce, ANNOUNCE, counter, body)


def _code(key: bytes, nonce: bytes, data: bytes) -> bytes:
    return hmac.digest(key, nonce + data, "sha256")[:CODE]
