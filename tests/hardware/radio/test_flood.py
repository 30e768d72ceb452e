"""A flood of strangers' datagrams, from another process: reports stay fresh, and commands and stops arrive."""

import subprocess
import sys
import time
from types import SimpleNamespace

import pytest

from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.radio.packets import LENGTHS, REPORT
from pigaming_app.hardware.radio.wifi import WifiNetwork, WifiProtocol
from pigaming_app.hardware.signals import WheelCommand
from tests.hardware.radio.test_wifi import ARENA, KEY, Robot

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
        assert int(flood.stdout.read()) > 5000, "too slow a flood proves nothing"
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
    assert network.in_waiting == LENGTHS[REPORT]
    network.close()
    for stranger in strangers:
        stranger.socket.close()
