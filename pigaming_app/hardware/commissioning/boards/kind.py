"""What all kinds of boards have in common: what a board tells of itself, and the files of a robot with MicroPython."""

import json
from collections.abc import Callable, Sequence
from typing import NamedTuple

from pigaming_app.hardware.robot_kinds import PROGRAM, robot_config
from pigaming_app.storage.messages import OperatorError, OperatorMessage

MAIN = "main.py"  # the file that starts the robot
WIFI, XBEE, MICROBIT = "wifi", "serial_radio", "radio"  # names of the program of a radio
OLDEST = (1, 22)  # version of MicroPython


class SetupFailed(OperatorError):
    """A board cannot be set up; the message says why."""


class RobotRole(NamedTuple):
    """Which robot a board is to be: its number (1 to 4), its arena with its key, and the Wi-Fi, if it needs one."""

    robot: int
    arena: int
    key: bytes
    network: str
    password: str


class BoardKind(NamedTuple):
    """A kind of board: its proper name, its radio, and a robot's files by their names on the board, in the order in
    which they are written. The last raises SetupFailed.
    """

    name: str
    radio: str
    files: Callable[[RobotRole], dict[str, bytes]]


class BoardAnswer(NamedTuple):
    """What the MicroPython of a board tells: its name, version, `sys.platform`, Wi-Fi or none, and its machine."""

    name: str
    version: tuple[int, ...]
    platform: str
    wifi: bool
    machine: str

    def check(self) -> None:
        """Raises SetupFailed for an old MicroPython."""
        if self.name != "micropython" or self.version < OLDEST:
            raise SetupFailed(OperatorMessage("board_old", version=".".join(map(str, self.version))))


def micropython_files(role: RobotRole, board: str, radio: str, names: Sequence[str]) -> dict[str, bytes]:
    """The files of a robot: these programs, the `board` file, its configuration, and MAIN."""
    config = robot_config(role.robot, role.arena, role.key).replace(f'"{WIFI}"', f'"{radio}"')
    config = config.replace('"name of the network"', json.dumps(role.network, ensure_ascii=False))
    config = config.replace('"its password"', json.dumps(role.password, ensure_ascii=False))
    files = {name: (PROGRAM / name).read_bytes() for name in names}
    files |= {"board.py": (PROGRAM / f"{board}.py").read_bytes(), "config.py": config.encode()}
    return {**files, MAIN: (PROGRAM / "start.py").read_bytes()}
