"""Boards on USB, set up in MicroPython's own interpreter at a pseudo-terminal. Skipped without Node.js and npm."""

import json
import random
from collections.abc import Iterator
from functools import cache

import pytest

from pigaming_app.hardware.commissioning.board_setup import files_of, kind_of
from pigaming_app.hardware.commissioning.boards.kind import MAIN, SetupFailed
from pigaming_app.hardware.commissioning.boards.usb import PART, BoardOnUsb
from pigaming_app.hardware.emulator.wifi.usb import UsbBoard

FILES = files_of("pico_w", 2, 4711, bytes(range(16)), 'Schule "Süd"', "geheim\\\\ 'x'")
ORDER = ["robot.py", "motors.py", "wifi.py", "update.py", "board.py", "config.py", "main.py"]

pytestmark = [pytest.mark.long, pytest.mark.usefixtures("micropython")]


@pytest.fixture
def usb() -> Iterator[UsbBoard]:
    with UsbBoard() as usb:
        yield usb


def on_board(board: BoardOnUsb) -> dict[str, str]:
    """The hash of each file on the board, as its own interpreter has it."""
    names = board.ask("import os\nprint(' '.join(n for n in os.listdir('/') if n.endswith(('.py', '.part'))))").split()
    return {name: board.ask(HASH.replace("NAME", repr(name))) for name in names}


HASH = """
import hashlib, binascii
with open(NAME, 'rb') as f:
    print(binascii.hexlify(hashlib.sha256(f.read()).digest()).decode())
"""


def hashes(files: dict[str, bytes]) -> dict[str, str]:
    import hashlib

    return {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}


def test_all_files_arrive_and_the_second_time_none_is_written(usb: UsbBoard) -> None:
    told: list[tuple[str, bool]] = []
    for new in (True, False):
        with BoardOnUsb(usb.port) as board:
            board.write(FILES, lambda name, written: told.append((name, written)))
            assert on_board(board) == hashes(FILES)
        assert told == [(name, new) for name in ORDER]
        told.clear()


def test_a_program_that_came_over_the_air_makes_room_for_that_of_usb(usb: UsbBoard) -> None:
    with BoardOnUsb(usb.port) as board:
        board.write(FILES)
        board.ask("for n in ('kept', 'trial'):\n with open(n, 'w') as f:\n  f.write('a')")
        board.write(FILES)
        assert board.ask("import os\nprint('kept' in os.listdir() or 'trial' in os.listdir())") == "False"


def test_the_board_reads_name_and_password_as_they_were_typed(usb: UsbBoard) -> None:
    with BoardOnUsb(usb.port) as board:
        board.write(FILES)
        assert board.ask("import config\nprint(config.NETWORK)") == 'Schule "Süd"'
        assert board.ask("print(config.PASSWORD)") == "geheim\\\\ 'x'"
        assert board.ask("print(config.ROBOT, config.ARENA, config.KEY)") == f"2 4711 {bytes(range(16)).hex()}"


def test_a_changed_file_is_written_with_the_main_program_last(usb: UsbBoard) -> None:
    told = []
    with BoardOnUsb(usb.port) as board:
        board.write(FILES)
        changed = {**FILES, "wifi.py": FILES["wifi.py"] + b"# newer\n"}
        board.write(changed, lambda name, written: told.append((name, written)))
        assert [name for name, written in told if written] == ["wifi.py", "main.py"]
        assert on_board(board) == hashes(changed)


@cache
def bytes_of_all() -> int:
    """What a whole set-up sends."""
    with UsbBoard() as usb:
        with BoardOnUsb(usb.port) as board:
            board.write(FILES)
        return usb.sent


@pytest.mark.parametrize("share", [0.0, 0.02, 0.2, 0.35, 0.5, 0.6, 0.8, 0.97])
def test_a_cable_that_is_pulled_at_any_byte_does_no_harm(usb: UsbBoard, share: float) -> None:
    """No file is there by half, the robot does not start with a part of them, and the next attempt goes on."""
    usb.plug(cut_after=random.Random(f"{share}").randrange(20, 80) + round(share * bytes_of_all()))
    with pytest.raises(SetupFailed) as failed, BoardOnUsb(usb.port) as board:
        board.write(FILES)
    assert failed.value.message.key in ("board_gone", "board_silent")
    usb.plug()
    with BoardOnUsb(usb.port) as board:
        there = {name: found for name, found in on_board(board).items() if not name.endswith(PART)}
        assert there.items() <= hashes(FILES).items()
        assert MAIN not in there or len(there) == len(FILES)
        written = []
        board.write(FILES, lambda name, new: written.append(name) if new else None)
        assert {*written} == {*FILES} - {*there}
        found = on_board(board)
    assert {name: found[name] for name in FILES} == hashes(FILES)


@pytest.mark.parametrize(
    ("platform", "wifi", "machine", "kind"),
    [
        ("rp2", 1, "Raspberry Pi Pico W with RP2040", "pico_w"),
        ("rp2", 0, "Raspberry Pi Pico with RP2040", ""),
        ("esp32", 1, "Generic ESP32 module with ESP32", "esp32"),
        ("esp32", 1, "Generic ESP32S3 module with ESP32S3", ""),
        ("rp2", 0, "Pololu 3pi+ 2040 Robot with RP2040", "3pi_2040"),
        ("rp2", 0, "Pololu Zumo 2040 Robot with RP2040", "zumo_2040"),
        ("webassembly", 0, "JS with Emscripten", ""),
    ],
)
def test_boards_are_told_apart_by_what_they_print(
    monkeypatch: pytest.MonkeyPatch, platform: str, wifi: int, machine: str, kind: str
) -> None:
    told = {"name": "micropython", "version": [1, 24], "platform": platform, "wifi": wifi, "machine": machine}
    monkeypatch.setattr(BoardOnUsb, "ask", lambda board, program: json.dumps(told))
    assert kind_of(BoardOnUsb("any")) == kind


def test_a_port_without_a_board_is_refused(usb: UsbBoard) -> None:
    for port in ("/dev/nothing", "/dev/null"):
        with pytest.raises(SetupFailed), BoardOnUsb(port):
            pass


def test_an_old_micropython_is_refused(usb: UsbBoard, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pigaming_app.hardware.commissioning.boards.kind.OLDEST", (99, 0))
    with pytest.raises(SetupFailed) as failed, BoardOnUsb(usb.port) as board:
        kind_of(board)
    assert failed.value.message.key == "board_old"
