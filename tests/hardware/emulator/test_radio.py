"""The emulated radio and its robots follow the packet protocol, with delays and losses as configured.

Two arenas on one channel, repeated and corrupt packets, unusable robots.
"""

import pytest

from pigaming_app.hardware.emulator.arena import ARENA_ID, EmulatedArena
from pigaming_app.hardware.emulator.firmware import Firmware, check
from pigaming_app.hardware.emulator.radio import API, TRANSPARENT, RadioChannel
from pigaming_app.hardware.emulator.xbee import FrameReceiver, framed
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.radio.packets import EMPTY, LOW, VERSION, RobotReport, drive_packet
from pigaming_app.hardware.radio.xbee_protocol import XBeeMode, XBeeProtocol
from pigaming_app.hardware.signals import WheelCommand
from tests.cases import repeated
from tests.hardware.corruption import corrupt_packets
from tests.hardware.wire import ARENA, report_packet

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


AHEAD = WheelCommand(0.5, 0.5)


def linked(arena_id):
    """An arena and its link."""
    arena = EmulatedArena(arena_id, arena_id=arena_id)
    arena.camera.due = float("inf")
    return arena, Link(arena.radio.open, arena.clock, XBeeProtocol(arena_id))


def run(pairs, seconds, commands):
    """Advance arenas in step; `commands` per arena: the command of all robots, or None for silence of the game."""
    running = [0] * len(pairs)
    for _ in range(round(seconds / 0.02)):
        for i, ((arena, link), command) in enumerate(zip(pairs, commands, strict=True)):
            if command is not None:
                link.send([command] * 4)
            link.pump()
            arena.advance(0.02)
            running[i] += any(not firmware.stopped for firmware in arena.firmwares)
    return [count / round(seconds / 0.02) for count in running]


def test_two_arenas_on_one_channel_neither_obey_nor_feed_each_other():
    """Before arena ids, a stop from one and a drive from the other kept motors on 55 % of the time."""
    one, other = pairs = [linked(11), linked(12)]
    one[0].radio.neighbours, other[0].radio.neighbours = [other[0].radio], [one[0].radio]
    shares = run(pairs, 1.0, [WheelCommand(0.0, 0.0), AHEAD])
    assert shares[0] == 0.0
    assert shares[1] > 0.95
    assert all(firmware.ignored > 40 for firmware in one[0].firmwares)
    run(pairs, 0.5, [AHEAD, AHEAD])
    one[1]._protocol.command = lambda wheels, now: b""  # the computer of one falls silent; the other drives on
    left = one[0].clock()
    run(pairs, 0.5, [AHEAD, AHEAD])
    assert 0.2 < max(one[0].last_driven) - left < 0.27
    assert all(firmware.stopped for firmware in one[0].firmwares)
    assert not any(firmware.stopped for firmware in other[0].firmwares)
    assert sorted(other[1].telemetry) == [0, 1, 2, 3]
    assert not any(other[1].misfit(robot) for robot in range(4)), "robots of this arena report too"


def test_a_stranger_in_range_can_do_what_the_page_says_and_no_more():
    """docs/hardware.md, "What a stranger can do": forge both kinds of packets; no report moves a robot."""
    arena, _ = linked(11)
    firmware, forged = arena.firmwares[0], report_packet(RobotReport(11, 1, VERSION, 7, 0, 5200))
    protocol = XBeeProtocol(11, XBeeMode.TRANSPARENT)
    protocol.receive(forged, 1.0)
    assert protocol.telemetry[0].battery == 5.2, "a robot that is off seems to report"
    protocol.receive(report_packet(RobotReport(11, 1, VERSION, 7, EMPTY, 3900)), 2.0)
    assert protocol.telemetry[0].flags == EMPTY, "or one that drives, to have an empty battery"
    firmware.receive(drive_packet(11, 7, [AHEAD] * 4), arena.clock())
    assert not firmware.stopped, "whoever sends last drives"
    began = arena.clock()
    while not firmware.stopped:
        firmware.receive(forged, arena.clock())
        arena.advance(0.01)
    assert arena.clock() - began < 0.27, "reports do not feed the deadman"


def test_a_robot_that_falls_silent_is_not_replaced_by_that_of_another_arena():
    """Telemetry of the neighbours, whose batteries are full, never counts for our own robots."""
    one, other = pairs = [linked(11), linked(12)]
    one[0].radio.neighbours, other[0].radio.neighbours = [other[0].radio], [one[0].radio]
    for robot in one[0].robots:
        robot.battery = 4.2
    run(pairs, 1.0, [AHEAD, AHEAD])
    assert {round(report.battery, 2) for report in one[1].telemetry.values()} == {4.2}
    assert all(report.battery > 4.5 for report in other[1].telemetry.values())
    last = one[1].telemetry
    for firmware in one[0].firmwares:
        firmware.mute = True
    run(pairs, 2.5, [AHEAD, AHEAD])
    for robot in range(4):
        assert one[1].telemetry[robot].received < last[robot].received + 0.25
        assert one[1].quality(robot).share == 0.0
        assert one[1].misfit(robot)[:2] == ("foreign", 12)


def test_a_repeated_packet_neither_drives_nor_feeds_the_deadman():
    arena = EmulatedArena(1, channel=RadioChannel(mode=TRANSPARENT))
    arena.camera.due = float("inf")
    for _ in range(50):
        arena.radio.write(drive_packet(ARENA_ID, 7, [AHEAD] * 4))
        arena.advance(0.02)
    assert all(firmware.packets == 1 for firmware in arena.firmwares)
    assert 0.25 < max(arena.last_driven) < 0.28


@pytest.mark.parametrize(
    ("fault", "reason", "arena"),
    [("old_firmware", "old", 0), ("no_arena", "no_arena", 0), ("other_arena", "foreign", 13)],
)
def test_a_robot_that_cannot_be_driven_is_named_and_stands(fault, reason, arena):
    pair = linked(12)
    pair[0].faults.switch(fault, True, robot=1)
    run([pair], 1.0, [AHEAD])
    link = pair[1]
    assert link.misfit(1)[:2] == (reason, arena)
    assert [link.misfit(robot) for robot in (0, 2, 3)] == [None] * 3
    assert 1 not in link.telemetry
    assert pair[0].last_driven[1] == float("-inf")
    pair[0].faults.switch(fault, False, robot=1)  # it is flashed anew
    run([pair], 1.0, [AHEAD])
    assert link.misfit(1) is None
    assert 1 in link.telemetry


def test_an_empty_battery_keeps_the_motors_off_until_it_is_charged_and_the_computer_reads_why():
    pair = arena, link = linked(12)
    for volts, drives, flags in ((5.0, True, 0), (3.9, False, LOW | EMPTY), (4.2, False, LOW | EMPTY), (4.5, True, 0)):
        arena.robots[1].battery = volts
        run([pair], 0.5, [AHEAD])
        assert (arena.clock() - arena.last_driven[1] < 0.1) == drives
        assert link.telemetry[1].flags & (LOW | EMPTY) == flags
        assert arena.clock() - arena.last_driven[0] < 0.1, "the others drive on"


def moved_by(count, seed=1):
    """Robots moved by so many corrupt packets."""
    arena = EmulatedArena(1)
    receivers = [Firmware(robot, 1 + i, ARENA) for i, robot in enumerate(arena.robots)]
    receivers[0].receive(b"\x80".join(packet.tobytes() for packet in corrupt_packets(count, seed)), 1.0)
    assert receivers[0].rejected > 0.9 * count
    return receivers[0].packets


def test_no_corrupt_packet_becomes_a_command():
    assert moved_by(3000) == 0


@pytest.mark.long
@pytest.mark.parametrize("first", repeated(range(0, 30, 3)))
def test_of_three_million_corrupt_packets_none_becomes_a_command(first):
    """The decoder of the true firmware gets all: firmware/test_packets.py."""
    assert sum(moved_by(100_000, seed) for seed in range(first, first + 3)) == 0
