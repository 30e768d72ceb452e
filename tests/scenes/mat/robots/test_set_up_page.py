"""The page that makes a board on USB a robot; the board is MicroPython's own interpreter at a pseudo-terminal."""

import time
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from pigaming_app.hardware.commissioning import board_setup
from pigaming_app.hardware.commissioning.boards import microbit
from pigaming_app.hardware.commissioning.boards.kind import SetupFailed
from pigaming_app.hardware.commissioning.boards.usb import BoardOnUsb
from pigaming_app.hardware.emulator.wifi.boards import NoMicroPython, interpreter
from pigaming_app.hardware.emulator.wifi.usb import UsbBoard
from pigaming_app.hardware.session.guide import SHEET
from pigaming_app.scenes.mat.robots.menu import RobotsMenu
from pigaming_app.scenes.mat.robots.set_up_page import SetUpPage
from pigaming_app.scenes.pages.text_page import TextPage
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.web import wifi
from tests.scenes.arcade import Arcade


def opened(arcade: Arcade) -> SetUpPage:
    menu = arcade.open(RobotsMenu(arcade.context))
    menu.focus.move_to("board")
    arcade.press(Button.FIRE)
    return arcade.shown(SetUpPage)


def waited(arcade: Arcade, page: SetUpPage, row: str = "begin") -> None:
    page.focus.move_to(row)
    arcade.press(Button.FIRE)
    end = time.monotonic() + 60.0
    while page.work:
        assert time.monotonic() < end
        arcade.frame(draw=True)
        time.sleep(0.01)


def test_the_wifi_is_that_of_the_phones(arcade: Arcade) -> None:
    page = opened(arcade)
    page.focus.move_to("wifi")
    arcade.press(Button.FIRE)
    typing = arcade.shown(TextPage)
    arcade.wait(0.5)
    for letter in "Hof 3":
        typing.type(letter)
    arcade.press(Button.START)
    assert arcade.context.settings.phones_wifi == "Hof 3"


@pytest.mark.parametrize("keyring", ["tests.ui.web.keyrings.Drawer", "keyring.backends.fail.Keyring"])
def test_where_the_password_is_kept_stands_beside_it(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, keyring: str
) -> None:
    pytest.importorskip("keyring", reason="the extra `keyring` is not installed")
    monkeypatch.setenv("PYTHON_KEYRING_BACKEND", keyring)
    monkeypatch.setenv("KEYRING_DRAWER", str(tmp_path / "drawer"))
    wifi._keyring.cache_clear()
    arcade.context.settings.phones_wifi = "Hof am See"
    page, words = opened(arcade), arcade.context.words
    page.focus.move_to("wifi_key")
    arcade.press(Button.FIRE)
    typing = arcade.shown(TextPage)
    arcade.wait(0.5)
    for letter in "geheim":
        typing.type(letter)
    arcade.press(Button.START)
    there = wifi.has_keyring()
    assert there is ("Drawer" in keyring)
    assert page.line("wifi_key").endswith(words("phones.keyring" if there else "phones.plain"))
    assert page.message == ("" if there else words("phones.plain"))
    assert arcade.context.settings.phones_wifi_key == ("" if there else "geheim")
    assert page.value("wifi_key").options == ("******",)
    wifi._keyring.cache_clear()


def test_the_marker_sheet_is_written_from_here(arcade: Arcade) -> None:
    pytest.importorskip("cv2", reason="the extra `hardware` is not installed")
    page = opened(arcade)
    page.focus.move_to("sheet")
    arcade.press(Button.FIRE)
    assert (folders().data / SHEET).read_bytes().startswith(b"%PDF")
    assert str(folders().data / SHEET) in page.message


def test_without_a_board_the_page_tells_what_to_do(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    def none() -> str:
        raise SetupFailed(OperatorMessage("board_none", ports=""))

    monkeypatch.setattr(board_setup, "only_port", none)
    arcade.context.settings.phones_wifi = "Hof"
    page = opened(arcade)
    waited(arcade, page)
    assert page.message == arcade.context.words.sentence(OperatorMessage("board_none", ports=""))


@pytest.fixture
def usb() -> Iterator[UsbBoard]:
    try:
        interpreter()
    except NoMicroPython as reason:
        pytest.skip(str(reason))
    with UsbBoard() as usb:
        yield usb


@pytest.mark.long
def test_a_board_becomes_robot_two_and_the_next_one_three(
    arcade: Arcade, usb: UsbBoard, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(board_setup, "only_port", lambda: usb.port)
    settings = arcade.context.settings
    page = opened(arcade)
    page.focus.move_to("robot")
    arcade.press(Button.RIGHT)
    waited(arcade, page)
    assert page.message.startswith("The board at"), "the emulated one is unknown"
    page.focus.move_to("board")
    arcade.press(Button.RIGHT)
    usb.plug()
    waited(arcade, page)
    assert page.message == arcade.context.words.sentence(OperatorMessage("board_no_network"))
    settings.phones_wifi, settings.phones_wifi_key = "Hof", "geheim"
    usb.plug()
    waited(arcade, page)
    assert page.message == arcade.context.words("board.done", robot=2)
    assert page.robot == 3
    assert Settings.load(folders().config)[0].kinds == ["", "pico_w", "", ""]
    usb.plug()
    with BoardOnUsb(usb.port) as board:
        assert board.ask("import config\nprint(config.ROBOT, config.NETWORK, config.PASSWORD)") == "2 Hof geheim"


@pytest.mark.long
def test_a_microbit_becomes_robot_one_and_is_tried_on_blocks_without_a_choice(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    try:
        interpreter()
    except NoMicroPython as reason:
        pytest.skip(str(reason))
    monkeypatch.setattr(board_setup, "TURN_MS", 100)
    monkeypatch.setattr(microbit, "RELAY_ENDS", 0.0)
    page, words = opened(arcade), arcade.context.words
    with UsbBoard("microbit") as usb:
        found = [SimpleNamespace(device=usb.port, vid=microbit.VENDOR)]
        monkeypatch.setattr("serial.tools.list_ports.comports", lambda: found)
        waited(arcade, page)
        assert page.message == words("board.done", robot=1)
        assert Settings.load(folders().config)[0].kinds[0] == "microbit"
        waited(arcade, page, "blocks")
        assert page.message == words("board.tried", volts=words("board.unmeasured"))
        assert len([turn for turn in usb.motors if turn != (0.0, 0.0)]) == 3
    page.focus.move_to("board")
    for _ in board_setup.KINDS:
        arcade.press(Button.RIGHT)
    assert page.board == "relay"
    assert page._told(page.board) == words("board.done_relay")
