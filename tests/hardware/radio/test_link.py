"""The link in simulated time: the newest command 50 times a second, stop without commands, stop at the end."""

import os
import subprocess
import sys
import threading
import time as real_time
from pathlib import Path

import pytest

from pigaming_app.hardware.radio import packets, xbee_frames
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.radio.packets import RobotReport
from pigaming_app.hardware.radio.xbee_frames import ReceivedPacket
from pigaming_app.hardware.radio.xbee_protocol import XBeeMode, XBeeProtocol
from pigaming_app.hardware.signals import Telemetry, WheelCommand
from tests.hardware.sentences import key_of, sentence
from tests.hardware.wire import ARENA, Radio, Time, Wire, drive_from, report_packet, run

ROOT = Path(__file__).parents[3]
AHEAD, BACK = WheelCommand(1.0, 1.0), WheelCommand(-1.0, -1.0)
STOPPED = (None,) * 4


def reported(address, seq, flags, millivolts, arena=ARENA):
    return report_packet(RobotReport(arena, address, packets.VERSION, seq, flags, millivolts))


@pytest.fixture
def time():
    return Time()


@pytest.fixture
def radio(time):
    return Radio(time)


@pytest.fixture
def link(radio, time):
    with Link(lambda: radio, time, XBeeProtocol(ARENA), name="/dev/radio") as link:
        yield link


def crews(radio):
    return [drive.wheels for _, drive in radio.drives]


def test_the_newest_command_goes_out_fifty_times_a_second(link, radio, time):
    run(link, time, 1.0, lambda: (link.send([BACK]), link.send([AHEAD, None, BACK])))
    assert len(radio.drives) == 50
    assert set(crews(radio)) == {(AHEAD, None, BACK, None)}
    assert [drive.seq for _, drive in radio.drives] == list(range(1, 51))


def test_a_pump_that_stalled_does_not_catch_up_with_a_burst(link, radio, time):
    run(link, time, 0.1)
    time.now += 5.0
    run(link, time, 0.1)
    assert len(radio.drives) == 10


def test_silence_while_this_computer_was_held_up_is_not_the_radios(link, time):
    run(link, time, 0.5)
    time.now += 5.0
    assert link.fault is None
    run(link, time, 0.5)
    assert link.fault is None


def test_without_a_new_command_for_a_tenth_of_a_second_it_says_stop(link, radio, time):
    link.send([AHEAD])
    run(link, time, 0.3)
    last = max(at for at, drive in radio.drives if drive.wheels[0] == AHEAD)
    assert last == pytest.approx(100.1, abs=0.021)
    assert crews(radio)[-5:] == [STOPPED] * 5


def test_closing_says_stop_five_times_and_once_only(link, radio, time):
    run(link, time, 0.1, lambda: link.send([AHEAD] * 4))
    said = len(radio.drives)
    link.close()
    link.close()
    link.pump()
    assert crews(radio)[said:] == [STOPPED] * 5
    assert radio.is_closed


def test_a_fifth_robot_is_refused_where_it_is_named(link):
    with pytest.raises(ValueError, match="at most 4"):
        link.send([AHEAD] * 5)


@pytest.mark.parametrize("mode", XBeeMode)
def test_robots_are_heard_in_every_mode(mode, time):
    """Two reports in one chunk, the second cut in two, as a transparent radio delivers them."""
    wire = Wire(time) if mode is XBeeMode.TRANSPARENT else Radio(time, escaped=mode is XBeeMode.API2)
    link = Link(lambda: wire, time, XBeeProtocol(ARENA, mode))
    link.pump()
    said = reported(2, 1, packets.LOW, 4321) + reported(2, 1, 0, 4300)
    for part in (said[:9], said[9:]):
        if isinstance(wire, Radio):
            wire.say(ReceivedPacket(2, -40, 0, part))
        else:
            wire.coming += part
    time.now += 0.015
    link.pump()
    assert link.telemetry == {1: Telemetry(1, 4.3, 0, 100.015)}
    quality = link.quality(1)
    assert quality.strength == (None if mode is XBeeMode.TRANSPARENT else -40)
    assert quality.echo == pytest.approx(0.015)
    assert link.fault is None


def test_transparent_packets_are_bare(time):
    wire = Wire(time)
    link = Link(lambda: wire, time, XBeeProtocol(ARENA, XBeeMode.TRANSPARENT))
    link.send([AHEAD])
    link.pump()
    assert wire.written == [(100.0, packets.drive_packet(ARENA, 1, [AHEAD]))]


def test_the_share_of_reports_heard_sinks_when_a_robot_falls_silent(link, radio, time):
    def report():
        if round(time.now * 100) % 20 == 0:
            radio.say(ReceivedPacket(1, -50, 0, reported(1, 0, 0, 5000)))

    run(link, time, 2.0, report)
    assert link.quality(0).share >= 0.9
    run(link, time, 1.0)
    assert link.quality(0).share == pytest.approx(0.5, abs=0.11)
    assert link.quality(3).share == 0.0


def test_how_broadcasts_went_is_counted(radio, time):
    air = XBeeProtocol(ARENA)
    link = Link(lambda: radio, time, air)
    run(link, time, 0.2)
    radio.status = 2
    run(link, time, 0.1)
    assert air.broadcasts == 15
    assert air.outcomes == {0: 10, 2: 5}


def test_a_radio_that_never_answers_is_named(time):
    link = Link(lambda: Wire(time), time, XBeeProtocol(ARENA), name="COM3")
    run(link, time, 0.9)
    assert link.fault is None
    run(link, time, 0.2)
    assert sentence(link.fault) == ("No radio answers at COM3: check the port and the baud rate.")


@pytest.mark.parametrize("mode", XBeeMode)
def test_garbage_on_the_line_is_named_and_forgotten(mode, time):
    wire = Wire(time)
    link = Link(lambda: wire, time, XBeeProtocol(ARENA, mode), name="COM3")

    def noise():
        wire.coming += b"\x00\xff\x7e\x12\xd4\xff"

    run(link, time, 1.2, noise)
    assert key_of(link.fault) == "radio_garbled"
    report = reported(1, 0, 0, 5000)
    escaped = mode is XBeeMode.API2
    good = xbee_frames.frame(xbee_frames.encode(ReceivedPacket(1, -30, 0, report)), escaped)
    wire.coming += bytes(200) + (report if mode is XBeeMode.TRANSPARENT else good)
    link.pump()
    assert link.fault is None
    assert link.telemetry[0].battery == 5.0


def test_a_radio_of_the_other_api_mode_is_named(time):
    radio = Radio(time, escaped=True, ap=1)
    link = Link(lambda: radio, time, XBeeProtocol(ARENA), name="COM3")
    run(link, time, 0.1)
    assert sentence(link.fault) == "The radio at COM3 uses AP=1, this program does not: set both the same."


def test_a_radio_in_api_mode_on_a_transparent_link_is_named(time):
    """The robots' reports would be received, from inside the frames, but no command would reach them."""
    radio = Radio(time)
    link = Link(lambda: radio, time, XBeeProtocol(ARENA, XBeeMode.TRANSPARENT), name="COM3")
    link.pump()
    for seq in range(5):  # frames with escaped bytes are not understood
        radio.say(ReceivedPacket(1, -40, 0, reported(1, seq, packets.DEADMAN, 5000)))
    link.pump()
    assert 0 in link.telemetry
    assert sentence(link.fault) == "The radio at COM3 uses AP=1 or 2, this program does not: set both the same."


def test_a_quiet_transparent_line_is_no_trouble(time):
    """Robots that are switched off send nothing."""
    link = Link(lambda: Wire(time), time, XBeeProtocol(ARENA, XBeeMode.TRANSPARENT))
    run(link, time, 5.0)
    assert link.fault is None


def test_in_a_thread_it_beats_by_itself_and_ends_within_a_second():
    radio = Radio(real_time.monotonic)
    link = Link(lambda: radio, real_time.monotonic, XBeeProtocol(ARENA)).start()
    deadline = real_time.monotonic() + 60.0
    while len(radio.drives) < 20 and real_time.monotonic() < deadline:
        link.send([AHEAD])
        real_time.sleep(0.005)
    assert (AHEAD, None, None, None) in crews(radio)
    link.close()
    assert crews(radio)[-5:] == [STOPPED] * 5
    assert radio.is_closed
    assert not [one for one in threading.enumerate() if one.name == "link"]


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_a_fault_of_the_program_stops_the_robots_and_is_told(monkeypatch):
    radio = Radio(real_time.monotonic)
    air = XBeeProtocol(ARENA)
    link = Link(lambda: radio, real_time.monotonic, air, name="COM3")
    link.send([AHEAD])
    monkeypatch.setattr(air, "receive", lambda received, now: 1 / 0)
    link.start()
    assert link._thread is not None
    link._thread.join(timeout=60.0)
    assert crews(radio) == [STOPPED] * 5
    assert sentence(link.fault) == "COM3 failed because of a program error: see the log."
    link.close()


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals")
@pytest.mark.parametrize("end", ["", "sys.exit(3)", "raise RuntimeError"])
def test_a_program_that_ends_without_closing_says_stop_five_times(end):
    program = f"""
import sys, time
from pigaming_app.hardware.radio.xbee_protocol import XBeeMode, XBeeProtocol
from pigaming_app.hardware.radio.serial_line import serial_port
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.signals import WheelCommand

link = Link(serial_port(sys.argv[1]), time.monotonic, XBeeProtocol(4711, XBeeMode.TRANSPARENT)).start()
while link._protocol.broadcasts < 3:
    link.send([WheelCommand(1.0, 1.0)])
    time.sleep(0.001)
link.send([WheelCommand(1.0, 1.0)])
{end}
"""
    far, near = os.openpty()
    command = [sys.executable, "-c", program, os.ttyname(near)]
    subprocess.run(command, cwd=ROOT, stderr=subprocess.DEVNULL, timeout=60)
    said = packets.PacketDecoder().feed(os.read(far, 10_000))
    os.close(near)
    os.close(far)
    crews = [drive_from(packet).wheels for packet in said]
    assert crews[-5:] == [STOPPED] * 5
    assert (AHEAD, None, None, None) in crews
