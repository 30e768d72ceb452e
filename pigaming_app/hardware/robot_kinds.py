"""Kinds of robots: battery limits, size and radio of each.

A robot on Wi-Fi announces its board; that of any other is a setting, by default the 3pi. Battery limits are for four
rechargeable cells; the firmware of a robot applies its own limits in addition.
"""

from typing import NamedTuple


class RobotKind(NamedTuple):
    """One kind of robot."""

    key: str  # in the settings
    name: str  # proper name, the same in every language
    radios: tuple[str, ...]  # xbee, wifi, relay (a micro:bit on USB passes packets on)
    boards: tuple[int, ...]  # numbers in the announcements of its firmware
    warn_mv: int  # battery voltage below which the operator is warned
    stop_mv: int  # below which motors are off
    radius_mm: float  # of the smallest circle round the driving robot, centred between the wheels


KINDS = (
    RobotKind("3pi", "Pololu 3pi", ("xbee",), (), 4400, 4000, 47.5),
    RobotKind("esp32", "ESP32", ("wifi", "xbee"), (1,), 4400, 4000, 60.0),
    RobotKind("pico_w", "Pico W", ("wifi", "xbee"), (2,), 4400, 4000, 60.0),
    RobotKind("3pi_2040", "Pololu 3pi+ 2040", ("xbee",), (3,), 4400, 4000, 49.0),
    RobotKind("zumo_2040", "Pololu Zumo 2040", ("xbee",), (), 4400, 4000, 70.0),  # 99 mm square: half its diagonal
    RobotKind("microbit", "micro:bit", ("relay",), (4,), 4600, 4400, 60.0),  # its motor board needs 4.5 V
)
DEFAULT = KINDS[0]


def robot_kind(chosen: str, board: int | None = None) -> RobotKind:
    """The kind of a robot: as chosen in the settings; else, if that is empty or unknown, by its announced board."""
    named = next((kind for kind in KINDS if kind.key == chosen), None)
    return named or next((kind for kind in KINDS if board in kind.boards), DEFAULT)
