"""Micro:bits: robots, also on a bought chassis, and the relay on the computer's USB port.

They have one file only and cannot rename: a part of it does nothing, since its last line starts it.
"""

from functools import partial
from time import sleep
from typing import Any

from pigaming_app.hardware.commissioning.boards.kind import MAIN, MICROBIT, BoardAnswer, BoardKind, RobotRole
from pigaming_app.hardware.robot_kinds import PROGRAM, RELAY, microbit_program

FOLDER = PROGRAM / "microbit"
VENDOR = 0x0D28  # DAPLink's, of the USB chip
PLATFORM = "microbit"
OLDEST = (1, 15)  # version of MicroPython; that of a V1 is 1.9
RATE, END_RELAY = 57_600, 64 * b"\3"  # bit/s; bytes that end the program of a relay
RELAY_ENDS = 0.2  # s


def recognised(told: BoardAnswer) -> str:
    """The key of its kind, or empty."""
    return "microbit" if told.platform == PLATFORM and told.version >= OLDEST else ""


def end_relay(line: Any, rate: int) -> None:
    """End the program of a relay on this serial line, to which Ctrl-C is data; others take it for noise."""
    line.baudrate = RATE
    line.write(END_RELAY)
    line.flush()
    sleep(RELAY_ENDS)
    line.baudrate = rate


def _files(chassis: str, role: RobotRole) -> dict[str, bytes]:
    return {MAIN: microbit_program(role.robot, role.arena, chassis).encode()}


def _relay(role: RobotRole) -> dict[str, bytes]:
    return {MAIN: microbit_program(RELAY, role.arena).encode()}


KINDS = {
    "microbit": BoardKind("micro:bit", MICROBIT, partial(_files, "")),
    "cutebot": BoardKind("Cutebot", MICROBIT, partial(_files, "cutebot")),
    "maqueen": BoardKind("Maqueen", MICROBIT, partial(_files, "maqueen")),
    "relay": BoardKind("micro:bit", MICROBIT, _relay),
}
