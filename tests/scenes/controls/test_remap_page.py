"""The page on which keys and buttons are changed."""

import tomllib
from pathlib import Path

import pygame
import pytest

from pigaming_app.scenes.controls.remap_page import WAIT, RemapPage
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.measuring import faults, measuring
from tests.ui.input.test_keyboard import key


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    arcade.open(RemapPage(arcade.context))


def give(arcade: Arcade, function: str, code: int) -> RemapPage:
    """Give a function another key."""
    page = arcade.shown(RemapPage)
    while page.focus.name != function:
        arcade.press(Button.DOWN)
    arcade.press(Button.FIRE)
    assert page.awaited == function
    arcade.context.controls.presses([key(code), key(code, down=False)])
    assert not page.awaited
    return page


def kept(tmp_path: Path) -> object:
    return tomllib.loads((tmp_path / "config" / "settings.toml").read_text()).get("controls")


def test_a_new_key_is_used_and_kept(arcade: Arcade, home: Path) -> None:
    give(arcade, "fire", pygame.KSCAN_Q)
    assert arcade.context.controls.label(KEYS[0], Button.FIRE) == "Q"
    assert kept(home) == {"keys1": {"fire": pygame.KSCAN_Q}}
    loaded, problems = Settings.load(home / "config")
    assert (loaded.controls, problems) == ({"keys1": {"fire": pygame.KSCAN_Q}}, [])


def test_a_key_that_is_taken_changes_places_and_all_can_be_as_usual_again(arcade: Arcade, home: Path) -> None:
    page = give(arcade, "fire", pygame.KSCAN_LSHIFT)
    assert kept(home) == {"keys1": {"fire": pygame.KSCAN_LSHIFT, "turbo": pygame.KSCAN_SPACE}}
    give(arcade, "up", pygame.KSCAN_I)
    assert arcade.context.controls.label(KEYS[2], Button.UP) == "W", "of another player"
    while page.focus.name != "normal":
        arcade.press(Button.DOWN)
    arcade.press(Button.FIRE)
    assert arcade.context.controls.label(KEYS[0], Button.FIRE) == "SPACE"
    assert not kept(home)


@pytest.mark.parametrize("code", [pygame.KSCAN_ESCAPE, pygame.KSCAN_F1, pygame.KSCAN_RETURN])
def test_keys_of_the_menus_change_nothing(arcade: Arcade, code: int) -> None:
    give(arcade, "fire", code)
    assert arcade.context.settings.controls == {}
    arcade.shown(RemapPage)


def test_without_a_key_the_page_stops_waiting(arcade: Arcade) -> None:
    page = arcade.shown(RemapPage)
    arcade.press(Button.DOWN, Button.FIRE)
    assert page.awaited
    page.update(WAIT + 0.1)
    assert not page.awaited
    assert arcade.context.controls.presses([key(pygame.KSCAN_SPACE)])


def test_left_and_right_change_the_device(arcade: Arcade) -> None:
    page = arcade.shown(RemapPage)
    seen = []
    for _ in page.devices:
        seen.append(page.device)
        arcade.press(Button.RIGHT)
    assert seen == ["keys1", "keys2", "keys3", "keys4"]
    assert page.device == "keys1"


@pytest.mark.parametrize("language", LANGUAGES)
def test_nothing_overlaps(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    page = arcade.shown(RemapPage)
    for _ in page.focus.spots:
        with measuring(monkeypatch) as screen:
            page.update(0.4)
            page.draw(screen)
            assert faults(screen) == []
        arcade.press(Button.DOWN)
