"""The programs of the micro:bits, on emulated boards and radio, driven by the arcade's own link in transparent mode.

Skipped without Node.js and npm.
"""

import pytest

from pigaming_app.hardware.commissioning.boards.microbit import END_RELAY
from pigaming_app.hardware.emulator.wifi.boards import MicrobitConfig
from pigaming_app.hardware.emulator.wifi.relay import MicrobitAir
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.radio.packets import PARKED, RESTARTED, drive_packet
from pigaming_app.hardware.radio.xbee_protocol import XBeeMode, XBeeProtocol
from pigaming_app.hardware.signals import WheelCommand

pytestmark = [pytest.mark.long, pytest.mark.usefixtures("micropython")]
ARENA = 4711
CHANNEL = bytes([ARENA % 84, ARENA // 84])  # and group of the radio
GO = [WheelCommand(1.0, -0.5), WheelCommand(-1.0, 0.5)]
SHARES = [(1.0, -32 / 63), (-1.0, 32 / 63)]
STEP = 0.002  # s


class Air(MicrobitAir):
    """Two robots."""

    def __init__(self, robot):
        super().__init__(2, ARENA, kind=robot)

    def run(self, seconds, link=None):
        for _ in range(round(seconds / STEP)):
            if link:
                link.pump()
            self.advance(STEP)

    def moves(self, packet):
        """True if a message by radio sets robot 1 in motion; it stands again after."""
        assert not any(self.boards.motors(1))
        self.put(1, CHANNEL + packet)
        self.run(0.004)
        moving = any(self.boards.motors(1))
        self.run(0.22)
        return moving


def cutebot(number, arena):
    return MicrobitConfig(number, arena, "cutebot")


def maqueen(number, arena):
    return MicrobitConfig(number, arena, "maqueen")


class WithDivider(MicrobitConfig):
    """A robot that measures its battery at pin 2."""

    def files(self):
        text = super().files()["main.py"]
        return {"main.py": text.replace(b"BATTERY = None", b"BATTERY = pin2").replace(b"pin16, r", b"pin16, pin2, r")}


@pytest.fixture
def air(request):
    air = Air(getattr(request, "param", MicrobitConfig))
    yield air
    air.end()


@pytest.fixture
def link(air):
    air.run(0.1)
    return Link(air.open, air.clock, XBeeProtocol(ARENA, XBeeMode.TRANSPARENT))


def drive(air, link, seconds):
    for _ in range(round(seconds / 0.02)):
        link.send(GO)
        air.run(0.02, link)


def test_the_arcade_drives_robots_through_the_relay_and_the_deadman_stops_them(air, link):
    drive(air, link, 0.1)
    drive(air, link, 3.0)
    for robot in (0, 1):
        assert air.boards.motors(robot + 1) == pytest.approx(SHARES[robot], abs=2e-3)
        assert link.quality(robot).share >= 0.9
        assert link.telemetry[robot].flags == 0
        assert link.telemetry[robot].battery == 0.0, "no divider"
        assert link.quality(robot).echo <= 0.05
    assert link.fault is None
    air.dead, began = True, air.now
    drive(air, link, 0.4)
    for robot in (0, 1):
        assert air.boards.motors(robot + 1) == (0.0, 0.0)
        assert air.boards.powered_until[robot + 1] - began <= 0.25
    air.dead = False
    drive(air, link, 0.1)
    assert any(air.boards.motors(1))
    began = air.now
    air.run(0.3)  # without the arcade
    assert air.boards.motors(1) == (0.0, 0.0)
    assert air.boards.powered_until[1] - began <= 0.25
    drive(air, link, 0.1)
    link.close()
    air.run(0.02)
    assert air.boards.motors(1) == (0.0, 0.0), "a stop by the link"


@pytest.mark.parametrize("air", [cutebot, maqueen], indirect=True)
def test_a_bought_chassis_obeys_and_its_motors_which_keep_their_speed_stop_in_time(air, link):
    """The chip runs on when the program hangs: until the watchdog has restarted it, and its first act is to brake."""
    drive(air, link, 0.5)
    for robot in (0, 1):
        assert air.boards.motors(robot + 1) == pytest.approx(SHARES[robot], abs=1.1e-2)
    assert link.telemetry[0].flags == 0
    for hang, most in ((None, 0.25), ("error", 0.01), ("hang loop", 0.25), ("hang board", 0.52)):
        drive(air, link, 0.6)
        assert any(air.boards.motors(1)), hang
        began = air.now
        if hang is None:
            air.run(0.6)
        else:
            air.boards.disturb(1, do=hang)
            drive(air, link, 0.6)
        assert 0.0 <= air.boards.powered_until[1] - began <= most, hang
    drive(air, link, 0.6)
    assert link.telemetry[0].flags == RESTARTED


def test_nothing_corrupt_repeated_or_of_another_arena_moves_a_motor(air):
    air.run(0.1)
    genuine = drive_packet(ARENA, 3, GO)
    assert air.moves(genuine)
    assert not air.moves(genuine), "repeated"
    for place in range(len(genuine)):
        for bit in (1, 64):
            broken = bytearray(drive_packet(ARENA, 4, GO))
            broken[place] ^= bit
            assert not air.moves(bytes(broken)), place
    assert not air.moves(drive_packet(ARENA + 1, 5, GO))
    assert not air.moves(drive_packet(ARENA, 6, GO)[:-1])
    assert not air.moves(drive_packet(ARENA, 7, GO) + b"\0")
    assert not air.moves(drive_packet(ARENA, 8, [None, *GO])), "not enabled"
    assert air.moves(drive_packet(ARENA, 9, GO))


def test_a_repeated_packet_does_not_feed_the_deadman(air):
    air.run(0.1)
    for _ in range(20):
        air.put(1, CHANNEL + drive_packet(ARENA, 1, GO))
        air.run(0.02)
    assert 0.2 <= air.boards.powered_until[1] - 0.1 <= 0.22


def test_the_relay_passes_on_whole_packets_only_and_no_byte_interrupts_it(air):
    air.run(0.1)
    packets = [drive_packet(ARENA, seq, GO) for seq in range(128)]
    air.put(0, b"\x03\x04\r\n\xd1\x03" + packets[0][:9], b"usb")
    for packet in packets:
        air.put(0, packet[:5], b"usb")
        air.run(0.004)
        air.put(0, packet[5:], b"usb")
        air.run(0.004)
    assert air.aired == [CHANNEL + packet for packet in packets]


def test_bytes_03_without_a_head_end_the_relay_and_none_of_a_stream_of_packets_do(air):
    """A robot that runs backwards has 03 in its packets; even if every second head is lost, the relay goes on."""
    air.run(0.1)
    slow = bytes([0xD1]) + 17 * b"\3"
    for _ in range(6):
        air.put(0, slow + slow[1:], b"usb")
        air.run(0.01)
    later = drive_packet(ARENA, 9, GO)
    air.put(0, later, b"usb")
    air.run(0.01)
    assert air.aired[-1] == CHANNEL + later
    air.put(0, END_RELAY, b"usb")
    air.run(0.05)
    before = len(air.aired)
    air.put(0, drive_packet(ARENA, 1, GO), b"usb")
    air.run(0.05)
    assert len(air.aired) == before


def test_ctrl_c_before_the_first_command_leaves_the_prompt_to_usb(air, link):
    """The chip's watchdog, which nothing stops, would restart the program amid a set-up."""
    air.boards.disturb(1, do="interrupt")
    air.run(2.0)
    assert not air.boards.resets
    air.boards.disturb(2, do="hang board")
    air.run(2.0)
    assert not air.boards.resets


def test_the_button_parks_a_robot_until_it_is_pressed_again(air, link):
    for press, moving in ((0, True), (1, False), (0, False), (1, True)):
        air.boards.disturb(1, button=press)
        drive(air, link, 0.3)
        assert any(air.boards.motors(1)) is moving
        assert bool(link.telemetry[0].flags & PARKED) is not moving
        assert any(air.boards.motors(2))


def test_an_error_stops_at_once_the_timer_a_hanging_program_and_the_watchdog_a_hanging_chip(air, link):
    for hang, most in (("error", 0.01), ("hang loop", 0.25), ("hang board", 0.52)):
        drive(air, link, 0.3)
        assert any(air.boards.motors(1))
        air.boards.disturb(1, do=hang)
        began = air.now
        drive(air, link, 0.6)
        assert air.boards.powered_until[1] - began <= most
        assert (1, 3) in air.boards.resets
        air.boards.resets.clear()
        drive(air, link, 0.6)
        assert link.telemetry[0].flags == RESTARTED


@pytest.mark.parametrize("air", [WithDivider], indirect=True)
def test_an_empty_battery_brakes_until_it_has_recovered(air, link):
    for millivolts, moving in ((4500, True), (4300, False), (4500, False), (4700, True)):
        air.boards.disturb(1, battery=millivolts)
        drive(air, link, 0.8)
        assert any(air.boards.motors(1)) is moving, millivolts
        assert link.telemetry[0].battery == pytest.approx(millivolts / 1000, abs=0.02)
