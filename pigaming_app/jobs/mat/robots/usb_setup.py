"""`robots setup`: a board with MicroPython on USB becomes a robot, without files or commands of its own."""

import time
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from typing import Any

from pigaming_app.hardware.radio.packets import ROBOTS
from pigaming_app.jobs.mat.sessions import real_session
from pigaming_app.jobs.terminal.options import flag, integer, option, word
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require
from pigaming_app.jobs.terminal.typed import typed
from pigaming_app.storage.messages import OperatorError
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.i18n import english

JOINS = 40.0  # s for a board to start and to join the network
TICK = 0.1  # s
BOARDS = ("pico_w", "esp32", "pololu_2040")


@dataclass(frozen=True, kw_only=True)
class UsbSetupOptions:
    """The robot that a board becomes."""

    robot: int = option("with setup: its number, as on its marker; default 1", integer(1, ROBOTS), 1, metavar="ROBOT")
    network: str | None = option(
        "with setup: the name of the Wi-Fi, for boards that have it; its password is asked", word, metavar="NAME"
    )
    board: str | None = option(
        "with setup: the board, if it is not recognised; its file board.py becomes ours again", choices=BOARDS
    )
    no_wait: bool = flag("with setup: do not wait until the robot is in the network")


def set_up(options: Any, words: Sequence[str]) -> int:
    """Set up the board at the port in the words, or at the only one. Raises Refusal."""
    from pigaming_app.hardware.commissioning import board_setup
    from pigaming_app.hardware.session.store import arena_id, wifi_key

    if len(words) > 2:
        raise Refusal("robots setup: one word more, a port: robots setup /dev/ttyACM0")
    require("hardware")
    network = options.network or ""
    settings, _ = Settings.load(folders().config)
    arena, key = arena_id(settings), wifi_key(settings)
    with refused(OperatorError):
        port = words[1] if len(words) > 1 else board_setup.only_port()
        password = typed(f"Password of {network}: ", "robots setup") if network else ""
        print(f"{port}: robot {options.robot}", flush=True)
        kind = board_setup.set_up(
            port,
            options.board or "",
            lambda board: board_setup.files_of(board, options.robot, arena, key, network, password),
            lambda name, new: print(f"  {name:12} {'written' if new else 'as it was'}", flush=True),
        )
    print(f"{kind} is robot {options.robot}")
    wifi = board_setup.KINDS[kind].radio == board_setup.WIFI
    if wifi and not options.no_wait:
        print(f"and in the network: {_address(options.robot)}")
    if not wifi:
        print(f"Next, with its XBee at this computer: main.py robots --radio-setup {options.robot}")
    print(f"Then, on blocks: main.py robots --radio {'udp' if wifi else 'xbee'} --wheels {options.robot}")
    return 0


def _address(robot: int) -> str:
    """The address of a robot that has joined the network. Raises Refusal."""
    end = time.monotonic() + JOINS
    session = real_session(radio="udp")
    with closing(session):
        session.open_link()
        while time.monotonic() < end:
            for one in session.network.robots if session.network else ():
                if one.announced.address == robot and one.status == "ours":
                    return str(one.address)
            time.sleep(TICK)
        if session.fault:
            raise Refusal(english().long_sentence(session.fault))
    raise Refusal(
        f"robot {robot} has not joined the network within {JOINS:.0f} s: is the name right, the password, 2.4 GHz? "
        "Repeat the command."
    )
