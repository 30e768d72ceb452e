"""A board with MicroPython on USB becomes a robot: it is found, recognised, gets its files, and is tried on blocks."""

from collections.abc import Callable, Mapping
from time import sleep
from typing import TypeVar

from pigaming_app.hardware.commissioning.boards import microbit, pololu, wifi
from pigaming_app.hardware.commissioning.boards.kind import MICROBIT, RobotRole, SetupFailed
from pigaming_app.hardware.commissioning.boards.usb import BoardOnUsb, Tell, vendors
from pigaming_app.hardware.robot_kinds import PROGRAM
from pigaming_app.storage.messages import OperatorMessage

KINDS = {**wifi.KINDS, **pololu.KINDS, **microbit.KINDS}
USB = {  # by vendor; radios have FTDI's
    0x2E8A: "Raspberry Pi",
    0x303A: "Espressif",
    0x1FFB: "Pololu",
    0x10C4: "CP210x",
    0x1A86: "CH340",
    microbit.VENDOR: "micro:bit",
}
TURNS = {"left": (16, 0), "right": (0, 16), "back": (-16, -16)}  # speed codes of left and right wheel; 63 is full speed
TURN_MS = 1200
AGAIN = 3.0  # s after which a board is tried once more: a running program's watchdog may have restarted it
PINS = "board.py"  # the file with pins and divider, which its owner may have changed


def only_port() -> str:
    """The serial port of the only board on USB, known by the vendor of its chip. Raises SetupFailed."""
    ports = [port for port, vendor in vendors().items() if vendor in USB]
    if len(ports) != 1:
        there = ", ".join(ports)
        raise SetupFailed(OperatorMessage("board_several" if ports else "board_none", ports=there))
    return ports[0]


def set_up(port: str, board: str, files: Callable[[str], Mapping[str, bytes]], tell: Tell) -> str:
    """Make the board at a port a robot, and start it; its kind of board. Raises SetupFailed.

    `board`: one of KINDS, empty: found out, and a board file that is there is kept; `files`: those for a kind;
    `tell`: see `BoardOnUsb.write`.
    """
    return _repeated(lambda: _set_up(port, board, files, tell))


def kind_for_settings(board: str, before: str) -> str:
    """The key in `robot_kinds` of a robot whose board was set up as one of KINDS (not the relay).

    `before`: that of the settings. A kit's board looks like any Pico W, so a robot stays a kit.
    """
    return before if (board, before) == ("pico_w", "kit") else board


def try_on_blocks(port: str, board: str, tell: Callable[[str], None]) -> int:
    """Turn the wheels of the robot at a port, which stands on blocks, and light its lamp; then start its program.

    `board`: as of `set_up`; `tell` gets the name of each of TURNS, and `lamp`, before it happens. Returns the battery's
    voltage in mV, 0 where it is not measured. Raises SetupFailed.
    """
    return _repeated(lambda: _try_on_blocks(port, board, tell))


T = TypeVar("T")


def _repeated(action: Callable[[], T]) -> T:
    """Its value, at the second attempt if a board fell silent."""
    try:
        return action()
    except SetupFailed as failed:
        if failed.message.key not in ("board_gone", "board_silent", "board_microbit"):
            raise
    sleep(AGAIN)
    return action()


def _set_up(port: str, board: str, files: Callable[[str], Mapping[str, bytes]], tell: Tell) -> str:
    with BoardOnUsb(port) as connected:
        kind = _kind_or(connected, board)
        wanted = dict(files(kind))
        if not board and PINS in wanted and connected.has(PINS):
            del wanted[PINS]
        connected.write(wanted, tell)
        connected.restart()
    return kind


def _try_on_blocks(port: str, board: str, tell: Callable[[str], None]) -> int:
    with BoardOnUsb(port) as connected:
        folder = microbit.FOLDER if KINDS[_kind_or(connected, board)].radio == MICROBIT else PROGRAM
        connected.begin_anew()
        connected.ask((folder / "on_blocks.py").read_text("utf-8"))
        for name, (left, right) in TURNS.items():
            tell(name)
            connected.ask(f"turn({left}, {right}, {TURN_MS})")
        tell("lamp")
        millivolts = int(connected.ask(f"light({TURN_MS})\nprint(battery())"))
        connected.restart()
    return millivolts


def _kind_or(connected: BoardOnUsb, board: str) -> str:
    """The given one of KINDS, or that of the board if empty. Raises SetupFailed if neither or both are known."""
    kind = kind_of(connected)
    if not (board or kind):
        raise SetupFailed(OperatorMessage("board_unknown", port=connected.port, kinds=", ".join(KINDS)))
    if board and kind and (KINDS[board].radio == MICROBIT) != (KINDS[kind].radio == MICROBIT):
        raise SetupFailed(OperatorMessage("board_other", port=connected.port, kind=KINDS[kind].name))
    return board or kind


def kind_of(connected: BoardOnUsb) -> str:
    """One of KINDS, or empty for an unknown board. Raises SetupFailed for an old MicroPython."""
    told = connected.answer()
    if told.platform == microbit.PLATFORM:
        if not microbit.recognised(told):
            raise SetupFailed(OperatorMessage("board_microbit", port=connected.port))
        return microbit.recognised(told)
    told.check()
    return pololu.recognised(told) or wifi.recognised(told)


def files_of(kind: str, robot: int, arena: int, key: bytes, network: str, password: str) -> dict[str, bytes]:
    """The files of a robot (1 to 4) by their names on the board, in the order in which they are written.

    `kind`: one of KINDS. Raises SetupFailed if it needs a network and has none.
    """
    return KINDS[kind].files(RobotRole(robot, arena, key, network, password))
