"""The number pad: told in picture and words, and offered only where it is."""

from pathlib import Path

import pygame
import pytest

from pigaming_app.scenes.controls.controls_test import ControlsTest
from pigaming_app.scenes.controls.remap_page import RemapPage
from pigaming_app.scenes.events.drivers import driver_label, suggested
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.howto.scene import HowTo
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.lobby.seats import EMPTY
from pigaming_app.scenes.start import opened
from pigaming_app.ui.draw import icons
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, InputEvent
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.measuring import measuring
from tests.scenes.screens import match
from tests.ui.input.test_keyboard import key
from tests.ui.input.virtual_pad import VirtualPad

KP5 = pygame.KSCAN_KP5


def seen(monkeypatch: pytest.MonkeyPatch, scene: Scene) -> tuple[str, set[str]]:
    """The texts of a page and the names of its icons."""
    drawn: set[str] = set()
    with monkeypatch.context() as patch:
        for name, draw in icons.ICONS.items():
            patch.setitem(icons.ICONS, name, lambda pen, name=name, draw=draw: drawn.add(name) or draw(pen))  # type: ignore[func-returns-value, misc]
        with measuring(patch) as screen:
            scene.draw(screen)
            return " ".join(mark.text for mark in screen.texts), drawn


@pytest.mark.parametrize("language", LANGUAGES)
def test_it_is_a_picture_and_words_wherever_it_is_shown(
    arcade: Arcade, controls: Controls, monkeypatch: pytest.MonkeyPatch
) -> None:
    words = arcade.context.words("devices.Keypad")
    controls.presses([key(KP5), key(KP5, down=False)])
    assert controls.last == KEYS[3]
    lobby = Lobby(arcade.context, "pitanks")
    for device in (KEYS[3], KEYS[0]):
        lobby.handle(InputEvent(Button.FIRE, device))
    playing = match(arcade)
    playing.devices[3] = KEYS[3]
    for scene in (lobby, HowTo(arcade.context), RemapPage(arcade.context), ControlsTest(arcade.context), playing):
        texts, signs = seen(monkeypatch, scene)
        assert words in texts, scene
        assert "keypad" in signs, scene
        assert "8456" not in texts


@pytest.mark.parametrize("language", LANGUAGES)
def test_where_none_was_ever_pressed_pads_and_phones_are_offered_instead(
    arcade: Arcade, controls: Controls, monkeypatch: pytest.MonkeyPatch
) -> None:
    lobby = Lobby(arcade.context, "pitanks")
    words = arcade.context.words
    texts, signs = seen(monkeypatch, lobby)
    assert "NUM 0" not in texts
    assert words("lobby.plug") in texts
    assert {"pad", "phone"} <= signs
    controls.presses([key(KP5), key(KP5, down=False)])
    texts, signs = seen(monkeypatch, lobby)
    assert "NUM 0" in texts
    assert words("lobby.plug") not in texts
    assert not {"pad", "phone"} & signs


def test_the_seats_that_no_free_device_can_take_are_offered_to_pads_and_phones(
    arcade: Arcade, controls: Controls, monkeypatch: pytest.MonkeyPatch
) -> None:
    lobby = Lobby(arcade.context, "pitanks")
    for device in KEYS[:3]:
        lobby.handle(InputEvent(Button.FIRE, device))
    assert lobby.page.free == []
    assert arcade.context.words("lobby.plug") in seen(monkeypatch, lobby)[0]
    with VirtualPad():
        controls.presses(pygame.event.get())
        assert len(lobby.page.free) == len(lobby.seats.of_kind(EMPTY)) == 1
        assert arcade.context.words("lobby.plug") not in seen(monkeypatch, lobby)[0]
    controls.presses(pygame.event.get())


def test_an_event_calls_nobody_to_a_number_pad_that_may_not_exist(controls: Controls) -> None:
    words = Arcade(controls).context.words
    seats = dict.fromkeys(range(4), "")
    assert 3 not in suggested(controls, seats)
    assert driver_label(words, controls, None, "") == ("pad", "Pad 1")
    controls.has_keypad = True
    assert suggested(controls, seats)[3] == KEYS[3]
    assert driver_label(words, controls, KEYS[3], "") == ("keypad", "Number pad")


def test_it_is_remembered_across_starts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    for known in (False, True):
        with opened(Options(headless=True, frames=2)) as app:
            assert app.context.controls.has_keypad is known
            pygame.event.post(key(pygame.KSCAN_KP7))
            app.loop()
            assert app.context.controls.has_keypad


def test_keys_moved_off_it_are_an_ordinary_part_of_the_keyboard(controls: Controls) -> None:
    letters = {"up": "T", "left": "F", "down": "G", "right": "H"}
    controls.remap({"keys4": {name: getattr(pygame, f"KSCAN_{letter}") for name, letter in letters.items()}})
    assert (controls.name(KEYS[3]), controls.sign(KEYS[3]), controls.moves(KEYS[3])) == ("Keyboard", "keys", "TFGH")
    assert KEYS[3] in controls.offered()
