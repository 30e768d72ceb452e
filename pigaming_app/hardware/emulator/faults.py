"""What can go wrong in the emulated arena, by name: each fault can be switched on and off at any time.

Some of them strike the camera or the radio, others one robot.
"""

from dataclasses import replace
from math import atan2, cos, hypot, sin
from typing import Protocol

from pigaming_app.hardware.emulator.camera import EmulatedCamera
from pigaming_app.hardware.emulator.firmware import Firmware
from pigaming_app.hardware.emulator.objects import (
    BODY_HEIGHT,
    LID_HEIGHT,
    FlatObject,
    Placing,
    body,
    card,
    hand,
    lid,
    underside,
)
from pigaming_app.hardware.emulator.optics import Optics
from pigaming_app.hardware.emulator.radio import EmulatedRadio
from pigaming_app.hardware.emulator.robots import EmulatedRobot

FAULTS = {
    "camera_frozen": "no picture arrives any more, though the camera is there",
    "camera_stuck": "the same picture arrives again and again",
    "camera_gone": "the camera is unplugged",
    "camera_bumped": "somebody ran into the camera, and it looks elsewhere",
    "frames_dropped": "two pictures of three are lost",
    "exposure_step": "pictures are half as bright at once",
    "marker_covered": "a hand lies on the lid",
    "marker_twice": "a second marker of the same number lies on the mat",
    "marker_held": "somebody holds the robot in the air, and not still",
    "upside_down": "somebody holds the robot with its wheels up",
    "carried": "somebody carries the robot to another place",
    "radio_dead": "nothing goes through the air",
    "radio_lossy": "a third of the packets is lost",
    "radio_unplugged": "the radio is pulled out of the computer",
    "garbage": "rubbish comes on every line",
    "battery_low": "the cells of the robot have 3.9 V",
    "robot_off": "the robot is switched off",
    "robot_mute": "the robot hears, but nothing that it says arrives",
    "pinned": "a hand holds the robot down on the mat",
    "lids_swapped": "the robot and the next one wear each other's lids",
    "motors_swapped": "the left motor of the robot is connected in the place of the right one",
    "motors_reversed": "both motors of the robot are connected the wrong way round",
    "motor_reversed": "the left motor of the robot is connected the wrong way round",
}
CAMERA = {"camera_frozen": "frozen", "camera_stuck": "stuck", "camera_gone": "gone"}
RADIO = {"radio_dead": "dead", "radio_unplugged": "unplugged"}
HELD_AT, TURNED_AT, CARRIED_AT = 400.0, 60.0, 120.0  # mm over the mat
CARRY_SPEED, CARRY_WAY = 600.0, 500.0  # mm/s, mm
DARKER = 0.5
BUMP = 25.0  # mm by which the camera looks beside where it did
HAND = 56.0  # mm, reach
EMPTY_CELLS = 3.9  # V

Taken = tuple[float, Placing]  # s, mm, mm, rad: when the fault began, and where the robot was then


class FaultyArena(Protocol):
    """The parts of an arena that can fail."""

    robots: list[EmulatedRobot]
    firmwares: list[Firmware]
    radio: EmulatedRadio
    camera: EmulatedCamera
    optics: Optics
    gain: float  # of the exposure

    def clock(self) -> float: ...


class FaultInjector:
    """The faults that are on: `switch` changes that, `tick` and `things` let them do what they do."""

    def __init__(self, arena: FaultyArena) -> None:
        self._arena = arena
        self._robots: dict[str, dict[int, Taken]] = {name: {} for name in FAULTS}

    def switch(self, name: str, on: bool, robot: int = 0) -> None:
        """Switch a fault on or off, if it strikes a robot: for that one. Raises ValueError for an unknown name."""
        if name not in FAULTS:
            raise ValueError(f"no fault {name!r}; there are {', '.join(FAULTS)}")
        arena = self._arena
        struck, strikes = arena.robots[robot], self._robots[name]
        if on:
            strikes[robot] = arena.clock(), (struck.x, struck.y, struck.heading)
        else:
            strikes.pop(robot, None)
        if name in CAMERA:
            setattr(arena.camera, CAMERA[name], on)
        elif name in RADIO:
            setattr(arena.radio, RADIO[name], on)
        elif name in ("marker_held", "upside_down", "carried") and not on:
            struck.height = 0.0
        elif name == "camera_bumped":
            lens = arena.optics.lens
            aim = (lens.aim[0] + BUMP, lens.aim[1])
            arena.camera.painter.look_through(Optics(replace(lens, aim=aim)) if on else arena.optics)
        elif name == "frames_dropped":
            arena.camera.more_drops = 0.67 * on
        elif name == "exposure_step":
            arena.gain = DARKER if on else 1.0
        elif name == "radio_lossy":
            arena.radio.more_loss = 0.33 * on
        elif name == "garbage":
            arena.radio.more_garbage = 300.0 * on  # bytes a second
        elif name == "battery_low":
            struck.battery = EMPTY_CELLS if on else struck.body.battery
        elif name == "robot_off":
            struck.powered = not on
        elif name == "robot_mute":
            arena.firmwares[robot].mute = on
        elif name == "pinned":
            struck.pinned = on
        elif name == "motors_swapped":
            struck.swapped = on
        elif name in ("motors_reversed", "motor_reversed"):
            struck.polarity = [-1.0 if on else 1.0, -1.0 if on and name == "motors_reversed" else 1.0]

    def on(self) -> list[tuple[str, int]]:
        """Every fault that is on, with the robot that it was switched on for."""
        return [(name, robot) for name, robots in self._robots.items() for robot in robots]

    def tick(self, now: float) -> None:
        """Hands move what they hold."""
        for robot, (since, (x, y, heading)) in self._robots["marker_held"].items():
            held, time = self._arena.robots[robot], now - since
            held.height = HELD_AT
            held.x, held.y = x + 25.0 * sin(5.0 * time), y + 25.0 * sin(3.7 * time)
            held.heading = heading + 0.4 * sin(4.3 * time)
        for robot in self._robots["upside_down"]:
            self._arena.robots[robot].height = TURNED_AT
        for robot, (since, (x, y, heading)) in self._robots["carried"].items():
            carried, time = self._arena.robots[robot], now - since
            carried.height = min(CARRIED_AT, 900.0 * time)
            way, towards = min(CARRY_WAY, CARRY_SPEED * time), atan2(-y, -x)
            carried.x, carried.y = x + way * cos(towards), y + way * sin(towards)
            carried.heading = heading + 0.004 * way

    def _worn(self, robot: int) -> int:
        """The number on a robot's lid."""
        for one in self._robots["lids_swapped"]:
            pair = one, (one + 1) % len(self._arena.robots)
            if robot in pair:
                return sum(pair) - robot
        return robot

    def things(self, robot: int, poses: tuple[Placing, ...]) -> list[FlatObject]:
        """What the camera sees of a robot with these poses, faults and all."""
        height = self._arena.robots[robot].height
        x, y, _ = poses[-1]
        if robot in self._robots["upside_down"]:
            return [FlatObject(underside(), LID_HEIGHT + height, poses)]
        seen = [
            FlatObject(body(), BODY_HEIGHT + height, poses[-1:], dull=True),
            FlatObject(lid(self._worn(robot)), LID_HEIGHT + height, poses),
        ]
        if robot in self._robots["marker_covered"]:
            seen.append(FlatObject(hand(), LID_HEIGHT + 30.0, poses[-1:], HAND))
        if height:
            seen.append(FlatObject(hand(), BODY_HEIGHT + height, ((x + 45.0, y + 45.0, -0.8),), HAND))
        if robot in self._robots["marker_twice"]:
            _, (x, y, heading) = self._robots["marker_twice"][robot]
            away = hypot(x, y) or 1.0
            seen.append(
                FlatObject(card(robot), 0.0, ((x * (1 - 300.0 / away), y * (1 - 300.0 / away), heading + 1.0),))
            )
        return seen
