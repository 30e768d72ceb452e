"""`robots setup`: a board with MicroPython on USB becomes a robot, without files or commands of its own."""

import time
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass, fields, replace
from typing import Any

from pigaming_app.hardware.drivers.ours import RELAY, UDP
from pigaming_app.hardware.radio.packets import ROBOTS
from pigaming_app.jobs.mat.sessions import real_session
from pigaming_app.jobs.terminal.options import flag, integer, option, word
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require
from pigaming_app.jobs.terminal.typed import typed
from pigaming_app.storage.messages import OperatorError
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import FILE, Settings, folders
from pigaming_app.ui.i18n import english
from pigaming_app.ui.web import wifi

JOINS = 40.0  # s for a board to start and to join the network
TICK = 0.1  # s
BOARDS = ("pico_w", "kit", "esp32", "3pi_2040", "zumo_2040", "microbit", "cutebot", "maqueen", "relay")
TURNS = {
    "left": "left wheel ahead",
    "right": "right wheel ahead",
    "back": "both wheels back",
    "lamp": "lamp",
}


@dataclass(frozen=True, kw_only=True)
class UsbSetupOptions:
    """The robot that a board becomes."""

    robot: int | None = option(
        "with setup: its number, as on its marker; default 1", integer(1, ROBOTS), metavar="ROBOT"
    )
    network: str | None = option(
        "with setup: the name of the Wi-Fi, for boards that have it; default the one before", word, metavar="NAME"
    )
    password: bool = flag("with setup: ask for the password of the Wi-Fi again")
    board: str | None = option(
        "with setup: the board, if it is not recognised, or what it is part of: kit is the robot of docs/kit.md; "
        "relay: the micro:bit that stays at the computer; its file board.py becomes ours again",
        choices=BOARDS,
    )
    on_blocks: bool = flag("with setup: then turn the wheels of the robot, which stands on blocks, over the cable")
    no_wait: bool = flag("with setup: do not wait until the robot is in the network")


OPTIONS = tuple(one.name for one in fields(UsbSetupOptions))


def set_up(options: Any, words: Sequence[str]) -> int:
    """Set up the board at the port in the words, or at the only one. Raises Refusal."""
    from pigaming_app.hardware.commissioning import board_setup
    from pigaming_app.hardware.session.store import arena_id, wifi_key

    if len(words) > 2:
        raise Refusal("robots setup: one word more, a port: robots setup /dev/ttyACM0")
    options = replace(options, robot=options.robot or 1)
    require("hardware")
    settings, _ = Settings.load(folders().config)
    arena, key = arena_id(settings), wifi_key(settings)
    board = options.board or ""
    with refused(OperatorError):
        port = words[1] if len(words) > 1 else board_setup.only_port()
        network, password = _wifi(options)
        print(f"{port}: {'relay' if board == 'relay' else f'robot {options.robot}'}", flush=True)
        kind = board_setup.set_up(
            port,
            board,
            lambda board: board_setup.files_of(board, options.robot, arena, key, network, password),
            lambda name, new: print(f"  {name:12} {'written' if new else 'as it was'}", flush=True),
        )
        print(f"{kind} is {'ready: leave it here' if kind == 'relay' else f'robot {options.robot}'}", flush=True)
        if options.on_blocks and kind != "relay":
            millivolts = board_setup.try_on_blocks(port, board, lambda name: print(f"  {TURNS[name]}", flush=True))
            print(f"  battery {f'{millivolts / 1000:.1f} V' if millivolts else 'not measured'}")
    if kind != "relay":
        with refused(NotSaved):
            save_kind(options.robot, kind)
    _print_next(options, kind)
    return 0


def save_kind(robot: int, board: str) -> None:
    """Save the kind of a robot (1 to 4) whose board was set up. Raises NotSaved."""
    from pigaming_app.hardware.commissioning.board_setup import kind_for_settings

    settings, _ = Settings.load(folders().config)
    before = settings.kinds[robot - 1]
    settings.kinds = [*settings.kinds]
    settings.kinds[robot - 1] = kind_for_settings(board, before)
    settings.save(folders().config)


def _print_next(options: Any, kind: str) -> None:
    """Print what comes next for a board of this kind. Raises Refusal if it is not in the network."""
    from pigaming_app.hardware.commissioning.board_setup import KINDS
    from pigaming_app.hardware.commissioning.boards.kind import MICROBIT, WIFI, XBEE
    from pigaming_app.hardware.radio.xbee_protocol import XBeeMode

    chosen = Settings.load(folders().config)[0].radio
    xbee = chosen if chosen in [*XBeeMode] else XBeeMode.API2
    radio = {WIFI: UDP, XBEE: str(xbee), MICROBIT: RELAY}[KINDS[kind].radio]
    if radio == UDP and not options.no_wait:
        print(f"and in the network: {_address(options.robot)}")
    if radio in [*XBeeMode]:
        command = f"python3 main.py robots --radio {radio} --radio-setup {options.robot}"
        print(f"Next, with its XBee at this computer: {command}")
    if kind == "relay":
        print("Next, the micro:bits of the robots: python3 main.py robots setup --robot 1")
    else:
        print(f"Then, on blocks: python3 main.py robots --radio {radio} --wheels {options.robot}")


def _wifi(options: Any) -> tuple[str, str]:
    """Name and password of the Wi-Fi, typed once, and kept; where, is printed. Raises Refusal if it cannot be."""
    settings, _ = Settings.load(folders().config)
    before = settings.phones_wifi, settings.phones_wifi_key
    if options.network:
        if len(options.network) > wifi.NAME:
            raise Refusal(f"--network: a name has at most {wifi.NAME} letters")
        wifi.rename(settings, options.network)
    known, name = wifi.password(settings, wifi.PATIENT), settings.phones_wifi
    if options.password or (options.network and not known):
        password = typed(f"Password of {name}: ", "robots setup")
        if len(password) > wifi.LONGEST:
            raise Refusal(f"robots setup: a password has at most {wifi.LONGEST} letters")
        if wifi.keep(settings, password):
            print("The password is in the system's keyring.")
        elif password:
            print(f"No keyring: the password is saved as plain text in {folders().config / FILE}.")
    if before != (settings.phones_wifi, settings.phones_wifi_key):
        with refused(NotSaved):
            wifi.save(settings)
    return name, wifi.password(settings, wifi.PATIENT)


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
        "Repeat the command, with --password to type it again."
    )
