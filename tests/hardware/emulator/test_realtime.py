"""The emulated arena in real time behind a pseudo-terminal: robots stop when the driving process is killed."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

if sys.platform == "win32":
    pytest.skip("there are no pseudo-terminals", allow_module_level=True)

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.firmware import DEADMAN
from pigaming_app.hardware.emulator.realtime import PseudoTerminal, RealtimeArena
from pigaming_app.hardware.emulator.robots import STEP

DRIVER = """
import sys, time
from pigaming_app.hardware.radio.serial_line import serial_port
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.radio.xbee_protocol import XBeeProtocol
from pigaming_app.hardware.signals import WheelCommand
link = Link(serial_port(sys.argv[1]), time.monotonic, XBeeProtocol(int(sys.argv[2]))).start()
while True:
    link.send([WheelCommand(0.5, 0.4)] * 4)
    time.sleep(0.02)
"""
ROOT = Path(__file__).resolve().parents[3]


def until(true, seconds=60.0):
    """Wait for a condition, with a timeout for busy machines."""
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end, "it did not happen"
        time.sleep(0.005)


def test_robots_stop_when_the_program_that_drives_them_is_killed():
    arena = EmulatedArena(1, refresh=1000, begin=time.monotonic())
    with RealtimeArena(arena, PseudoTerminal()) as live:
        driver = subprocess.Popen([sys.executable, "-c", DRIVER, live.terminal.name, str(arena.arena_id)], cwd=ROOT)
        try:
            until(lambda: all(robot.left_speed > 100 for robot in arena.robots))
            os.kill(driver.pid, signal.SIGKILL)
        finally:
            driver.kill()
            driver.wait()
        until(lambda: all(firmware.stopped for firmware in arena.firmwares))
        for firmware, ran in zip(arena.firmwares, arena.last_driven, strict=True):
            assert ran - firmware.last_packet <= DEADMAN + STEP


def test_nothing_is_left_running():
    before = threading.active_count()
    live = RealtimeArena(EmulatedArena(1, refresh=1000, begin=time.monotonic()), PseudoTerminal()).start()
    live.close()
    live.close()
    assert threading.active_count() == before
