"""The emulated arena in real time behind a pseudo-terminal, paced by the reader of its pictures, and its projector."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.firmware import DEADMAN
from pigaming_app.hardware.emulator.realtime import OVERDUE, PacedArena, PseudoTerminal, RealtimeArena
from pigaming_app.hardware.emulator.robots import STEP

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals")


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


@POSIX
def test_robots_stop_when_the_program_that_drives_them_is_killed():
    arena = EmulatedArena(1, refresh=1000, begin=time.monotonic())
    with RealtimeArena(arena, terminal := PseudoTerminal()):
        driver = subprocess.Popen([sys.executable, "-c", DRIVER, terminal.name, str(arena.arena_id)], cwd=ROOT)
        try:
            until(lambda: all(robot.left_speed > 100 for robot in arena.robots))
            os.kill(driver.pid, signal.SIGKILL)
        finally:
            driver.kill()
            driver.wait()
        until(lambda: all(firmware.stopped for firmware in arena.firmwares))
        for firmware, ran in zip(arena.firmwares, arena.last_driven, strict=True):
            assert ran - firmware.last_packet <= DEADMAN + STEP


@POSIX
def test_nothing_is_left_running():
    before = threading.active_count()
    live = RealtimeArena(EmulatedArena(1, refresh=1000, begin=time.monotonic()), PseudoTerminal()).start()
    live.close()
    live.close()
    assert threading.active_count() == before


def test_time_passes_up_to_what_is_allowed_and_no_further():
    arena = EmulatedArena(refresh=1000)
    passing = PacedArena(arena)
    passing.limit = 0.2
    passing.start()
    try:
        until(lambda: arena.clock() > 0.2 - 2 * STEP)
        time.sleep(0.1)
        assert arena.clock() <= 0.2 + STEP
        passing.limit = 0.4
        until(lambda: arena.clock() > 0.3)
    finally:
        passing.close()
    ended = arena.clock()
    time.sleep(0.05)
    assert arena.clock() == ended


def test_time_waits_until_its_pictures_are_taken():
    arena = EmulatedArena(refresh=1000)
    passing = PacedArena(arena)
    passing.watched = True
    passing.start()
    try:
        until(lambda: arena.camera.overdue > OVERDUE)
        waited = arena.clock()
        time.sleep(0.1)
        assert arena.clock() - waited <= 2 * STEP
        assert arena.camera.newest() is not None
        until(lambda: [arena.camera.newest()] and arena.clock() > waited + 0.05)
    finally:
        passing.close()


@pytest.mark.parametrize(("size", "bars"), [((1080, 1920), 0), ((540, 960), 0), ((1024, 1280), 152), ((2160, 3840), 0)])
def test_the_picture_fills_the_projector_and_the_bars_are_left_out(size: tuple[int, int], bars: int) -> None:
    arena = EmulatedArena(1)
    window = np.zeros((*size, 4), np.uint8)
    window[bars : size[0] - bars] = 200
    window[bars : bars + 20, :40] = 90  # its upper left corner
    arena.project_window(window)
    arena.advance(0.1)
    shown = arena._shown
    assert shown.shape == (1080, 1920)
    assert shown[1070, 1910] == 200
    assert shown[2, 2] == pytest.approx(90, abs=2)
