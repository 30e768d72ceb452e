"""Pololu's robots with an RP2040 and an XBee: 3pi+ 2040 and Zumo 2040."""

from pigaming_app.hardware.commissioning.boards.kind import (
    XBEE,
    BoardAnswer,
    BoardKind,
    RobotRole,
    micropython_files,
)

MAKER = "pololu"  # in the name of the machine, by Pololu's own MicroPython


def recognised(told: BoardAnswer) -> str:
    """The key of its kind, or empty."""
    return "pololu_2040" if told.platform == "rp2" and MAKER in told.machine.lower() else ""


def _files(role: RobotRole) -> dict[str, bytes]:
    return micropython_files(role, "board_pololu_2040", XBEE, ("motors.py", f"{XBEE}.py", "robot.py"))


KINDS = {"pololu_2040": BoardKind("Pololu 2040", XBEE, _files)}
