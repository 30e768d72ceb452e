"""Boards with Wi-Fi of their own: Pico W, alone or in the robot of docs/kit.md, and ESP32."""

import re
from functools import partial

from pigaming_app.hardware.commissioning.boards.kind import (
    WIFI,
    BoardAnswer,
    BoardKind,
    RobotRole,
    SetupFailed,
    micropython_files,
)
from pigaming_app.storage.messages import OperatorMessage

AIR_FILES = ("robot.py", "motors.py", "wifi.py", "update.py")  # those that updates over the air replace, in this order
PLATFORMS = {"rp2": "pico_w", "esp32": "esp32"}  # kind by `sys.platform`
OTHERS = re.compile(r"ESP32-?[SCHP]\d")  # chips of other pins


def recognised(told: BoardAnswer) -> str:
    """The key of its kind, or empty."""
    return PLATFORMS.get(told.platform, "") if told.wifi and not OTHERS.search(told.machine) else ""


def _files(board: str, role: RobotRole) -> dict[str, bytes]:
    if not role.network:
        raise SetupFailed(OperatorMessage("board_no_network"))
    return micropython_files(role, board, WIFI, AIR_FILES)


KINDS = {
    "pico_w": BoardKind("Pico W", WIFI, partial(_files, "board_pico_w")),
    "kit": BoardKind("Kit (Pico W)", WIFI, partial(_files, "board_pico_w")),
    "esp32": BoardKind("ESP32", WIFI, partial(_files, "board_esp32")),
}
