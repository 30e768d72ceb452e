"""Fault injection in the emulated arena, by name: each fault can be switched on and off at any time.

Some faults affect the camera or the radio, others one robot.
"""

from dataclasses import replace
from math import atan2, cos, hypot, sin
from typing import Any

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

FAULTS = {
    "camera_frozen": "no picture arrives any more, though the camera is connected",
    "camera_stuck": "the same picture arrives repeatedly",
    "camera_gone": "the camera is unplugged",
    "camera_bumped": "the camera was bumped and looks elsewhere",
    "frames_dropped": "two of three pictures are lost",
    "exposure_step": "the brightness suddenly halves",
    "marker_covered": "a hand lies on the lid",
    "marker_twice": "a second marker with the same number lies on the mat",
    "marker_held": "somebody holds and moves the robot in the air",
    "upside_down": "somebody holds the robot upside down",
    "carried": "somebody carries the robot to another place",
    "radio_dead": "no packet gets through",
    "radio_lossy": "a third of the packets are lost",
    "radio_unplugged": "the radio is unplugged from the computer",
    "garbage": "random bytes arrive on every line",
    "battery_low": "the battery of the robot is at 3.9 V",
    "robot_off": "the robot is switched off",
    "robot_mute": "the robot receives commands, but its reports are lost",
    "old_firmware": "the robot has firmware 1, which knows neither arena ids nor today's packets",
    "no_arena": "the robot was flashed without an arena id",
    "other_arena": "the robot was flashed with the id of another arena",
    "pinned": "a hand holds the robot down on the mat",
    "lids_swapped": "the robot and the next one wear each other's lids",
    "motors_swapped": "the motors of the robot are connected to each other's outputs",
    "motors_reversed": "both motors of the robot have reversed polarity",
    "motor_reversed": "the left motor of the robot has reversed polarity",
    "motor_dead": "the left motor of the robot has lost a wire",
}
CAMERA = {"camera_frozen": "frozen", "camera_stuck": "stuck", "camera_gone": "gone"}
RADIO = {"radio_dead": "dead", "radio_unplugged": "unplugged"}
HELD_AT, TURNED_AT, CARRIED_AT = 400.0, 60.0, 120.0  # mm above the mat
CARRY_SPEED, CARRY_WAY = 600.0, 500.0  # mm/s, mm
DARKER = 0.5  # gain
BUMP = 25.0  # mm, shift of the camera's aim
HAND = 56.0  # mm, radius
EMPTY_CELLS = 3.9  # V

Onset = tuple[float, Placing]  # s, (mm, mm, rad): start of the fault, and the robot's pose then


class FaultInjector:
    """The active faults: `switch` changes them, `tick` and `things` apply them. `arena`: an EmulatedArena."""

    def __init__(self, arena: Any) -> None:
        self._arena = arena
        self._robots: dict[str, dict[int, Onset]] = {name: {} for name in FAULTS}

    def switch(self, name: str, on: bool, robot: int = 0) -> None:
        """Switch a fault on or off, for one robot if it affects robots. Raises ValueError for an unknown name."""
        if name not in FAULTS:
            raise ValueError(f"no fault {name!r}; there are {', '.join(FAULTS)}")
        arena = self._arena
        target, affected = arena.robots[robot], self._robots[name]
        if on:
            affected[robot] = arena.clock(), (target.x, target.y, target.heading)
        else:
            affected.pop(robot, None)
        if name in CAMERA:
            setattr(arena.camera, CAMERA[name], on)
        elif name in RADIO:
            setattr(arena.radio, RADIO[name], on)
        elif name in ("marker_held", "upside_down", "carried") and not on:
            target.height = 0.0
        elif name == "camera_bumped":
            lens = arena.optics.lens
            aim = (lens.aim[0] + BUMP, lens.aim[1])
            arena.camera.painter.look_through(Optics(replace(lens, aim=aim)) if on else arena.optics)
        elif name == "frames_dropped":
            arena.camera.extra_drops = 0.67 * on
        elif name == "exposure_step":
            arena.gain = DARKER if on else 1.0
        elif name == "radio_lossy":
            arena.radio.extra_loss = 0.33 * on
        elif name == "garbage":
            arena.radio.extra_garbage = 300.0 * on  # bytes a second
        elif name == "battery_low":
            target.battery = EMPTY_CELLS if on else target.body.battery
        elif name == "robot_off":
            target.powered = not on
        elif name == "robot_mute":
            arena.firmwares[robot].mute = on
        elif name == "old_firmware":
            arena.firmwares[robot].version = 1 if on else 2
        elif name in ("no_arena", "other_arena"):
            other = 0 if name == "no_arena" else arena.arena_id + 1
            arena.firmwares[robot].arena = other if on else arena.arena_id
        elif name == "pinned":
            target.pinned = on
        elif name == "motors_swapped":
            target.swapped = on
        elif name == "motor_dead":
            target.polarity = [0.0 if on else 1.0, 1.0]
        elif name in ("motors_reversed", "motor_reversed"):
            target.polarity = [-1.0 if on else 1.0, -1.0 if on and name == "motors_reversed" else 1.0]

    def on(self) -> list[tuple[str, int]]:
        """The active faults, each with the robot it was switched on for."""
        return [(name, robot) for name, robots in self._robots.items() for robot in robots]

    def tick(self, now: float) -> None:
        """Move the robots that are held or carried."""
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
        """The marker number on a robot's lid."""
        lids: list[int] = self._arena.lids
        for first in self._robots["lids_swapped"]:
            pair = first, (first + 1) % len(lids)
            if robot in pair:
                return lids[sum(pair) - robot]
        return lids[robot]

    def things(self, robot: int, poses: tuple[Placing, ...]) -> list[FlatObject]:
        """The visible objects of a robot with these poses, faults included."""
        height = self._arena.robots[robot].height
        x, y, _ = poses[-1]
        if robot in self._robots["upside_down"]:
            return [FlatObject(underside(), LID_HEIGHT + height, poses)]
        seen = [
            FlatObject(body(), BODY_HEIGHT + height, poses[-1:], dark=True),
            FlatObject(lid(self._worn(robot)), LID_HEIGHT + height, poses),
        ]
        if robot in self._robots["marker_covered"]:
            seen.append(FlatObject(hand(), LID_HEIGHT + 30.0, poses[-1:], HAND))
        if height:
            seen.append(FlatObject(hand(), BODY_HEIGHT + height, ((x + 45.0, y + 45.0, -0.8),), HAND))
        if robot in self._robots["marker_twice"]:
            _, (x, y, heading) = self._robots["marker_twice"][robot]
            away = hypot(x, y) or 1.0
            near = x * (1 - 300.0 / away), y * (1 - 300.0 / away), heading + 1.0
            seen.append(FlatObject(card(self._arena.lids[robot]), 0.0, (near,)))
        return seen
