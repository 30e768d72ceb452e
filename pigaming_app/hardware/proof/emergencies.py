"""Stopping times of the motors in every emergency, measured on the emulated arena.

`stop` injects and clears one fault of EMERGENCIES; `hang` and `leave` end the driving program in two ways. For Wi-Fi
robots `wifi_faults` does the same: their own program, in MicroPython, stops the motors. For the ends of whole arcades
see `outside`.
"""

from collections.abc import Callable, Mapping
from math import hypot, inf, pi
from random import Random
from typing import NamedTuple

from pigaming_app.hardware.commissioning.pairing import Pairing, PairingCase
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.emulator.robots import EmulatedRobot
from pigaming_app.hardware.emulator.wifi.air import WifiChannel
from pigaming_app.hardware.proof.testbed import Testbed
from pigaming_app.hardware.proof.trials import FigureEight
from pigaming_app.sim.world import DT, HEIGHT, HZ, ROBOTS, WIDTH, World

LOSSY = WifiChannel(0.002, 0.040, loss=0.05, duplicates=0.02)  # overtaking included
WIFI_FAULTS = ("radio dead", "robot mute", "robot off", "battery empty", "all-stop")  # of EMERGENCIES
LISTEN = 3  # s, within which robots announce themselves and report
ENOUGH = 0.6  # s of observation after the fault is reported
BREAKDOWNS = ("pinned", "motor_dead", "motors_swapped", "motors_reversed", "motor_reversed")  # mechanical faults
EFFECT = 10.0  # mm from where an obedient robot is: swapped wheels have no effect on a straight way
NOTICED = 2.0  # s within which a mechanical fault must be noticed
MISWIRED = ("lids_swapped", "motors_swapped", "motors_reversed", "motor_reversed")  # faults that lead out of the arena
STANDING, MARGIN = 1.5, 5.0  # s at rest before a miswired robot drives; px at which virtual walls stop a robot
GAPS, HEADINGS = (0.0, 60.0, 240.0), (0.0, pi, 2.5, 0.6)  # px of a robot from the edge; rad, 0: away from it


class Emergency(NamedTuple):
    """A fault of one robot or of all: functions that begin and end it, and the reports it must cause."""

    begin: Callable[[FigureEight, int], None]
    end: Callable[[FigureEight, int], None]
    reports: tuple[str, ...]  # fault names of `safety`, at least one of which must be reported
    everyone: bool = False  # True: all robots must stop
    allowed: float = 0.0  # s that the rules of `safety` allow before a reaction


def fault(name: str, *reports: str, everyone: bool = False, allowed: float = 0.0) -> Emergency:
    """A fault of the emulated arena as an emergency."""
    return Emergency(
        lambda trail, robot: trail.bed.arena.faults.switch(name, True, robot),
        lambda trail, robot: trail.bed.arena.faults.switch(name, False, robot),
        reports,
        everyone,
        allowed,
    )


def _twice(on: bool) -> Callable[[FigureEight, int], None]:
    """A duplicate marker on a dark floor: on a busy one it cannot always be read, and then does no harm."""

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


class Breakdown(NamedTuple):
    """Result of a mechanical fault: seconds from its first effect, EFFECT, until the motors were off, and how far the
    robot came off the way that it was commanded, mm.
    """

    seconds: float
    mm: float


class StopResult(NamedTuple):
    """Result of an emergency."""

    seconds: float  # from the fault, or the end of `allowed`, until the last affected motor stopped
    reported: bool  # True if the fault was reported


def stop(trail: FigureEight, name: str, robot: int = 1) -> StopResult:
    """Inject a fault into moving robots, measure, and clear it. Raises RuntimeError if they did not drive before."""
    emergency, arena = EMERGENCIES[name], trail.bed.arena
    settle(trail)
    began = arena.clock() + emergency.allowed
    emergency.begin(trail, robot)
    reported = False
    for tick in range(round((emergency.allowed + 1.6) * HZ)):
        trail.tick()
        reported = reported or any(fault.name in emergency.reports for fault in trail.plant.faults)
        if reported and tick > (emergency.allowed + ENOUGH) * HZ:
            break
    last = max(arena.last_driven) if emergency.everyone else arena.last_driven[robot]
    emergency.end(trail, robot)
    return StopResult(max(0.0, last - began), reported)


def break_down(trail: FigureEight, name: str, robot: int) -> Breakdown:
    """Break a driving robot, one of BREAKDOWNS, and mend it. Raises RuntimeError if nothing is noticed, or none drove.

    An obedient twin, which gets the voltages of the broken one's motors, shows the way that was commanded.
    """
    settle(trail)
    arena, body = trail.bed.arena, trail.bed.arena.robots[robot]
    twin = EmulatedRobot(body.body, body.x, body.y, body.heading, Random(0))
    twin.left_speed, twin.right_speed = body.left_speed, body.right_speed
    roll, way, away, began = body.roll, [(body.x, body.y)], 0.0, inf

    def both() -> None:
        nonlocal away, began
        twin.left, twin.right = body.left, body.right
        twin.roll()
        roll()
        way.append((twin.x, twin.y))
        away = max(away, min(hypot(body.x - x, body.y - y) for x, y in way))
        if hypot(body.x - twin.x, body.y - twin.y) > EFFECT:
            began = min(began, arena.clock())

    arena.faults.switch(name, True, robot)
    vars(body)["roll"] = both
    try:
        for _ in range(round(NOTICED * HZ)):
            trail.tick()
            if trail.plant.safety.latched and arena.clock() - arena.last_driven[robot] > 2.0 * DT:
                break
        else:
            raise RuntimeError(f"{name}: the fault was not noticed")
    finally:
        del vars(body)["roll"]
        arena.faults.switch(name, False, robot)
    stopped = arena.last_driven[robot] - began
    for _ in range(HZ):
        trail.tick()
    for latched in trail.plant.safety.latched:
        trail.plant.clear_fault(latched)
    return Breakdown(stopped, away)


def gone_over_edge(bed: Testbed, name: str, gap: float, heading: float, speed: float) -> float:
    """How far the body of a miswired robot comes out of the arena, mm, where it drives at `speed`, px/s, from `gap` px
    off the edge: one of MISWIRED. Below 0: it stays inside.
    """
    arena, radius, outside = bed.arena, bed.body_mm / bed.ground.mm, -inf
    bed.rig.send([None] * ROBOTS)  # they stand when they are set down
    for _ in range(HZ // 2):
        bed.tick()
    others = ((900.0, 450.0, 0.4), (1500.0, 100.0, 3.0), (1100.0, 800.0, 0.0))
    for robot, pose in enumerate(((radius + MARGIN + gap, 450.0, heading), *others)):
        arena.place(robot, pose)
    arena.faults.switch(name, True, 0)
    world = World()
    for body in world.robots:
        body.present = 1
    plant = RealPlant(world, bed.rig)
    for tick in range(round((STANDING + NOTICED) * HZ)):
        twist = (speed, 0.0) if tick > STANDING * HZ else (0.0, 0.0)
        if tick < STANDING * HZ:  # they were carried
            for latched in plant.safety.latched:
                plant.clear_fault(latched)
        plant.sense()
        if plant.safety.pauses:
            plant.watch()
        else:
            plant.drive([twist] * ROBOTS, DT)
        bed.tick()
        outside = max(outside, *(radius + max(-x, x - WIDTH, -y, y - HEIGHT) for x, y, _ in arena.poses()))
    arena.faults.switch(name, False, 0)
    return outside * bed.ground.mm


def settle(trail: FigureEight) -> None:
    """Drive until all robots have moved without faults for half a second. Raises RuntimeError after 20 s."""
    calm = 0
    for _ in range(20 * HZ):
        trail.tick()
        now = trail.bed.arena.clock()
        moving = all(now - ran < 0.1 for ran in trail.bed.arena.last_driven)
        calm = calm + 1 if moving and not trail.plant.faults else 0
        if calm > HZ / 2:
            return
    raise RuntimeError(f"the robots did not drive on: {trail.plant.faults}")


def hang(trail: FigureEight) -> float:
    """Seconds until the last motor stops after the game hangs and only the link's thread still runs."""
    settle(trail)
    began = trail.bed.arena.clock()
    for _ in range(HZ):
        trail.bed.link.pump()
        trail.bed.arena.advance(DT)
    return max(trail.bed.arena.last_driven) - began


def leave(trail: FigureEight) -> float:
    """Seconds until the last motor stops after the program ends, normally or by an exception, and closes its rig."""
    settle(trail)
    began = trail.bed.arena.clock()
    trail.bed.rig.close()
    trail.bed.arena.advance(1.0)
    return max(trail.bed.arena.last_driven) - began


def wifi_faults(seed: int, channel: WifiChannel = LOSSY) -> dict[str, float]:
    """Stopping times, s, of paired robots in the emulated arena. Raises RuntimeError if a fault is not reported."""
    bed = Testbed(seed, 30.0, wifi=channel)
    try:
        bed.session.find()
        pair(bed)
        trail = FigureEight(bed)
        stops = {}
        for i, name in enumerate(WIFI_FAULTS):
            result = stop(trail, name, i % ROBOTS)
            if not result.reported:
                raise RuntimeError(f"{name}: the fault was not reported")
            stops[name] = result.seconds
        return stops | {"program hangs": hang(trail), "program ends": leave(trail)}
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
