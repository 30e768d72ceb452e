"""Packets of the robots: reference bytes, round trips, and corrupt ones that nobody takes."""

from zlib import crc32

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pigaming_app.hardware.radio import packets
from pigaming_app.hardware.radio.packets import LAST_ARENA, VERSION, PacketDecoder, RobotReport
from pigaming_app.hardware.signals import WheelCommand
from tests.hardware.corruption import GOOD, corrupt_packets, corrupted
from tests.hardware.wire import ARENA, Drive, drive_from, heard, old_report, report_packet

AHEAD = WheelCommand(1.0, 1.0)
speeds = st.integers(-63, 63).map(lambda step: step / 63)
crews = st.lists(st.none() | st.builds(WheelCommand, speeds, speeds), min_size=4, max_size=4)
arenas = st.integers(1, LAST_ARENA)
codes = st.integers(0, 127)
reports = st.builds(
    RobotReport, st.integers(0, LAST_ARENA), st.integers(1, 4), codes, codes, codes, st.integers(0, 16383)
)


def test_the_checks_are_those_of_the_catalogue():
    assert packets.crc8(b"123456789") == 0xF4  # CRC-8/SMBUS, its published check value
    assert packets.with_crc(b"123456789")[9:] == packets.in_7_bits(0xCBF43926, 5)  # CRC-32/ISO-HDLC


def test_a_drive_packet_by_hand():
    """Robot 0 at full speed, robot 1 disabled, robot 2 spins at a third of full speed, robot 3 stands."""
    crew = [AHEAD, None, WheelCommand(-1 / 3, 1 / 3), WheelCommand(0.0, 0.0)]
    packet = packets.drive_packet(4711, 5, crew)  # 4711 is 36 * 128 + 103
    assert packet[:-5].hex(" ") == "d1 67 24 05 0d 7e 7e 3f 3f 2a 54 3f 3f"
    assert packets.from_7_bits(packet[-5:]) == crc32(packet[:-5])
    assert len(packet) == 18


def test_speeds_beyond_full_are_cut_and_what_is_no_number_stops():
    crew = [WheelCommand(7.0, -7.0), WheelCommand(float("nan"), 1.0)]
    (packet,) = PacketDecoder().feed(packets.drive_packet(ARENA, 0, crew))
    assert drive_from(packet).wheels == (WheelCommand(1.0, -1.0), WheelCommand(0.0, 1.0), None, None)


def test_there_is_no_room_for_a_fifth_robot_nor_for_an_arena_without_an_id():
    with pytest.raises(ValueError, match="room for 4"):
        packets.drive_packet(ARENA, 0, [None] * 5)
    for arena in (0, LAST_ARENA + 1):
        with pytest.raises(ValueError, match="1 to 16383"):
            packets.drive_packet(arena, 0, [])


@given(arenas, codes, crews)
def test_what_robots_are_told_comes_back(arena, seq, crew):
    packet = packets.drive_packet(arena, seq, crew)
    assert all(byte < 0x80 for byte in packet[1:])
    (found,) = PacketDecoder().feed(packet)
    assert drive_from(found) == Drive(arena, seq, tuple(crew))


@given(reports)
def test_what_a_robot_says_comes_back(report):
    (found,) = PacketDecoder().feed(report_packet(report))
    assert packets.report_from(found) == report


@given(st.binary(max_size=60), crews, reports, st.lists(st.integers(1, 9), max_size=20))
def test_after_any_noise_our_packets_are_found(noise, crew, report, sizes):
    """One packet may be lost to noise that promised one; the byte from 80 on of the next begins anew."""
    decoder = PacketDecoder()
    good = [packets.drive_packet(ARENA, 3, crew), report_packet(report), old_report(2)]
    assert heard(decoder, noise + b"".join(good), sizes)[-3:] == good
    assert decoder.garbage <= len(noise)


@given(st.binary(max_size=400))
def test_noise_never_raises_and_is_never_kept(noise):
    decoder = PacketDecoder()
    decoder.feed(noise)
    assert len(decoder._buffer) < 18


def accepted(count, seed=1):
    """Of so many corrupt reports and drive packets, those that a decoder accepts as one of both."""
    decoder = PacketDecoder()
    reports = [report_packet(RobotReport(ARENA, 1 + i % 4, VERSION, i % 128, 0, 16 * i)) for i in range(GOOD)]
    broken = [*corrupted(reports, count // 2, seed), *corrupt_packets(count // 2, seed)]
    found = decoder.feed(b"\x80".join(packet.tobytes() for packet in broken))
    return sum(packet[0] != packets.OLD_REPORT for packet in found)


def test_no_corrupt_packet_is_accepted():
    assert accepted(3000) == 0


@pytest.mark.again  # through the robots: emulator/test_radio.py
@pytest.mark.long
def test_of_three_million_corrupt_packets_none_is_accepted():
    assert sum(accepted(100_000, seed) for seed in range(30)) == 0
