"""The robots' own program in MicroPython, on emulated boards in time of their own; skipped without Node.js and npm."""

import socket

import pytest

from pigaming_app.hardware.radio.envelope import REPORT
from pigaming_app.hardware.radio.packets import DEADMAN, PARKED, RESTARTED, drive_packet, report_from, with_crc
from tests.hardware.emulator.one_board import ARENA, ON

pytestmark = pytest.mark.long


def test_a_command_drives_the_motors_until_the_deadman_stops_them(arcade):
    about = arcade.meet()
    assert about[:5] == (ARENA, 1, 1, 2, arcade.nonce)
    assert about[5:] == (0, pytest.approx(5200, abs=5), DEADMAN, "Ruby")
    for _ in range(20):
        arcade.send(arcade.sealed())
        arcade.run(0.02)
        assert arcade.motors == pytest.approx(ON, abs=1e-3)
    sent = arcade.now - 0.02
    arcade.run(0.3)
    assert arcade.motors == (0.0, 0.0)
    assert 0.200 <= arcade.boards.powered_until[0] - sent <= 0.216
    reports = arcade.reports()
    assert [counter for counter, _ in reports] == sorted({counter for counter, _ in reports})
    assert len(reports) in (3, 4, 5)
    first, last = (report_from(body) for _, body in (reports[0], reports[-1]))
    assert all(with_crc(body[:-5]) == body for _, body in reports)
    assert (first.arena, first.address, first.version, first.flags) == (ARENA, 1, 2, 0)
    assert (last.seq, last.flags) == (20, DEADMAN)


def test_nothing_forged_repeated_or_meant_for_others_moves_a_motor(arcade):
    arcade.meet()
    genuine = arcade.sealed()
    assert arcade.moves(genuine)
    assert not arcade.moves(genuine), "a recording"
    for place in (0, 3, 4, 11, 12, 13, 16, 17, 29, 30, 37):
        broken = bytearray(arcade.sealed())
        broken[place] ^= 1
        assert not arcade.moves(bytes(broken)), place
    assert not arcade.moves(arcade.sealed(key=bytes(16)))
    assert not arcade.moves(arcade.sealed(nonce=bytes(8)))
    assert not arcade.moves(arcade.sealed(kind=REPORT))
    assert not arcade.moves(arcade.sealed(counter=0))
    assert not arcade.moves(arcade.sealed(arcade.packet(arena=ARENA + 1)))
    assert not arcade.moves(arcade.sealed(drive_packet(ARENA, arcade.seq - 1, [None] * 4)))
    assert not arcade.moves(arcade.packet()), "without an envelope"
    assert not arcade.moves(b"PG2D")
    packet = arcade.packet()
    assert arcade.moves(arcade.sealed(packet))
    assert not arcade.moves(arcade.sealed(packet)), "the same sequence number"


def test_a_recording_of_before_a_restart_is_void_and_the_robot_has_a_new_nonce(arcade):
    arcade.meet()
    unsent, before = arcade.sealed(counter=1 << 40), arcade.nonce
    arcade.boards.disturb(0, do="reboot")
    arcade.meet()
    assert arcade.nonce != before
    assert not arcade.moves(unsent)
    assert arcade.moves(arcade.sealed())


def test_another_sender_with_the_same_key_waits_for_the_deadman(arcade):
    arcade.meet()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as second:
        second.bind(("127.0.0.1", 0))
        arcade.send(arcade.sealed())
        arcade.run(0.05)
        stop = arcade.sealed(drive_packet(ARENA, 99, []))
        arcade.send(stop, second)
        arcade.run(0.02)
        assert any(arcade.motors)
        arcade.run(0.3)
        assert arcade.moves(arcade.sealed(), second)


def test_a_hanging_main_loop_is_stopped_by_the_timer_and_restarted_by_the_watchdog(arcade):
    arcade.meet()
    arcade.drive(0.02)
    began = arcade.now
    arcade.boards.disturb(0, do="hang loop")
    arcade.run(0.3)
    assert arcade.motors == (0.0, 0.0)
    assert arcade.boards.powered_until[0] - began <= 0.216
    arcade.run(1.0)
    assert arcade.boards.resets == [(0, 3)]
    arcade.run(1.0)
    assert arcade.meet().flags == DEADMAN | RESTARTED


def test_a_hanging_chip_is_restarted_by_the_watchdog(arcade):
    arcade.meet()
    arcade.drive(0.02)
    arcade.boards.disturb(0, do="hang board")
    arcade.run(1.1)
    assert arcade.boards.resets == [(0, 3)]
    assert arcade.motors == (0.0, 0.0)


@pytest.mark.parametrize("arcade", [{"board": "board_pololu_2040", "radio": "serial_radio"}], indirect=True)
def test_a_robot_with_an_xbee_obeys_bare_packets_after_noise(arcade):
    arcade.run(0.3)
    arcade.send(b"\x01\xd1\x02\xff")
    arcade.send(arcade.packet()[:9])
    for _ in range(20):
        arcade.send(arcade.packet())
        arcade.run(0.02)
        assert arcade.motors == pytest.approx(ON, abs=1e-3)
    assert [report_from(found).flags for found in arcade.received(b"\xd5")] == [0, 0, 0]
    arcade.run(0.3)
    assert arcade.motors == (0.0, 0.0)


def test_an_empty_battery_brakes_until_it_has_recovered(arcade):
    arcade.meet()
    for millivolts, moving in ((4300, True), (3900, False), (4300, False), (4500, True)):
        arcade.boards.disturb(0, battery=millivolts)
        for _ in range(40):
            arcade.drive(0.02)
        assert any(arcade.motors) is moving, millivolts


@pytest.mark.parametrize("arcade", [{"board": "board_esp32"}, {"board": "board_pico_w"}], indirect=True)
def test_the_button_stops_a_robot_until_it_is_pressed_again(arcade):
    arcade.meet()
    for press, moving in ((0, True), (1, False), (0, False), (1, True)):
        arcade.boards.disturb(0, button=press)
        for _ in range(20):
            arcade.drive(0.02)
        assert any(arcade.motors) is moving
        _, body = arcade.reports()[-1]
        assert bool(report_from(body).flags & PARKED) is not moving
