"""The serial line: an operator message for every fault of a port, and reopening of lost ports."""

import errno
import itertools
import os
import socket
import sys
from contextlib import suppress

import pytest
import serial

from pigaming_app.hardware.radio.serial_line import (
    SerialLine,
    failure_message,
    ports,
    radio_message,
    serial_port,
)
from pigaming_app.hardware.signals import SERIAL_FAILURES
from tests.hardware.sentences import key_of, sentence
from tests.hardware.wire import Time, Wire

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals")
REFUSALS = {  # errors on opening, on Linux, macOS and Windows: expected reason
    "no such port": (OSError(errno.ENOENT, "could not open port x: [Errno 2]"), "absent"),
    "no permission": (PermissionError(errno.EACCES, "could not open port x: [Errno 13]"), "denied"),
    "busy": (OSError(errno.EBUSY, "Device or resource busy"), "busy"),
    "locked": (OSError(errno.EAGAIN, "Could not exclusively lock port x"), "busy"),
    "a file": (OSError("Could not configure port: (25, 'Inappropriate ioctl for device')"), "wrong"),
    "no hardware": (OSError("Could not configure port: (5, 'Input/output error')"), "dead"),
    "no such port, Windows": (
        OSError("could not open port 'COM9': FileNotFoundError(2, 'The system cannot find the file.', None, 2)"),
        "absent",
    ),
    "busy, Windows": (OSError("could not open port 'COM3': PermissionError(13, 'Access is denied.', None, 5)"), "busy"),
    "no hardware, told by termios": (SERIAL_FAILURES[-1](errno.EIO, "Input/output error"), "dead"),
    "no pyserial": (ImportError("No module named 'serial'"), "missing"),
    "no such baud": (ValueError("Invalid baud rate: 7"), "failed"),
}


@pytest.mark.parametrize(("error", "reason"), REFUSALS.values(), ids=REFUSALS)
def test_why_a_port_does_not_open_is_one_sentence(error, reason):
    fault = failure_message(error, "COM3")
    assert fault.key == f"radio_{reason}"
    told = sentence(fault)
    assert "\n" not in told
    assert told.endswith((".", "?"))
    assert "COM3" in told or reason == "missing"


@POSIX
@pytest.mark.parametrize(
    ("device", "told"),
    [
        ("/dev/pigaming", "Port /dev/pigaming does not exist: plug in the radio or choose another port."),
        ("/dev/null", "/dev/null is not a serial port: choose the radio's port."),
        ("/", "/ is not a serial port: choose the radio's port."),
    ],
)
def test_ports_that_are_none(device, told):
    line = SerialLine(serial_port(device), Time(), device)
    assert not line.open()
    assert sentence(line.fault) == told


@POSIX
@pytest.mark.parametrize("stop_bits", [1, 2])
def test_bytes_go_both_ways_over_a_terminal_and_its_end_is_noticed(stop_bits):
    far, near = os.openpty()
    device, time = os.ttyname(near), Time()
    line = SerialLine(serial_port(device, stop_bits=stop_bits), time, device)
    assert line.open()
    os.close(near)
    line.write(b"\xd0\x11\x13\n\r\x00")
    assert os.read(far, 20) == b"\xd0\x11\x13\n\r\x00"
    os.write(far, b"\r\x7d\x03")
    heard = b""
    for _ in range(100_000):
        if heard := heard + line.read():
            break
    assert heard == b"\r\x7d\x03"
    os.close(far)
    for _ in range(100_000):
        line.read()
        if not line.is_open:
            break
    assert sentence(line.fault) == f"The radio at {device} was unplugged: plug it in again."


@POSIX
def test_a_port_that_another_program_holds_is_busy():
    far, near = os.openpty()
    device = os.ttyname(near)
    first, second = (SerialLine(serial_port(device), Time(), device) for _ in range(2))
    assert first.open()
    assert not second.open()
    assert sentence(second.fault) == f"{device} is in use by another program: close that program."
    first.close()
    os.close(near)
    os.close(far)


def test_without_pyserial_the_sentence_says_so(monkeypatch):
    monkeypatch.setitem(sys.modules, "serial", None)
    monkeypatch.setitem(sys.modules, "serial.tools", None)
    line = SerialLine(serial_port("COM3"), Time(), "COM3")
    assert not line.open()
    assert sentence(line.fault) == "The Python package pyserial is missing: install it to use a radio."
    assert ports() == []


def test_the_ports_of_the_computer_are_listed():
    assert all(port.device and port.description for port in ports())


@pytest.mark.parametrize("kind", SERIAL_FAILURES)
def test_a_lost_port_is_opened_again_at_longer_and_longer_intervals(kind):
    time, tries = Time(), []
    wires = [Wire(time), Wire(time)]

    def open_port():
        tries.append(time())
        if 1 < len(tries) < 6:
            raise OSError(errno.ENOENT, "not here")
        return wires[len(tries) > 1]

    line = SerialLine(open_port, time, "COM3")
    assert line.open()
    wires[0].cut = kind(errno.EIO, "Input/output error")
    assert line.read() == b""
    assert wires[0].is_closed
    for _ in range(1000):
        assert line.fault == (None if line.is_open else radio_message("unplugged", "COM3"))
        line.write(b"nobody hears this")
        line.open()
        time.now += 0.01
    gaps = [later - earlier for earlier, later in itertools.pairwise(tries)]
    assert gaps == pytest.approx([0.25, 0.5, 1.0, 2.0, 2.0], abs=0.011)
    assert line.is_open


@pytest.mark.parametrize("kind", SERIAL_FAILURES)
def test_a_write_that_fails_loses_the_port(kind):
    wire = Wire(Time())
    line = SerialLine(lambda: wire, wire.time, "COM3")
    line.open()
    wire.cut = kind(errno.EIO, "Input/output error")
    line.write(b"x")
    assert not line.is_open
    assert key_of(line.fault) == "radio_unplugged"


def test_a_port_that_takes_no_bytes_is_reported_as_stuck_after_a_second_and_stays_open():
    wire = Wire(Time())
    line = SerialLine(lambda: wire, wire.time, "COM3")
    line.open()
    wire.cut = serial.SerialTimeoutException("Write timeout")
    for _ in range(49):
        line.write(b"x")
        assert line.fault is None
        wire.time.now += 0.02
    wire.time.now += 0.03
    line.write(b"x")
    assert sentence(line.fault) == "COM3 accepts no more data: unplug the radio and plug it in again."
    assert line.is_open
    wire.cut = None
    line.write(b"x")
    assert line.fault is None


def test_writes_that_time_out_now_and_then_are_no_trouble():
    """A starved process: pyserial raises although all bytes were taken."""
    wire = Wire(Time())
    line = SerialLine(lambda: wire, wire.time, "COM3")
    line.open()
    for i in range(500):
        wire.cut = serial.SerialTimeoutException("Write timeout") if i % 10 else None
        line.write(b"x")
        wire.time.now += 0.1
        assert line.fault is None
        assert line.is_open


@POSIX
def test_a_reader_that_pauses_is_not_taken_for_an_unplugged_radio():
    far, near = os.openpty()
    os.set_blocking(far, False)
    device, time = os.ttyname(near), Time()
    line = SerialLine(serial_port(device), time, device)
    assert line.open()
    while not line._blocked_since:  # the buffer of the terminal fills up
        line.write(bytes(1000))
    assert line.is_open
    assert line.fault is None
    with suppress(BlockingIOError):
        while os.read(far, 100_000):
            pass
    line.write(b"\xd0new")
    assert os.read(far, 100_000).endswith(b"\xd0new")
    assert line.fault is None
    os.close(near)
    os.close(far)


@POSIX
def test_stale_commands_in_a_full_buffer_are_dropped():
    """Queued commands must not reach a robot late: only bytes already at the far end get through."""
    far, near = os.openpty()
    os.set_blocking(far, False)
    device, time = os.ttyname(near), Time()
    line, taken = SerialLine(serial_port(device), time, device), 0
    assert line.open()
    while not line._blocked_since:
        line.write(b"old!" * 250)
        taken += 1000
    line.write(b"new!")
    assert taken > 10_000
    heard = b""
    for _ in range(100_000):
        if (heard := heard + _heard(far)).endswith(b"new!"):
            break
    assert heard.endswith(b"new!")
    assert heard.count(b"old!") <= 1024
    os.close(near)
    os.close(far)


def _heard(far):
    try:
        return os.read(far, 100_000)
    except BlockingIOError:
        return b""


def test_a_tcp_connection_is_a_port_that_is_lost_and_opened_again():
    """The other end is Python's own."""
    clock = Time()
    with socket.create_server(("127.0.0.1", 0)) as server:
        name = f"tcp:127.0.0.1:{server.getsockname()[1]}"
        line = SerialLine(serial_port(name), clock, name)
        for sent in (b"first", b"second" * 20_000):
            assert line.open()
            other, _ = server.accept()
            with other:
                line.write(b"hello")
                assert other.recv(16) == b"hello"
                other.sendall(sent)
                received = b""
                while len(received) < len(sent):
                    received += line.read()
                assert received == sent
                assert line.fault is None
            while line.fault is None:
                line.read()
            assert key_of(line.fault) == "radio_unplugged"
            clock.now += 10.0
    assert not line.open()
    assert key_of(line.fault) == "radio_unplugged", "it was there before"
    fresh = SerialLine(serial_port(name), clock, name)
    assert not fresh.open()
    assert key_of(fresh.fault) == "radio_absent"
