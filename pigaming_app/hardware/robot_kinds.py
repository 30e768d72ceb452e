"""Kinds of robots: battery limits, size and radio of each; files and commands that set them up.

A robot on Wi-Fi announces its board; that of any other is a setting, by default the 3pi. Battery limits are for four
rechargeable cells; the firmware of a robot applies its own limits in addition.
"""

from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

PROGRAM = Path(__file__).parent / "firmware" / "micropython"
RELAY = 0  # number of the micro:bit on USB


class RobotKind(NamedTuple):
    """One kind of robot."""

    key: str  # in the settings
    name: str  # proper name, the same in every language
    radios: tuple[str, ...]  # xbee, wifi, relay (a micro:bit on USB passes packets on), thymio (Aseba)
    boards: tuple[int, ...]  # numbers in the announcements of its firmware
    warn_mv: int  # battery voltage below which the operator is warned
    stop_mv: int  # below which motors are off
    radius_mm: float  # of the smallest circle round the driving robot, centred between the wheels
    wheel_mm: float = 1000.0  # speed of a wheel at full share, mm/s, until the robot is identified
    base_mm: float = 82.0  # between the wheels


KINDS = (
    RobotKind("3pi", "Pololu 3pi", ("xbee",), (), 4400, 4000, 47.5),
    RobotKind("esp32", "ESP32", ("wifi", "xbee"), (1,), 4400, 4000, 60.0),
    RobotKind("pico_w", "Pico W", ("wifi", "xbee"), (2,), 4400, 4000, 60.0),
    RobotKind("kit", "Kit", ("wifi",), (), 4400, 4000, 47.5),  # a Pico W on the chassis of docs/kit.md
    RobotKind("3pi_2040", "Pololu 3pi+ 2040", ("xbee",), (3,), 4400, 4000, 49.0),
    RobotKind("zumo_2040", "Pololu Zumo 2040", ("xbee",), (), 4400, 4000, 70.0),  # 99 mm square: half its diagonal
    RobotKind("microbit", "micro:bit", ("relay",), (4,), 4600, 4400, 60.0),  # its motor board needs 4.5 V
    RobotKind("cutebot", "Cutebot", ("relay",), (), 0, 0, 75.0),  # measures no battery, nor does the next
    RobotKind("maqueen", "Maqueen", ("relay",), (), 0, 0, 70.0),
    RobotKind("thymio", "Thymio II", ("thymio",), (), 3500, 3400, 82.0, 166.0, 94.0),  # of Enki, Aseba's simulator
)
DEFAULT = KINDS[0]
CHASSIS = ("cutebot", "maqueen")  # bought ones that a micro:bit is plugged into


def robot_kind(chosen: str, board: int | None = None, usual: RobotKind = DEFAULT) -> RobotKind:
    """The kind of a robot: as chosen in the settings; else, if that is empty or unknown, by its announced board; else
    the `usual` one of its driver.
    """
    named = next((kind for kind in KINDS if kind.key == chosen), None)
    return named or next((kind for kind in KINDS if board in kind.boards), usual)


def widest_radius(chosen: Iterable[str], usual: RobotKind = DEFAULT) -> float:
    """Radius of the widest of some robots, mm; see `robot_kind`."""
    return max(robot_kind(key, None, usual).radius_mm for key in chosen)


def robot_config(robot: int, arena: int, key: bytes) -> str:
    """`config.py` of a Wi-Fi robot (1 to 4): the example with the values of this arena."""
    text = (PROGRAM / "config_example.py").read_text("utf-8")
    text = text.replace("ROBOT = 1", f"ROBOT = {robot}").replace("Robot 1", f"Robot {robot}")
    return text.replace("ARENA = 0", f"ARENA = {arena}").replace("0" * 32, key.hex())


def microbit_program(number: int, arena: int, chassis: str = "") -> str:
    """The program of a micro:bit: of robot 1 to 4, or of the RELAY. `chassis`: one of CHASSIS, else a DRV8833."""
    text = (PROGRAM / "microbit" / ("robot.py" if number else "relay.py")).read_text("utf-8")
    if chassis:
        text = text.replace("CHASSIS = None", f'CHASSIS = "{chassis}"')
    return text.replace("ROBOT, ARENA = 1, 0", f"ROBOT, ARENA = {number}, {arena}").replace(
        "ARENA = 0  #", f"ARENA = {arena}  #"
    )


def set_up_command(robot: int, arena: int, radio: str, kind: str = "") -> str:
    """The command that gives a robot (1 to 4) its numbers; Thymios get theirs whenever they are switched on.

    `radio`: of the settings; `kind`: see robot_kinds.
    """
    if radio == "udp":
        return f"python3 main.py robots --wifi-config {robot} --out config.py"
    if radio == "thymio":
        return "python3 main.py robots --radio thymio"
    if kind in ("3pi_2040", "zumo_2040"):
        return f"python3 main.py robots setup --robot {robot}"
    if radio == "relay" or kind in ("microbit", *CHASSIS):
        chassis = f"--chassis {kind} " if kind in CHASSIS else ""
        return f"python3 main.py robots --microbit {robot} {chassis}--out robot{robot}.py"
    return f"make flash ADDRESS={robot} ARENA={arena}"
