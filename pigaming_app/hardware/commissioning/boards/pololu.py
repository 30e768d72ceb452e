"""Pololu's robots with an RP2040 and an XBee: 3pi+ 2040 and Zumo 2040."""

from pigaming_app.hardware.commissioning.boards.kind import (
    XBEE,
    BoardAnswer,
    BoardKind,
    RobotRole,
    micropython_files,
)

MAKER, ZUMO = "pololu", "zumo"  # in the name of the machine, by Pololu's own MicroPython


def recognised(told: BoardAnswer) -> str:
    """The key of its kind, or empty."""
    machine = told.machine.lower()
    if told.platform != "rp2" or MAKER not in machine:
        return ""
    return "zumo_2040" if ZUMO in machine else "3pi_2040"


def _files(role: RobotRole) -> dict[str, bytes]:
    return micropython_files(role, "board_pololu_2040", XBEE, ("motors.py", f"{XBEE}.py", "robot.py"))


KINDS = {
    "3pi_2040": BoardKind("Pololu 3pi+ 2040", XBEE, _files),
    "zumo_2040": BoardKind("Pololu Zumo 2040", XBEE, _files),
}
