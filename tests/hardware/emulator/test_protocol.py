"""Protocol 2 at the emulated motors: two arenas on one channel, repeated and corrupt packets, unusable robots."""

import pytest

from pigaming_app.hardware.emulator.arena import ARENA_ID, EmulatedArena
from pigaming_app.hardware.emulator.firmware import Firmware
from pigaming_app.hardware.emulator.radio import TRANSPARENT, RadioChannel
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.radio.packets import EMPTY, LOW, VERSION, RobotReport, drive_packet
from pigaming_app.hardware.radio.xbee_protocol import XBeeMode, XBeeProtocol
from pigaming_app.hardware.signals import WheelCommand
from tests.hardware.corruption import corrupt_packets
from tests.hardware.robot_packets import ARENA, report_packet

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
def test_of_three_million_corrupt_packets_none_becomes_a_command():
    assert sum(moved_by(100_000, seed) for seed in range(30)) == 0
