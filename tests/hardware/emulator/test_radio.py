"""The emulated radio follows the packet protocol, with delays and losses as configured."""

import pytest

from pigaming_app.hardware.emulator.arena import ARENA_ID, EmulatedArena
from pigaming_app.hardware.emulator.firmware import check
from pigaming_app.hardware.emulator.radio import API, TRANSPARENT, RadioChannel
from pigaming_app.hardware.emulator.xbee import FrameReceiver, framed

GOLDEN_ESCAPED = bytes.fromhex("7E 00 09 01 01 00 01 00 50 07 7D 31 7D 5E 16")


def drive(seq, *speeds, enable=0b1111, arena=ARENA_ID):
    """A drive packet, assembled by hand."""
    packet = bytes([0xD1, arena % 128, arena // 128, seq, enable, *speeds])
    return packet + check(packet)


def broadcast(packet, escaped=True, number=1):
    return framed(bytes([0x01, number, 0xFF, 0xFF, 0]) + packet, escaped)


FORWARD = drive(0, *[83] * 8)


def received(arena, escaped=True):
    """All frames received from the radio."""
    receiver = FrameReceiver(escaped)
    return [frame for frame in (receiver.feed(byte) for byte in arena.radio.read(10000)) if frame]


def test_a_wrong_checksum_is_refused_and_the_next_frame_heard():
    receiver = FrameReceiver(True)
    broken = GOLDEN_ESCAPED[:-1] + b"\x17"
    assert [frame for frame in map(receiver.feed, broken + GOLDEN_ESCAPED) if frame]
    assert receiver.broken == 1


@pytest.mark.parametrize("mode", [TRANSPARENT, API, 2])
def test_a_broadcast_moves_all_robots_after_its_time_on_the_line(mode):
    arena = EmulatedArena(1, channel=RadioChannel(mode=mode))
    arena.radio.write(FORWARD if mode == TRANSPARENT else broadcast(FORWARD, mode == 2))
    arena.advance(0.004)
    assert all(firmware.stopped for firmware in arena.firmwares)
    arena.advance(0.016)
    assert all(robot.left == pytest.approx(20 / 63) for robot in arena.robots)


def test_a_robot_that_is_not_enabled_stands():
    arena = EmulatedArena(1)
    arena.radio.write(broadcast(drive(0, *[83] * 8, enable=0b0100)))
    arena.advance(0.05)
    assert [firmware.stopped for firmware in arena.firmwares] == [True, True, False, True]


def test_telemetry_comes_five_times_a_second_from_each():
    arena = EmulatedArena(1)
    arena.advance(1.0)
    reports = [frame for frame in received(arena) if frame[0] == 0x81]
    assert [sum(frame[2] == address for frame in reports) for address in (1, 2, 3, 4)] == [5] * 4
    report = reports[0][5:]
    assert report[:5] == bytes([0xD5, ARENA_ID % 128, ARENA_ID // 128, 1, 2])
    assert 5000 <= report[7] + 128 * report[8] <= 5300
    assert report[6] == 1, "it says that its deadman stopped it"
    assert report[9:] == check(report[:9])


def test_status_of_what_was_sent_and_settings_that_were_asked_for():
    arena = EmulatedArena(1, channel=RadioChannel(loss=1.0))
    arena.radio.write(framed(bytes([0x01, 9, 0, 1, 0]) + FORWARD, True))
    arena.radio.write(broadcast(FORWARD, number=10))
    arena.radio.write(framed(b"\x08\x05AP", True))
    arena.advance(0.05)
    answers = received(arena)
    assert bytes([0x89, 9, 1]) in answers, "no robot acknowledged it"
    assert bytes([0x89, 10, 0]) in answers, "a broadcast is never acknowledged"
    assert b"\x88\x05AP\x00\x02" in answers


def test_a_lossy_air_loses_its_share():
    arena = EmulatedArena(3, channel=RadioChannel(loss=0.2, duplicates=0.1, broken=0.1))
    for i in range(250):
        arena.radio.write(broadcast(drive(i % 128, *[83] * 8)))
        arena.advance(0.02)
    heard_by = [firmware.packets for firmware in arena.firmwares]
    assert all(165 < packets < 225 for packets in heard_by), heard_by
    assert all(firmware.rejected for firmware in arena.firmwares)


def test_an_unplugged_radio_raises_as_a_port_does():
    arena = EmulatedArena(1)
    arena.faults.switch("radio_unplugged", True)
    for use in (lambda: arena.radio.read(), lambda: arena.radio.write(b"x"), lambda: arena.radio.in_waiting):
        with pytest.raises(OSError, match="disconnected"):
            use()
    with pytest.raises(FileNotFoundError):
        arena.radio.open()
    arena.faults.switch("radio_unplugged", False)
    assert arena.radio.open().write(b"x") == 1
