"""The controls test shows pressed buttons, and every device can leave it."""

import math

import pygame
import pytest

from pigaming_app.scenes.controls import controls_test as padtest
from pigaming_app.scenes.controls.controls_test import ControlsTest
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.robot import LAG
from pigaming_app.ui.draw import BODY
from pigaming_app.ui.draw.theme import CAPITALS
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button, Device
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.measuring import measuring
from tests.ui.input.virtual_pad import VirtualPad


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    arcade.open(ControlsTest(arcade.context))


def light(arcade: Arcade, x: int, y: int, w: int, h: int) -> int:
    """Brightness of a part of the page."""
    arcade.stack.top.draw(arcade.screen)
    return sum(pygame.transform.average_color(arcade.screen, pygame.Rect(x, y, w, h))[:3])


def test_a_held_key_is_lit_until_it_is_let_go(arcade: Arcade) -> None:
    box = (96 + 104, padtest.KEYS_Y + 2, 70, 70)  # W
    dark = light(arcade, *box)
    pygame.event.post(pygame.Event(pygame.KEYDOWN, scancode=pygame.KSCAN_W, key=0, mod=0))
    arcade.frame()
    assert light(arcade, *box) > 1.5 * dark
    pygame.event.post(pygame.Event(pygame.KEYUP, scancode=pygame.KSCAN_W, key=0, mod=0))
    arcade.frame()
    assert light(arcade, *box) == dark


@pytest.mark.parametrize("language", LANGUAGES)
def test_names_of_keys_are_set_in_the_usual_size(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    """Also LEERTASTE: its cap is wider."""
    controls = arcade.context.controls
    labels = [controls.label(device, button) for device in KEYS for button in (Button.FIRE, Button.LEAVE_SEAT)]
    with measuring(monkeypatch) as screen:
        arcade.stack.top.draw(screen)
    for label in labels:
        name = arcade.context.words.key_name(label.removeprefix("NUM "))
        (mark,) = (mark for mark in screen.texts if mark.text == name)
        assert mark.box[3] - mark.box[1] == round(CAPITALS * BODY), name
        assert any(a < mark.box[0] and mark.box[2] < c for a, b, c, d in (one.box for one in screen.frames)), name


def test_a_pad_appears_when_it_is_plugged_in_and_its_button_lights_up(arcade: Arcade) -> None:
    with VirtualPad() as pad:
        arcade.wait(0.1)
        box = (96 + 296 - 30, padtest.PADS_Y + 262 - 30, 60, 60)  # A
        dark = light(arcade, *box)
        pad.press("a")
        arcade.frame()
        assert light(arcade, *box) > 1.5 * dark
        pad.release("a")
        arcade.wait(padtest.LIT + 0.1)
        assert light(arcade, *box) == dark
    arcade.wait(0.1, draw=True)


def test_a_short_b_is_only_shown_and_a_long_one_leaves(arcade: Arcade) -> None:
    pad, _ = arcade.plug()
    pad.tap("b")
    arcade.wait(1.5)
    arcade.shown(ControlsTest)
    pad.press("b")
    arcade.wait(padtest.HOLD + 0.2)
    assert arcade.stack.top is arcade.setup


def test_escape_and_a_click_on_the_hint_leave(arcade: Arcade) -> None:
    arcade.press(Button.BACK)
    assert arcade.stack.top is arcade.setup
    arcade.open(ControlsTest(arcade.context))
    arcade.click(960, 980)
    assert arcade.stack.top is arcade.setup


def test_a_keyboard_robot_turns_with_its_keys(arcade: Arcade) -> None:
    device = Device("keys", 0)
    pygame.event.post(pygame.Event(pygame.KEYDOWN, scancode=pygame.KSCAN_D, key=0, mod=0))
    arcade.wait(0.5)
    robot = arcade.shown(ControlsTest).driven[device].robots[0]
    assert robot.angular == pytest.approx(padtest.TURN_RATE, rel=0.02)
    turned = (robot.heading - 1.5 * math.pi) % math.tau
    assert turned == pytest.approx(padtest.TURN_RATE * (0.5 - LAG), abs=0.15)


def test_a_robot_shows_the_driving_style_of_its_device_and_stays_on_its_card(arcade: Arcade) -> None:
    pad, device = arcade.plug()
    arcade.context.driving.change(device, "pitanks", -1)
    pad.stick(1.0, 0.0)
    arcade.wait(1.0)
    robot = arcade.shown(ControlsTest).driven[device].robots[0]
    assert robot.angular == pytest.approx(padtest.TURN_RATE, rel=0.02)
    arcade.context.driving.change(device, "pitanks", 1)
    arcade.wait(2.5)
    assert abs(turn_to(robot.heading)) < 0.05
    assert abs(robot.angular) < 0.05
    assert 10.0 < robot.x < 30.0
    arcade.shown(ControlsTest)
