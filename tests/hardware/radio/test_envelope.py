"""The datagrams of Wi-Fi robots, against an independent computation of their message code."""

import hashlib
import subprocess
import sys
import time
from types import SimpleNamespace

import pytest

from pigaming_app.hardware.radio import envelope
from pigaming_app.hardware.radio.envelope import ANNOUNCE, DRIVE, REPORT, Announcement, announce, seal, unseal
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.radio.packets import LENGTHS
from pigaming_app.hardware.radio.packets import REPORT as REPORT_PACKET
from pigaming_app.hardware.radio.wifi import WifiNetwork, WifiProtocol
from pigaming_app.hardware.signals import WheelCommand
from tests.hardware.radio.test_wifi import ARENA, KEY, Robot

NONCE = b"12345678"
ROBOT = Announcement(300, 2, 1, 2, NONCE, 7, 5012, 1, "Ruby é")
OTHERS = [b"", b"PG2A", announce(KEY, 1, ROBOT)[:40], seal(KEY, NONCE, REPORT, 1, bytes(40))]


def by_hand(key, message):
    """HMAC-SHA-256 by its definition (RFC 2104)."""
    padded = key + bytes(64 - len(key))
    inner = hashlib.sha256(bytes(byte ^ 0x36 for byte in padded) + message).digest()
    return hashlib.sha256(bytes(byte ^ 0x5C for byte in padded) + inner).digest()


def test_a_datagram_has_a_counter_and_the_start_of_an_hmac_over_nonce_and_bytes():
    datagram = seal(KEY, NONCE, DRIVE, 258, b"body")
    assert datagram[:-8] == b"PG2D" + bytes((0, 0, 0, 0, 0, 0, 1, 2)) + b"body"
    assert datagram[-8:] == by_hand(KEY, NONCE + datagram[:-8])[:8]
    assert unseal(KEY, NONCE, DRIVE, datagram) == (258, b"body")


def test_no_flipped_bit_no_other_key_nonce_or_kind_is_accepted():
    datagram = seal(KEY, NONCE, DRIVE, 1, bytes(18))
    for place in range(8 * len(datagram)):
        broken = bytearray(datagram)
        broken[place // 8] ^= 1 << place % 8
        assert unseal(KEY, NONCE, DRIVE, bytes(broken)) is None
    assert unseal(KEY[::-1], NONCE, DRIVE, datagram) is None
    assert unseal(KEY, NONCE[::-1], DRIVE, datagram) is None
    assert unseal(KEY, NONCE, REPORT, datagram) is None
    assert not any(unseal(KEY, NONCE, DRIVE, datagram[:length]) for length in range(len(datagram)))


def test_an_announcement_carries_the_state_of_a_robot_and_a_printable_name():
    datagram = announce(KEY, 5, ROBOT)
    assert envelope.announcement_from(datagram) == ROBOT
    assert unseal(KEY, NONCE, ANNOUNCE, datagram) is not None
    for name, kept in (("a\x1b\nb", "ab"), ("é" * 15 + "x", "é" * 8), ("x" + "é" * 15, "x" + "é" * 7)):
        assert envelope.announcement_from(announce(KEY, 5, ROBOT._replace(name=name))) == ROBOT._replace(name=kept)


@pytest.mark.parametrize("datagram", OTHERS)
def test_other_datagrams_are_no_announcement(datagram):
    assert envelope.announcement_from(datagram) is None


RATE, SECONDS = 15_000, 1.5
GO = WheelCommand(0.5, 0.5)
FLOOD = """
import socket, sys, time
port, rate, seconds = int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3])
senders = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(4)]
forged = [b"PG2T" + bytes(30), b"PG2A" + bytes(8) + b"\\0\\x4d\\1\\1\\2" + bytes(21), b"x" * 38, bytes(1400)]
begun, sent = time.monotonic(), 0
while (elapsed := time.monotonic() - begun) < seconds:
    while sent < elapsed * rate:
        senders[sent % 4].sendto(forged[sent // 4 % 4], ("127.0.0.1", port))
        sent += 1
    time.sleep(0.001)
print(sent)
"""


class Site:
    """A running link, and a robot that reports."""

    def __init__(self):
        self.network = WifiNetwork(ARENA, KEY, time.monotonic, port=0, host="127.0.0.1").open()
        self.link = Link(self.network.open, time.monotonic, WifiProtocol(self.network), "Wi-Fi").start()
        self.robot = Robot(SimpleNamespace(bound=self.network.bound))
        while 0 not in self.link.telemetry:
            self.robot.announce()
            self.robot.report()
            self.step()

    def step(self, command=GO):
        """20 ms of a match; returns the age of the newest report, s."""
        self.link.send([command])
        time.sleep(0.02)
        self.robot.receive()
        return time.monotonic() - self.link.telemetry[0].received if self.link.telemetry else 0.0


@pytest.fixture
def site():
    site = Site()
    yield site
    site.link.close()
    site.robot.socket.close()


def test_reports_are_fresh_and_commands_and_stops_arrive_in_a_flood(site):
    words = [sys.executable, "-c", FLOOD, str(site.network.bound), str(RATE), str(SECONDS)]
    ages, stops = [], []  # s: of the newest report; from an order to stop, or to go on, to the robot
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as flood:
        while flood.poll() is None:
            site.robot.report()
            for command in (GO, GO, None, None):
                ordered = time.monotonic()
                ages.append(site.step(command))
                while site.robot.obeyed[-1][4] != (command is not None):
                    ages.append(site.step(command))
                stops.append(time.monotonic() - ordered)
        assert int(flood.communicate()[0]) > 5000, "too slow a flood proves nothing"
    assert max(ages) < 0.3
    assert max(stops) < 0.3
    assert site.link.fault is None


def test_a_full_buffer_of_strangers_keeps_no_report_out(site):
    site.link.close()
    network = site.network.open()
    strangers = [Robot(SimpleNamespace(bound=network.bound)) for _ in range(3)]
    for number in range(3000):
        strangers[number % 3].send(b"PG2T" + bytes(30))
    site.robot.report()
    assert network.in_waiting == LENGTHS[REPORT_PACKET]
    network.close()
    for stranger in strangers:
        stranger.socket.close()
