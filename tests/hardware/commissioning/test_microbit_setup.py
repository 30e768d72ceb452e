"""Micro:bits on USB, set up in MicroPython's own interpreter at a pseudo-terminal, which lacks what a micro:bit lacks.

What that is, its source has (micropython-microbit-v2, see emulator/wifi/micropython/microbit_prompt.py). Then boards of
every kind are tried on blocks over the same cable: the wheels' voltages are those at the emulated pins. Skipped without
Node.js and npm.
"""

import os
import pty
import random
import threading
import time
import tty
from collections.abc import Iterator
from contextlib import suppress
from functools import cache, partial
from types import SimpleNamespace

import pytest

from pigaming_app.hardware.commissioning import board_setup
from pigaming_app.hardware.commissioning.board_setup import files_of, kind_of
from pigaming_app.hardware.commissioning.boards import microbit
from pigaming_app.hardware.commissioning.boards import usb as boards_usb
from pigaming_app.hardware.commissioning.boards.kind import MAIN, SetupFailed
from pigaming_app.hardware.commissioning.boards.microbit import END_RELAY
from pigaming_app.hardware.commissioning.boards.usb import BoardOnUsb
from pigaming_app.hardware.emulator.wifi.usb import UsbBoard
from pigaming_app.hardware.robot_kinds import microbit_program

KEY = bytes(16)
FILES = files_of("microbit", 2, 4711, KEY, "", "")
AHEAD, BACK = pytest.approx(0.254, abs=0.005), pytest.approx(-0.254, abs=0.005)  # 16 of 63
TURNED = [(AHEAD, 0.0), (0.0, AHEAD), (BACK, BACK), (0.0, 0.0)]

emulated = pytest.mark.usefixtures("micropython")


@pytest.fixture(autouse=True)
def _soon(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(board_setup, "AGAIN", 0.1)
    monkeypatch.setattr(microbit, "RELAY_ENDS", 0.0)
    monkeypatch.setattr(board_setup, "TURN_MS", 250)


def plug_in(monkeypatch: pytest.MonkeyPatch, *ports: str) -> None:
    """Ports that are those of micro:bits."""
    found = [SimpleNamespace(device=port, vid=microbit.VENDOR, pid=0x0204) for port in ports]
    monkeypatch.setattr("serial.tools.list_ports.comports", lambda: found)


@pytest.fixture
def usb(micropython: None, monkeypatch: pytest.MonkeyPatch) -> Iterator[UsbBoard]:
    with UsbBoard("microbit") as usb:
        plug_in(monkeypatch, usb.port)
        yield usb


def set_up(usb: UsbBoard, robot: int = 2, board: str = "") -> tuple[str, list[bool]]:
    """The kind of board, and whether each file was written."""
    written: list[bool] = []
    files = partial(files_of, robot=robot, arena=4711, key=KEY, network="", password="")
    kind = board_setup.set_up(usb.port, board, files, lambda name, new: written.append(new))
    return kind, written


def read(board: BoardOnUsb) -> str:
    """The program on the board; empty without one."""
    return board.ask("print(open('main.py').read(), end='')") if board.has(MAIN) else ""


@pytest.mark.long
@pytest.mark.again
def test_a_microbit_is_known_by_its_chip_and_becomes_robot_two_then_three(usb: UsbBoard) -> None:
    assert board_setup.only_port() == usb.port
    assert set_up(usb) == ("microbit", [True])
    assert set_up(usb) == ("microbit", [False])
    assert set_up(usb, robot=3) == ("microbit", [True])
    with BoardOnUsb(usb.port) as board:
        assert board.ask("import main\nprint(main.ROBOT, main.ARENA, main.CHASSIS)") == "3 4711 None"


@pytest.mark.long
@pytest.mark.again
def test_the_one_at_the_computer_becomes_the_relay_and_one_on_a_chassis_gets_its_program(usb: UsbBoard) -> None:
    for board, number, chassis in (("relay", 0, ""), ("maqueen", 2, "maqueen")):
        assert set_up(usb, board=board) == (board, [True])
        with BoardOnUsb(usb.port) as connected:
            assert read(connected) == microbit_program(number, 4711, chassis).strip()


STARTED = """
try:
    exec(open('main.py').read(), {'__name__': '__main__'})
except (SyntaxError, OSError):
    pass
"""


@cache
def bytes_of_all() -> int:
    """What a whole set-up sends."""
    with UsbBoard("microbit") as usb:
        with BoardOnUsb(usb.port) as board:
            board.write(FILES)
        return usb.sent


@pytest.mark.long
@pytest.mark.parametrize(
    "share",
    [0.5, *(pytest.param(share, marks=pytest.mark.again) for share in (0.0, 0.05, 0.15, 0.3, 0.7, 0.85, 0.97))],
)
def test_a_cable_that_is_pulled_leaves_a_part_that_does_nothing_and_the_next_attempt_goes_on(
    usb: UsbBoard, share: float
) -> None:
    usb.plug(cut_after=random.Random(f"{share}").randrange(20, 80) + round(share * bytes_of_all()))
    with pytest.raises(SetupFailed) as failed, BoardOnUsb(usb.port) as board:
        board.write(FILES)
    assert failed.value.message.key in ("board_gone", "board_silent")
    usb.plug()
    with BoardOnUsb(usb.port) as board:
        part, whole = read(board), FILES[MAIN].decode().strip()
        assert whole.startswith(part)
        if part != whole:
            board.ask(
                "try:\n exec(open('main.py').read(), {'__name__': '__main__'})\nexcept (SyntaxError, OSError):\n pass"
            )
            assert not usb.pins
        written = []
        board.write(FILES, lambda name, new: written.append(new))
        assert written == [part != whole]
        assert read(board) == whole


def test_the_last_line_alone_starts_a_program() -> None:
    for number in (0, 1):
        *before, last = microbit_program(number, 4711).rstrip().splitlines()
        assert last == "    main()"
        assert before[-1] == 'if __name__ == "__main__":'
        assert not any(line.startswith("main(") for line in before)


@pytest.mark.long
def test_a_disk_full_of_other_files_is_refused_and_the_board_is_left_without_a_program(usb: UsbBoard) -> None:
    with BoardOnUsb(usb.port) as board:
        board.ask("f = open('notes.txt', 'wb')\nfor i in range(40):\n f.write(bytes(250))\nf.close()")
        with pytest.raises(SetupFailed) as failed:
            board.write(FILES)
        assert failed.value.message.key == "board_failed"
        assert not board.has(MAIN)


@pytest.mark.long
def test_a_board_of_another_kind_than_the_chosen_one_is_refused(usb: UsbBoard) -> None:
    with pytest.raises(SetupFailed) as failed:
        set_up(usb, board="pico_w")
    assert failed.value.message.key == "board_other"
    with BoardOnUsb(usb.port) as board:
        assert not board.has("config.py")


@pytest.mark.parametrize(("version", "key"), [([1, 9], "board_microbit"), ([1, 15], ""), ([1, 18], "")])
def test_a_microbit_of_the_first_version_is_refused(
    monkeypatch: pytest.MonkeyPatch, version: list[int], key: str
) -> None:
    told = f'{{"name": "micropython", "version": {version}, "platform": "microbit", "wifi": 0, "machine": ""}}'
    monkeypatch.setattr(BoardOnUsb, "ask", lambda board, program: told)
    if not key:
        assert kind_of(BoardOnUsb("any")) == "microbit"
        return
    with pytest.raises(SetupFailed) as failed:
        kind_of(BoardOnUsb("any"))
    assert failed.value.message.key == key


@pytest.mark.parametrize("vendor", [microbit.VENDOR, 0x2E8A])
def test_a_microbit_without_micropython_has_a_sentence_of_its_own(monkeypatch: pytest.MonkeyPatch, vendor: int) -> None:
    """Another program answers nothing, whatever it is sent: among that are the bytes that end a relay."""
    monkeypatch.setattr(boards_usb, "SILENT", 0.3)
    master, slave = pty.openpty()
    tty.setraw(slave)
    port, sent = os.ttyname(slave), bytearray()
    found = [SimpleNamespace(device=port, vid=vendor)]
    monkeypatch.setattr("serial.tools.list_ports.comports", lambda: found)

    def swallow() -> None:
        with suppress(OSError):
            while True:
                sent.extend(os.read(master, 64))

    other = threading.Thread(target=swallow, daemon=True)
    other.start()
    try:
        with pytest.raises(SetupFailed) as failed, BoardOnUsb(port):
            pass
    finally:
        os.close(slave)
        other.join()
        os.close(master)
    assert failed.value.message.key == ("board_microbit" if vendor == microbit.VENDOR else "board_silent")
    assert (END_RELAY in sent) is (vendor == microbit.VENDOR)


BOARDS = {  # chosen board, battery in mV, pin of the lamp
    "microbit": ("", 0, "display"),
    "board_pico_w": ("pico_w", 5000, "LED"),
    "cutebot": ("cutebot", 0, "display"),
    "board_pololu_2040": ("3pi_2040", 5000, "25"),
    "board_esp32": ("esp32", 5000, "2"),
}


@pytest.mark.long
@emulated
@pytest.mark.parametrize(
    "emulated_board",
    ["microbit", *(pytest.param(board, marks=pytest.mark.again) for board in [*BOARDS][1:])],
)
def test_on_blocks_the_wheels_turn_one_after_another_the_lamp_blinks_and_the_battery_is_told(
    monkeypatch: pytest.MonkeyPatch, emulated_board: str
) -> None:
    (board, millivolts, lamp), told = BOARDS[emulated_board], list[str]()
    with UsbBoard(emulated_board) as usb:
        if not emulated_board.startswith("board_"):
            plug_in(monkeypatch, usb.port)
        files = partial(files_of, robot=2, arena=4711, key=KEY, network="Hof", password="")
        board_setup.set_up(usb.port, board, files, lambda name, new: None)
        if emulated_board.startswith("board_"):
            with BoardOnUsb(usb.port) as connected:  # as a program that was interrupted: its timer runs on
                connected.ask("import board, config, robot\nrobot.Robot(board, config, None, False)")
        assert board_setup.try_on_blocks(usb.port, board, told.append) == pytest.approx(millivolts, abs=25)
        turned, lit = usb.motors, [pins[lamp] for pins in usb.pins if lamp in pins]
    assert told == ["left", "right", "back", "lamp"]
    assert [turn for turn in turned if turn != (0.0, 0.0)] == TURNED[:3]
    assert turned[-1] == (0.0, 0.0)
    assert lit[-1] == ord("2") if lamp == "display" else {0, 1} <= {*lit}


@pytest.mark.long
@emulated
@pytest.mark.parametrize("emulated_board", ["microbit", pytest.param("board_pico_w", marks=pytest.mark.again)])
def test_a_wheel_stops_though_the_cable_is_pulled_while_it_turns(
    monkeypatch: pytest.MonkeyPatch, emulated_board: str
) -> None:
    board = BOARDS[emulated_board][0] or "microbit"
    with UsbBoard(emulated_board) as usb:
        if board == "microbit":
            plug_in(monkeypatch, usb.port)
        files = partial(files_of, robot=2, arena=4711, key=KEY, network="Hof", password="")
        board_setup.set_up(usb.port, board, files, lambda name, new: None)

        def pull(turn: str) -> None:
            if turn == "right":
                threading.Timer(0.12, usb.pull).start()

        with pytest.raises(SetupFailed) as failed:
            board_setup.try_on_blocks(usb.port, board, pull)
        assert failed.value.message.key in ("board_gone", "board_silent")
        time.sleep(0.3)
        assert usb.motors[-1] == (0.0, 0.0)
        assert TURNED[1] in usb.motors
        assert TURNED[2] not in usb.motors
