"""The page that makes a board on USB a robot; the board is MicroPython's own interpreter at a pseudo-terminal."""

import time
from collections.abc import Iterator

import pytest

from pigaming_app.hardware.commissioning import board_setup
from pigaming_app.hardware.commissioning.board_setup import BoardOnUsb, SetupFailed
from pigaming_app.hardware.emulator.wifi.boards import NoMicroPython, interpreter
from pigaming_app.hardware.emulator.wifi.usb import UsbBoard
from pigaming_app.scenes.mat.robots.menu import RobotsMenu
from pigaming_app.scenes.mat.robots.set_up_page import SetUpPage
from pigaming_app.scenes.pages.text_page import TextPage
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import Arcade


def opened(arcade: Arcade) -> SetUpPage:
    menu = arcade.open(RobotsMenu(arcade.context))
    menu.focus.move_to("board")
    arcade.press(Button.FIRE)
    return arcade.shown(SetUpPage)


def waited(arcade: Arcade, page: SetUpPage) -> None:
    page.focus.move_to("begin")
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
    usb.plug()
    with BoardOnUsb(usb.port) as board:
        assert board.ask("import config\nprint(config.ROBOT, config.NETWORK, config.PASSWORD)") == "2 Hof geheim"
