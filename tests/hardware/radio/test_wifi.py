"""The network of Wi-Fi robots, against robots made of a socket, on loopback."""

import errno
import socket
from random import Random

import pytest

from pigaming_app.hardware.radio.envelope import DRIVE, REPORT, Announcement, announce, seal, unseal
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.radio.packets import VERSION, RobotReport
from pigaming_app.hardware.radio.wifi import GONE, MOST, SILENT, WifiNetwork, WifiProtocol
from pigaming_app.hardware.signals import WheelCommand
from tests.hardware.sentences import key_of
from tests.hardware.wire import report_packet

ARENA, KEY = 77, bytes(range(16))
GO = WheelCommand(0.5, 0.5)


class Robot:
    """A robot on the network: announces itself, answers every drive packet by a report."""

    def __init__(self, network, address=1, arena=ARENA, key=KEY, nonce=b"ABCDEFGH"):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(0.0)
        self.to, self.key = ("127.0.0.1", network.bound), key
        self.about = Announcement(arena, address, 1, 2, nonce, 0, 5000, 1, f"R{address}")
        self.sent, self.obeyed, self.last = 0, [], None

    def reboot(self, nonce):
        self.about, self.sent = self.about._replace(nonce=nonce, counter=0), 0

    def announce(self):
        self.sent += 1
        self.send(announce(self.key, self.sent, self.about))

    def send(self, datagram):
        self.last = datagram
        self.socket.sendto(datagram, self.to)

    def receive(self):
        """Take in all drive packets; those with the right code count."""
        while True:
            try:
                datagram = self.socket.recv(256)
            except BlockingIOError:
                return
            opened = unseal(self.key, self.about.nonce, DRIVE, datagram)
            if opened is not None and opened[0] > self.about.counter:
                self.about = self.about._replace(counter=opened[0])
                self.obeyed.append(opened[1])

    def answer(self, flags=0):
        self.receive()
        self.report(flags)

    def report(self, flags=0):
        self.sent += 1
        seq = self.obeyed[-1][3] if self.obeyed else 0
        about = self.about
        packet = report_packet(RobotReport(about.arena, about.address, VERSION, seq, flags, 5000))
        self.send(seal(self.key, self.about.nonce, REPORT, self.sent, packet))


class Site:
    """A network with a link on a clock of its own, and the robots on it."""

    def __init__(self):
        self.now, self.robots = 100.0, []
        self.network = WifiNetwork(ARENA, KEY, lambda: self.now, port=0, host="127.0.0.1").open()
        self.link = Link(self.network.open, lambda: self.now, WifiProtocol(self.network), "Wi-Fi")
        self.link.pump()

    def add(self, **about):
        self.robots.append(Robot(self.network, **about))
        return self.robots[-1]

    def meet(self, **about):
        """Add a robot that has announced itself."""
        robot = self.add(**about)
        robot.announce()
        self.tick()
        return robot

    def tick(self, seconds=0.02):
        self.now += seconds
        self.link.send([GO] * 4)
        self.link.pump()

    def status(self):
        return [(robot.announced.name, robot.status) for robot in self.network.robots]

    def close(self):
        self.link.close()
        for robot in self.robots:
            robot.socket.close()


@pytest.fixture
def site():
    site = Site()
    yield site
    site.close()


def test_robots_that_announce_themselves_are_driven_each_by_its_own_datagrams(site):
    one, two = site.add(address=1), site.add(address=2, nonce=b"12345678")
    for robot in (one, two):
        robot.announce()
    site.tick()
    for robot in (one, two):
        robot.answer(flags=8)
    site.tick()
    assert one.obeyed
    assert one.obeyed == two.obeyed
    assert site.status() == [("R1", "ours"), ("R2", "ours")]
    assert site.network.boards == {0: 1, 1: 1}
    assert [(found.robot, found.battery, found.flags) for found in site.link.telemetry.values()] == [
        (0, 5.0, 8),
        (1, 5.0, 8),
    ]
    assert site.link.quality(0).echo == pytest.approx(0.02)
    assert site.link.fault is None


def test_strangers_are_listed_and_never_driven(site):
    robots = [site.meet(address=1, arena=78), site.meet(address=2, arena=0), site.meet(address=3, key=KEY[::-1])]
    for robot in robots:
        robot.answer()
    site.tick()
    assert not any(robot.obeyed for robot in robots)
    assert sorted(site.status()) == [("R1", "foreign"), ("R2", "no_arena"), ("R3", "key")]
    assert [site.link.misfit(robot).reason for robot in range(3)] == ["foreign", "no_arena", "key"]
    assert not site.link.telemetry


def test_a_recorded_report_is_dropped(site):
    robot = site.meet()
    robot.answer()
    site.tick()
    heard, recorded = site.link.telemetry[0].received, robot.last
    site.add().send(recorded)
    site.tick(1.0)
    assert site.link.telemetry[0].received == heard
    assert site.network.dropped == 1


def test_a_robot_that_restarts_is_driven_again_and_its_recorded_past_is_void(site):
    robot = site.add()
    robot.announce()
    recorded = robot.last
    for _ in range(3):
        site.tick()
        robot.answer()
    site.tick()
    site.tick()
    robot.reboot(b"ABCDEFG2")
    site.tick(SILENT + 0.1)
    robot.announce()
    site.tick()
    robot.obeyed = []
    robot.receive()
    assert robot.obeyed
    robot.report()
    site.tick(1.0)
    robot.send(recorded)
    site.tick()
    robot.receive()
    robot.obeyed = []
    site.tick()
    robot.receive()
    assert robot.obeyed, "the recording has ended its session"


def test_the_recorded_announcement_of_an_earlier_start_does_not_lock_a_robot_out(site):
    robot = site.add(nonce=b"earlier.")
    robot.announce()
    recorded = robot.last
    robot.reboot(b"present.")
    for attempt in range(3):
        robot.announce()
        site.tick()
        robot.answer()
        site.tick(SILENT + 0.1)
        robot.send(recorded)
        site.tick()
        assert robot.obeyed, attempt
        robot.obeyed = []


def test_counters_go_on_where_a_killed_arcade_ended(site):
    robot = site.add()
    robot.about = robot.about._replace(counter=1000)
    robot.announce()
    site.tick()
    robot.receive()
    assert robot.obeyed


def test_a_second_robot_with_the_same_number_waits_and_takes_over_when_the_first_is_gone(site):
    one, two = site.add(), site.add(nonce=b"12345678")
    one.announce()
    site.tick()
    one.answer()
    site.tick()
    two.announce()
    site.tick()
    assert site.status() == [("R1", "ours"), ("R1", "taken")]
    assert site.link.misfit(0) is None
    site.tick(SILENT + 0.1)
    two.announce()
    site.tick()
    two.receive()
    assert two.obeyed


def test_rubbish_is_dropped(site):
    robot = site.add()
    for datagram in (b"", b"PG2", b"PG2A" + bytes(200), bytes(37), b"PG2T" + bytes(30)):
        robot.send(datagram)
    site.tick()
    assert site.network.dropped == 5
    assert not site.network.robots


def test_without_a_network_there_is_a_fault_until_it_is_back(site, monkeypatch):
    class Unreachable:
        def __init__(self, port):
            self.port = port

        def sendto(self, *_):
            raise OSError(errno.ENETUNREACH, "Network is unreachable")

        def recvfrom(self, size):
            return self.port.recvfrom(size)

        def close(self):
            self.port.close()

    site.add().announce()
    site.tick()
    port = site.network._socket
    site.network._socket = Unreachable(port)
    site.tick()
    assert site.link.fault.key == "radio_offline"
    site.network._socket = port
    site.tick()
    assert site.link.fault is None


@pytest.mark.parametrize("robots", [0, 1])
def test_a_port_in_use_is_a_fault(site, robots):
    for _ in range(robots):
        site.add().announce()
        site.tick()
    second = WifiNetwork(ARENA, KEY, lambda: 0.0, port=site.network.bound, host="127.0.0.1")
    link = Link(second.open, lambda: 0.0, WifiProtocol(second), "UDP port 47474")
    link.pump()
    assert key_of(link.fault) == "radio_busy"


def test_a_robot_whose_address_changes_is_heard_and_driven_at_the_new_one(site):
    robot = site.meet()
    robot.socket.close()
    robot.socket = site.add().socket
    robot.announce()
    site.tick()
    robot.report(flags=8)
    site.tick()
    robot.receive()
    assert site.link.telemetry[0].flags == 8
    assert robot.obeyed


def test_robots_of_this_arena_are_listed_and_driven_amid_a_hundred_strangers_that_announce_themselves(site):
    flood = [site.add(address=1 + i % 4, arena=78, nonce=b"%08d" % i) for i in range(100)]
    ours, other = site.add(address=2), site.add(address=3, key=KEY[::-1])
    for robots in (flood[:80], [ours, other], flood[80:]):
        for robot in robots:
            robot.announce()
        for _ in range(3):
            site.tick()
    ours.receive()
    assert ours.obeyed
    assert site.status()[0] == ("R2", "ours")
    assert ("R3", "key") in site.status()
    assert len(site.status()) == 1 + MOST


def test_strangers_that_have_gone_make_room_for_others(site):
    for i in range(MOST + 1):
        site.add(arena=78, nonce=b"%08d" % i).announce()
    for _ in range(3):
        site.tick()
    site.tick(GONE + 1.0)
    site.add(address=4, arena=0).announce()
    site.tick()
    assert site.status() == [("R4", "no_arena")]


def test_no_datagram_of_a_stranger_disturbs_the_link_or_what_robots_obey(site):
    """Of every length and kind, and everything that a robot and the arcade have sent, damaged."""
    chance = Random(1)
    robot = site.meet()
    recorded = [robot.last, robot.socket.recv(256)]
    robot.report()
    recorded.append(robot.last)
    stranger = site.add(address=4, arena=78)
    for size in [*range(0, 80), 255, 256, 257, 1500, 60000]:
        for kind in (b"PG2A", b"PG2D", b"PG2T", b"\0\0\0\0"):
            stranger.send((kind + chance.randbytes(max(0, size - 4)))[:size])
    for datagram in recorded:
        for place in range(len(datagram)):
            stranger.send(datagram[:place] + bytes([datagram[place] ^ 1 << place % 8]) + datagram[place + 1 :])
            stranger.send(datagram[:place])
    robot.obeyed = []
    for _ in range(12):
        site.tick()
        robot.receive()
    assert len(robot.obeyed) == 12
    assert [status for _, status in site.status() if status == "ours"] == ["ours"]
    assert site.link.fault is None
    assert list(site.link.telemetry) == [0]


@pytest.mark.parametrize("counter", [2**64 - 2, 2**64 - 1])
def test_a_robot_at_the_end_of_its_counter_does_not_end_the_link(site, counter):
    robot, other = site.add(), site.add(address=2, nonce=b"12345678")
    robot.about = robot.about._replace(counter=counter)
    for one in (robot, other):
        one.announce()
    for _ in range(5):
        site.tick()
    other.receive()
    assert len(other.obeyed) == 5
    assert site.link.fault is None


@pytest.mark.parametrize("address", [0, 5, 255])
def test_a_robot_with_a_number_that_no_robot_has_is_listed_only(site, address):
    robot = site.meet(address=address)
    site.tick()
    robot.receive()
    assert not robot.obeyed
    assert site.status() == [(f"R{address}", "number")]
    assert not any(site.link.misfit(robot) for robot in range(4))
