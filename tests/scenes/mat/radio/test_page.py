"""The page of arena and radio: numbers change and are kept, radios are written one after another."""

import pytest

from pigaming_app.hardware.emulator.xbee import EmulatedCarrier as EmulatedCarrier
from pigaming_app.hardware.emulator.xbee import Module
from pigaming_app.hardware.radio.xbee_setup import Carrier
from pigaming_app.hardware.session.real import RealSession
from pigaming_app.scenes.mat.mat import SessionMat
from pigaming_app.scenes.mat.radio.page import RadioPage
from pigaming_app.scenes.mat.session import session_of
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.input.events import Button
from tests.hardware.wire import Time
from tests.scenes.arcade import Arcade


class Session(RealSession):
    """The session of the settings, with an emulated XBee on its port and a clock that runs with the page."""

    def __init__(self, settings: Settings) -> None:
        super().__init__(settings)
        self.time, self.module = Time(), Module(0, 0, 9600)

    def advance(self, seconds: float) -> float:
        self.time.now += seconds
        return seconds

    def carrier(self, number: int) -> Carrier:
        return Carrier(EmulatedCarrier(self.module, self.time).open, self.time, "COM3")


@pytest.fixture
def arcade(arcade: Arcade) -> Arcade:
    arcade.context.settings.arena_id = 4711
    arcade.context.mat = SessionMat(arcade.context, Session(arcade.context.settings))
    arcade.open(RadioPage(arcade.context))
    return arcade


def go(arcade: Arcade, name: str) -> RadioPage:
    page = arcade.shown(RadioPage)
    while page.focus.name != name:
        arcade.press(Button.DOWN)
    return page


def test_number_channel_and_kinds_change_and_are_kept(arcade: Arcade) -> None:
    page = go(arcade, "arena")
    assert page._fact() == "make flash ADDRESS=1 ARENA=4711"
    arcade.press(Button.RIGHT)
    assert page.arena == 4712
    go(arcade, "channel")
    arcade.press(Button.RIGHT)
    assert page.network == (0x0B, 0x4000 | 4712)
    go(arcade, "robot")
    arcade.press(Button.RIGHT)
    go(arcade, "kind")
    arcade.press(Button.RIGHT, Button.RIGHT)
    assert page._fact() == "ESP32:  Ø 120 mm,  battery above 4.4 V"
    kept = Settings.load(folders().config)[0]
    assert (kept.arena_id, kept.radio_channel, kept.kinds) == (4712, 0x0B, ["", "esp32", "", ""])


@pytest.mark.parametrize("language", ["en", "pt"])
def test_radios_are_written_one_after_another_and_refusals_are_said(arcade: Arcade) -> None:
    page, session = go(arcade, "module"), session_of(arcade.context)
    assert isinstance(session, Session)
    arcade.press(Button.RIGHT, Button.RIGHT)
    go(arcade, "write")
    arcade.press(Button.FIRE, Button.UP)
    assert page.focus.name == "write", "nothing moves while a radio is written"
    arcade.until(lambda: page._steps is None, 10.0)
    assert session.module.saved[b"MY"] == 2
    assert session.module.network == page.network
    assert "CH 13, ID 5267" in page.message
    session.module = Module(2, 0, top_channel=0x10)
    arcade.press(Button.FIRE)
    arcade.until(lambda: page._steps is None, 10.0)
    assert "CH 13" in page.message
    arcade.frame(draw=True)
    arcade.press(Button.FIRE, Button.BACK)
    assert arcade.stack.top is arcade.setup


def test_a_rate_that_no_xbee_has_is_said_before_anything_is_written(arcade: Arcade) -> None:
    page, session = go(arcade, "write"), session_of(arcade.context)
    assert isinstance(session, Session)
    arcade.context.settings.baud = 230400
    arcade.press(Button.FIRE)
    assert page._steps is None
    assert page.message == arcade.context.words("arena_radio.no_rate")
    assert session.module.saved[b"ID"] != page.network.pan
