"""Changed keys and buttons: swaps, contradictions, labels, and what reaches the menus and robots."""

import pygame
import pytest

from pigaming_app.ui.input import gamepads, keyboard
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.input.remap import assigned, differences, merged
from tests.ui.input.test_keyboard import ARROWS, WASD, key
from tests.ui.input.virtual_pad import VirtualPad

DEFAULTS = {"one": {"fire": 1, "turbo": 2}, "two": {"fire": 3}}


def test_a_code_that_is_taken_changes_places() -> None:
    after = assigned(merged(DEFAULTS, {}), "one", "fire", 3)
    assert after == {"one": {"fire": 3, "turbo": 2}, "two": {"fire": 1}}
    assert differences(after, DEFAULTS) == {"one": {"fire": 3}, "two": {"fire": 1}}
    assert merged(DEFAULTS, differences(after, DEFAULTS)) == after
    assert assigned(after, "one", "fire", 9)["two"] == {"fire": 1}, "a free one takes nothing away"


@pytest.mark.parametrize(
    "changed", [{"one": {"fire": 2}}, {"one": {"fire": 3}}, {"one": {"jump": 7}}, {"six": {"fire": 7}}]
)
def test_contradictions_and_unknown_names_do_not_count(changed: dict[str, dict[str, int]]) -> None:
    assert merged(DEFAULTS, changed) == DEFAULTS


def test_pads_do_not_share_their_buttons() -> None:
    assert merged(DEFAULTS, {"two": {"fire": 1}}, shared=False)["two"] == {"fire": 1}


def test_a_changed_key_acts_and_has_its_label(controls: Controls) -> None:
    controls.remap({"keys1": {"fire": pygame.KSCAN_Q}})
    assert controls.label(WASD, Button.FIRE) == "Q"
    (press,) = controls.presses([key(pygame.KSCAN_Q)])
    assert (press.button, press.device) == (Button.FIRE, WASD)
    assert controls.drive(WASD).fire
    assert controls.presses([key(pygame.KSCAN_SPACE)]) == []
    controls.remap({})
    assert controls.presses([key(pygame.KSCAN_SPACE)])[0].button is Button.FIRE


def test_a_key_of_another_player_is_no_longer_theirs(controls: Controls) -> None:
    controls.remap({"keys1": {"fire": pygame.KSCAN_SLASH}})
    assert controls.presses([key(pygame.KSCAN_SLASH)])[0].device == WASD
    assert not controls.drive(ARROWS).fire
    assert controls.presses([key(pygame.KSCAN_RCTRL)])[0].device == ARROWS, "the first key stays"


def test_changed_steering_is_shown(controls: Controls) -> None:
    assert (controls.moves(WASD), controls.moves(ARROWS)) == ("WASD", "← ↑ ↓ →")
    controls.remap(
        {"keys1": {"up": pygame.KSCAN_T, "left": pygame.KSCAN_F, "down": pygame.KSCAN_G, "right": pygame.KSCAN_H}}
    )
    assert controls.moves(WASD) == "TFGH"
    controls.presses([key(pygame.KSCAN_T)])
    assert controls.drive(WASD).linear == 1.0


def test_keys_that_menus_need_cannot_be_given_away(controls: Controls) -> None:
    for code in (pygame.KSCAN_ESCAPE, pygame.KSCAN_F1, pygame.KSCAN_RETURN, pygame.KSCAN_F11):
        assert not keyboard.usable("fire", code)
    assert not keyboard.usable("up", pygame.KSCAN_INSERT), "has no sign of one character"
    controls.remap({"keys1": {"fire": pygame.KSCAN_ESCAPE}})
    assert controls.label(WASD, Button.FIRE) == "SPACE"


def test_a_changed_button_acts_on_every_pad_of_its_kind(controls: Controls) -> None:
    controls.remap({"Xbox": {"fire": pygame.CONTROLLER_BUTTON_X, "x": pygame.CONTROLLER_BUTTON_A}})
    with VirtualPad() as pad:
        controls.presses(pygame.event.get())
        (device,) = controls.pads()
        if controls.name(device) != "Xbox":
            pytest.skip("the virtual pad is of another kind")
        assert (controls.label(device, Button.FIRE), controls.label(device, Button.X)) == ("X", "A")
        pad.press("x")
        pressed = controls.presses(pygame.event.get())
        assert [press.button for press in pressed] == [Button.FIRE]
        assert controls.drive(device).fire


def test_shoulder_buttons_always_stop_the_robots() -> None:
    assert not gamepads.usable("Xbox", pygame.CONTROLLER_BUTTON_LEFTSHOULDER)
    assert not gamepads.usable("Joystick", 4)
    assert gamepads.usable("Xbox", pygame.CONTROLLER_BUTTON_LEFTSTICK)
    assert gamepads.button_label("Xbox", pygame.CONTROLLER_BUTTON_LEFTSTICK) == "L3"


def test_a_listener_gets_one_key_and_nobody_else_does(controls: Controls) -> None:
    got: list[tuple[Device, int]] = []
    controls.listen(lambda device, code: got.append((device, code)))
    assert controls.presses([key(pygame.KSCAN_SPACE), key(pygame.KSCAN_SPACE, down=False)]) == []
    assert got == [(Device("keys"), pygame.KSCAN_SPACE)]
    assert len(controls.presses([key(pygame.KSCAN_SPACE)])) == 1
