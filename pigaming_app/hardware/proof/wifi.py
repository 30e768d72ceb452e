"""Proof of the Wi-Fi robots: their own program, in MicroPython, stops the motors in every emergency.

Matches, pairing and the faults of `emergencies` run in the emulated arena's time; the arcade is killed and stopped in
real time, as a process of its own.
"""

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import closing

from pigaming_app.hardware.commissioning.pairing import Pairing, PairingCase
from pigaming_app.hardware.emulator.wifi.air import Air, WifiChannel
from pigaming_app.hardware.emulator.wifi.boards import BoardConfig, Boards
from pigaming_app.hardware.proof import emergencies
from pigaming_app.hardware.proof.emergencies import ROOT
from pigaming_app.hardware.proof.testbed import Testbed
from pigaming_app.hardware.proof.trials import FigureEight
from pigaming_app.sim.world import HZ, ROBOTS

LOSSY = WifiChannel(0.002, 0.040, loss=0.05, duplicates=0.02)  # overtaking included
FAULTS = ("radio dead", "robot mute", "robot off", "battery empty", "all-stop")  # of emergencies.EMERGENCIES
KEY, ARENA = bytes(range(100, 116)), 1234
SETTLED = 1.5  # s of driving before the arcade is stopped
LISTEN = 3  # s, within which robots announce themselves and report
ENOUGH = 0.6  # s of observation after
SIGNALS = ("SIGKILL", "SIGSTOP", "SIGTERM")

DRIVER = """
import sys, time
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.radio.wifi import WifiNetwork, WifiProtocol
from pigaming_app.hardware.signals import WheelCommand
network = WifiNetwork(int(sys.argv[1]), bytes.fromhex(sys.argv[2]), time.monotonic, int(sys.argv[3]), "127.0.0.1")
link = Link(network.open, time.monotonic, WifiProtocol(network), "Wi-Fi").start()
while True:
    link.send([WheelCommand(0.5, 0.4)] * 4)
    time.sleep(0.02)
"""


def arcade_stops(name: str, channel: WifiChannel = LOSSY, seed: int = 1) -> float:
    """Seconds until the last motor stops after a process that drives four robots receives this signal, in real time.

    Raises NoMicroPython, or RuntimeError if the robots do not drive before or not stop after.
    """
    with closing(Air(ROBOTS, _free_port(), channel, seed)) as air, _boards(air) as boards:
        air.robots = boards.ports
        air.start()
        driver = subprocess.Popen(
            [sys.executable, "-X", "pigaming", "-c", DRIVER, str(ARENA), KEY.hex(), str(air.arcade)], cwd=ROOT
        )
        try:
            _await(lambda: all(any(boards.motors(robot)) for robot in range(ROBOTS)))
            time.sleep(SETTLED)
            if not all(any(boards.motors(robot)) for robot in range(ROBOTS)):
                raise RuntimeError("the robots did not drive on")
            began = time.monotonic()
            os.kill(driver.pid, getattr(signal, name))
            time.sleep(ENOUGH)
            _await(lambda: not any(any(boards.motors(robot)) for robot in range(ROBOTS)), 3.0)
        finally:
            driver.kill()
            driver.wait()
        return max(boards.powered_until) - began


def faults(seed: int, channel: WifiChannel = LOSSY) -> dict[str, float]:
    """Stopping times, s, of paired robots in the emulated arena. Raises RuntimeError if a fault is not reported."""
    bed = Testbed(seed, 30.0, wifi=channel)
    try:
        bed.session.find()
        pair(bed)
        trail = FigureEight(bed)
        stops = {}
        for i, name in enumerate(FAULTS):
            result = emergencies.stop(trail, name, i % ROBOTS)
            if not result.reported:
                raise RuntimeError(f"{name}: the fault was not reported")
            stops[name] = result.seconds
        return stops | {"program hangs": emergencies.hang(trail), "program ends": emergencies.leave(trail)}
    finally:
        bed.session.end()


def pair(bed: Testbed) -> None:
    """Spin each robot in turn, once all report. Raises RuntimeError unless each turns the marker of its number."""
    for _ in range(LISTEN * HZ):
        bed.tick()
    pairing = Pairing(bed.rig)
    while not pairing.tick():
        bed.tick()
    cases = [finding.case for finding in pairing.findings]
    bed.rig.channels = pairing.channels
    if cases != [PairingCase.FITS] * ROBOTS:
        raise RuntimeError(f"pairing: {', '.join(cases)}")


def _boards(air: Air) -> Boards:
    return Boards([BoardConfig(i + 1, ARENA, KEY, air.port(i)) for i in range(ROBOTS)])


def _free_port() -> int:
    """A UDP port that is free now."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def _await(condition: Callable[[], bool], timeout: float = 60.0) -> None:
    deadline = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > deadline:
            raise RuntimeError("the emulated boards did not react")
        time.sleep(0.005)
