"""What robots must be able to do before anybody lets them drive, measured on the emulated arena.

`follow`: how well they are tracked. `stop`: how soon their motors stand when something goes wrong, and what is said of
it. `play`: a whole match, and how deep a robot gets into a wall. `kill`: the same when the program is killed.
"""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import atan2, degrees, hypot, pi, sin, sqrt, tau
from pathlib import Path
from random import Random
from typing import Any, NamedTuple, Protocol

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.live import Live, Terminal
from pigaming_app.hardware.plant import RealPlant
from pigaming_app.hardware.testbed import Bed
from pigaming_app.sim.action import press
from pigaming_app.sim.plant import Sighting, Twist
from pigaming_app.sim.robots import RADIUS
from pigaming_app.sim.sweep import off_wall
from pigaming_app.sim.world import DT, HEIGHT, HZ, ROBOTS, WIDTH, World

SPEED = 350.0  # mm/s
ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Followed:
    """How well four robots were tracked: against where they were at that moment, all dead time made up for."""

    rmse_mm: float
    rmse_deg: float
    tracker_ms: float  # a picture, on one core
    complete: float  # share of the pictures in which all four were found


class Trail:
    """Four robots that drive figures of eight, each in its quarter, steered by what the rig says."""

    def __init__(self, bed: Bed) -> None:
        self.bed, self.world = bed, World()
        for robot in self.world.robots:
            robot.present = 1
        self.plant = RealPlant(self.world, bed.rig)
        self._along = [0.0] * ROBOTS

    def tick(self) -> None:
        """1/50 s of it."""
        twists = [self._steered(i, sighting) for i, sighting in enumerate(self.plant.sense())]
        self.plant.drive(twists, DT)
        self.bed.tick()

    def _steered(self, robot: int, seen: Sighting) -> Twist:
        """At full pace towards a point of the figure that stays ahead."""
        for _ in range(50):
            x, y = self._figure(robot)
            if hypot(x - seen.x, y - seen.y) > 90.0:
                break
            self._along[robot] += 0.02
        aside = (atan2(y - seen.y, x - seen.x) - seen.heading + pi) % tau - pi
        return SPEED / self.bed.ground.mm, max(-3.0, min(3.0, 4.0 * aside))

    def _figure(self, robot: int) -> tuple[float, float]:
        middle_x, middle_y = 400.0 + 800.0 * (robot in (1, 2)), 225.0 + 450.0 * (robot in (2, 3))
        turn = self._along[robot] + robot
        return middle_x + 250.0 * sin(turn), middle_y + 110.0 * sin(2.0 * turn)


def follow(seed: int, fps: float, seconds: float) -> Followed:
    """Drive for so long at 0.35 m/s, after two seconds to get up speed."""
    bed = Bed(seed, fps)
    bed.find()
    trail, misses = Trail(bed), []
    for _ in range(2 * HZ):
        trail.tick()
    bed.count()
    for _ in range(round(seconds * HZ)):
        trail.tick()
        misses += bed.misses()
    tracker = bed.tracker
    return Followed(
        sqrt(sum(mm * mm for mm, _ in misses) / len(misses)),
        degrees(sqrt(sum(turned * turned for _, turned in misses) / len(misses))),
        1e3 * tracker.seconds / tracker.pictures,
        tracker.complete / tracker.pictures,
    )


class Emergency(NamedTuple):
    """Something goes wrong with a robot, or with all: how it begins and ends, and which faults must be named."""

    begin: Callable[[Trail, int], None]
    end: Callable[[Trail, int], None]
    says: str
    everyone: bool = False
    allowed: float = 0.0  # s that the table of faults itself allows before anything has to happen


def fault(name: str, says: str, everyone: bool = False, allowed: float = 0.0) -> Emergency:
    """A fault of the emulated arena as an emergency."""
    return Emergency(
        lambda trail, robot: trail.bed.arena.faults.switch(name, True, robot),
        lambda trail, robot: trail.bed.arena.faults.switch(name, False, robot),
        says,
        everyone,
        allowed,
    )


def _twice(on: bool) -> Callable[[Trail, int], None]:
    """Where a game shows hard edges, a second marker cannot always be read, and does no harm: so without them."""

    def double(trail: Trail, robot: int) -> None:
        trail.bed.show(busy=not on)
        trail.bed.arena.faults.switch("marker_twice", on, robot)

    return double


EMERGENCIES: Mapping[str, Emergency] = {
    "camera frozen": fault("camera_frozen", "camera", everyone=True),
    "camera gone": fault("camera_gone", "camera", everyone=True),
    "camera stuck": fault("camera_stuck", "camera", everyone=True),
    "marker covered": fault("marker_covered", "lost"),
    "marker upside down": fault("upside_down", "lost"),
    "marker in a hand": fault("marker_held", "lost"),
    "marker twice": Emergency(_twice(True), _twice(False), "twice"),
    "radio dead": fault("radio_dead", "silent", everyone=True),
    "radio unplugged": fault("radio_unplugged", "radio", everyone=True),
    "robot mute": fault("robot_mute", "silent", allowed=1.0),
    "robot off": fault("robot_off", "silent"),
    "battery empty": fault("battery_low", "empty"),
    "all-stop": Emergency(
        lambda trail, _: trail.plant.safety.all_stop(), lambda trail, _: trail.plant.safety.release(), "stopped", True
    ),
    "camera bumped": fault("camera_bumped", "drift", everyone=True, allowed=1.0),
}


class Stopped(NamedTuple):
    """How an emergency went."""

    seconds: float  # from its beginning to when the last motor concerned was last given anything
    said: bool  # whether the fault was named


def stop(trail: Trail, name: str, robot: int = 1) -> Stopped:
    """Let it happen to moving robots, and end again; they must drive as before."""
    emergency, arena = EMERGENCIES[name], trail.bed.arena
    _settle(trail)
    began = arena.clock() + emergency.allowed
    emergency.begin(trail, robot)
    said = False
    for _ in range(round((emergency.allowed + 1.6) * HZ)):
        trail.tick()
        said = said or emergency.says in [fault.name for fault in trail.plant.faults]
    last = max(arena.ran) if emergency.everyone else arena.ran[robot]
    emergency.end(trail, robot)
    return Stopped(max(0.0, last - began), said)


def _settle(trail: Trail) -> None:
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


def hang(trail: Trail) -> float:
    """The game hangs, and only the link's thread is left: seconds until the last motor stands."""
    _settle(trail)
    began = trail.bed.arena.clock()
    for _ in range(HZ):
        trail.bed.link.pump()
        trail.bed.arena.advance(DT)
    return max(trail.bed.arena.ran) - began


def leave(trail: Trail) -> float:
    """The program ends, by itself or by an exception that closes its rig: seconds until the last motor stands."""
    _settle(trail)
    began = trail.bed.arena.clock()
    trail.bed.rig.close()
    trail.bed.arena.advance(1.0)
    return max(trail.bed.arena.ran) - began


DRIVER = """
import sys, time
from pigaming_app.hardware.line import serial_port
from pigaming_app.hardware.link import Link
from pigaming_app.hardware.signals import Wheels
link = Link(serial_port(sys.argv[1]), time.monotonic).start()
while True:
    link.send([Wheels(0.5, 0.4)] * 4)
    time.sleep(0.02)
"""


def kill(seed: int) -> float:
    """Another process drives the robots over a pseudo-terminal, in real time, and is killed with SIGKILL: seconds
    until the last motor stands. Raises OSError where there are no pseudo-terminals."""
    arena = EmulatedArena(seed, refresh=1000, begin=time.monotonic())
    with Live(arena, terminal := Terminal()):
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


class Playable(Protocol):
    """The part of a match that is played here."""

    state: Any
    plant: Any

    @property
    def over(self) -> bool: ...

    def tick(self) -> None: ...


class Masher:
    """A seat at which somebody mashes all buttons and throws the stick about."""

    def __init__(self, seed: int) -> None:
        self._random = Random(f"masher {seed}")
        self._ticks = 0
        self._held = (0.0, 0.0, 0, 0)

    def think(self, state: Any, seat: int) -> None:
        """Hold on to something for up to a second."""
        random = self._random
        if not self._ticks:
            self._ticks = random.randrange(3, HZ)
            linear = random.choice((-64, -32, 48, 64, 64, 64)) / 64
            self._held = (
                linear,
                random.choice((-64, -20, 0, 0, 20, 64)) / 64,
                random.randrange(2),
                random.randrange(2),
            )
        self._ticks -= 1
        press(state.actions[seat], *self._held)


class Played(NamedTuple):
    """How a match on the mat went."""

    deepest_mm: float  # into a wall or over the arena's edge
    seconds: float  # of simulated time, pauses and all
    paused: float
    places: float  # s until all had taken their places


def play(bed: Bed, match: Playable, seconds: float) -> Played:
    """Let the robots take their places and play to the end. Raises RuntimeError if either takes too long.

    Pauses are as the arcade makes them: as long as a fault that pauses is there, nobody plays.
    """
    plant: RealPlant = match.plant
    ready = 0
    while not plant.take_places():
        ready += 1
        bed.tick()
        if ready > 90 * HZ:
            raise RuntimeError(f"not all took their places: {plant.places}, {plant.faults}")
    bed.show(busy=True)
    deepest, ticks, paused = 0.0, 0, 0
    while not match.over:
        if plant.safety.pauses:
            plant.watch()
            paused += 1
        else:
            match.tick()
        bed.tick()
        ticks += 1
        deepest = max(deepest, *(entered(match.state, x, y) for x, y, _ in bed.arena.poses()))
        if ticks > 1.5 * HZ * seconds + 20 * HZ:
            raise RuntimeError(f"the match did not end: {plant.faults}")
    return Played(deepest * bed.ground.mm, ticks * DT, paused * DT, ready * DT)


def entered(world: Any, x: float, y: float) -> float:
    """How far, in px, a robot at (x, y) is in a wall that stands or over the edge; negative: how far it is from it."""
    depths = [RADIUS - x, RADIUS - y, x + RADIUS - WIDTH, y + RADIUS - HEIGHT]
    for i in range(world.wall_count):
        wall = world.walls[i]
        if wall.health:
            depths.append(wall.half + RADIUS - hypot(*off_wall(wall, x, y)))
    return max(depths)
