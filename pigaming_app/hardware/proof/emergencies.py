"""Everything that can go wrong while robots drive, and how soon their motors stand then, on the emulated arena.

`stop` lets one thing of EMERGENCIES happen and end again; `hang`, `leave` and `kill` end the program that drives, in
three ways.
"""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.realtime import PseudoTerminal, RealtimeArena
from pigaming_app.hardware.proof.trials import FigureEight
from pigaming_app.sim.world import DT, HZ

ENOUGH = 0.6  # s after which nothing will move again that has been stopped
ROOT = Path(__file__).resolve().parents[3]


class Emergency(NamedTuple):
    """Something goes wrong with a robot, or with all: how it begins and ends, and faults of which one must be named."""

    begin: Callable[[FigureEight, int], None]
    end: Callable[[FigureEight, int], None]
    says: tuple[str, ...]
    everyone: bool = False
    allowed: float = 0.0  # s that the table of faults itself allows before anything has to happen


def fault(name: str, *says: str, everyone: bool = False, allowed: float = 0.0) -> Emergency:
    """A fault of the emulated arena as an emergency."""
    return Emergency(
        lambda trail, robot: trail.bed.arena.faults.switch(name, True, robot),
        lambda trail, robot: trail.bed.arena.faults.switch(name, False, robot),
        says,
        everyone,
        allowed,
    )


def _twice(on: bool) -> Callable[[FigureEight, int], None]:
    """Where a game shows hard edges, a second marker cannot always be read, and does no harm: so without them."""

    def double(trail: FigureEight, robot: int) -> None:
        trail.bed.lighting.show(busy=not on)
        trail.bed.arena.faults.switch("marker_twice", on, robot)

    return double


EMERGENCIES: Mapping[str, Emergency] = {
    "camera frozen": fault("camera_frozen", "camera", everyone=True),
    "camera gone": fault("camera_gone", "camera", everyone=True),
    "camera stuck": fault("camera_stuck", "camera", everyone=True),
    "marker covered": fault("marker_covered", "lost"),
    "marker upside down": fault("upside_down", "lost"),
    "marker in a hand": fault("marker_held", "held", "lost"),
    "marker twice": Emergency(_twice(True), _twice(False), ("twice",)),
    "radio dead": fault("radio_dead", "silent", everyone=True),
    "radio unplugged": fault("radio_unplugged", "radio", everyone=True),
    "robot mute": fault("robot_mute", "silent", allowed=1.0),
    "robot off": fault("robot_off", "silent"),
    "battery empty": fault("battery_low", "empty"),
    "all-stop": Emergency(
        lambda trail, _: trail.plant.safety.all_stop(),
        lambda trail, _: trail.plant.safety.release(),
        ("stopped",),
        True,
    ),
    "camera bumped": fault("camera_bumped", "drift", everyone=True, allowed=0.35),
}


class StopResult(NamedTuple):
    """How an emergency went."""

    seconds: float  # from its beginning to when the last motor concerned was last given anything
    said: bool  # whether the fault was named


def stop(trail: FigureEight, name: str, robot: int = 1) -> StopResult:
    """Let it happen to moving robots, and end again; they must drive as before."""
    emergency, arena = EMERGENCIES[name], trail.bed.arena
    settle(trail)
    began = arena.clock() + emergency.allowed
    emergency.begin(trail, robot)
    said = False
    for tick in range(round((emergency.allowed + 1.6) * HZ)):
        trail.tick()
        said = said or any(fault.name in emergency.says for fault in trail.plant.faults)
        if said and tick > (emergency.allowed + ENOUGH) * HZ:
            break
    last = max(arena.ran) if emergency.everyone else arena.ran[robot]
    emergency.end(trail, robot)
    return StopResult(max(0.0, last - began), said)


def settle(trail: FigureEight) -> None:
    """Drive until nothing is wrong and all have moved for half a second. Raises RuntimeError after 20 s."""
    calm = 0
    for _ in range(20 * HZ):
        trail.tick()
        now = trail.bed.arena.clock()
        moving = all(now - ran < 0.1 for ran in trail.bed.arena.ran)
        calm = calm + 1 if moving and not trail.plant.faults else 0
        if calm > HZ / 2:
            return
    raise RuntimeError(f"the robots did not drive on: {trail.plant.faults}")


def hang(trail: FigureEight) -> float:
    """The game hangs, and only the link's thread is left: seconds until the last motor stands."""
    settle(trail)
    began = trail.bed.arena.clock()
    for _ in range(HZ):
        trail.bed.link.pump()
        trail.bed.arena.advance(DT)
    return max(trail.bed.arena.ran) - began


def leave(trail: FigureEight) -> float:
    """The program ends, by itself or by an exception that closes its rig: seconds until the last motor stands."""
    settle(trail)
    began = trail.bed.arena.clock()
    trail.bed.rig.close()
    trail.bed.arena.advance(1.0)
    return max(trail.bed.arena.ran) - began


DRIVER = """
import sys, time
from pigaming_app.hardware.radio.serial_line import serial_port
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.signals import WheelCommand
link = Link(serial_port(sys.argv[1]), time.monotonic).start()
while True:
    link.send([WheelCommand(0.5, 0.4)] * 4)
    time.sleep(0.02)
"""


def kill(seed: int) -> float:
    """Another process drives the robots over a pseudo-terminal, in real time, and is killed with SIGKILL: seconds
    until the last motor stands. Raises OSError where there are no pseudo-terminals, ImportError without pyserial."""
    if find_spec("serial") is None:
        raise ImportError("pyserial is not installed")
    arena = EmulatedArena(seed, refresh=1000, begin=time.monotonic())
    with RealtimeArena(arena, terminal := PseudoTerminal()):
        driver = subprocess.Popen([sys.executable, "-c", DRIVER, terminal.name], cwd=ROOT)
        try:
            _until(lambda: all(robot.left_speed > 100.0 for robot in arena.robots))
            killed = arena.clock()
            os.kill(driver.pid, signal.SIGKILL)
        finally:
            driver.kill()
            driver.wait()
        _until(lambda: all(firmware.stopped for firmware in arena.firmwares))
        return max(arena.ran) - killed


def _until(true: Callable[[], bool], patience: float = 20.0) -> None:
    end = time.monotonic() + patience
    while not true():
        if time.monotonic() > end:
            raise RuntimeError("the emulated robots did not react")
        time.sleep(0.005)
