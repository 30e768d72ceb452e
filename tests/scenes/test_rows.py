"""Pages of rows: each row has a picture of its own, and a new option is a setting, a row and a picture."""

import pygame
import pytest

from pigaming_app.scenes.options.page import SECTIONS, OptionsPage, switch
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets.setting_row import CENTRE
from tests.scenes.arcade import Arcade
from tests.scenes.screens import SCREENS

PAGES = (
    "operator",
    "operator day",
    "robots menu",
    "arena and radio",
    "play test",
    *(f"options {section}" for section in SECTIONS),
)
SHARED = ("kind", "quiet_until", "fullscreen", "board")  # rows with the picture of the one above them


def picture(page: SettingsPage, row: str) -> bytes:
    """What a row draws round the middle of the panel; empty if that is nothing."""
    screen = pygame.Surface((1920, 1080))
    page.draw_picture(screen, row, page.value(row).chosen)
    drawn = screen.subsurface(pygame.Rect(0, 0, 480, 340).move(CENTRE[0] - 240, CENTRE[1] - 170))
    pixels = pygame.image.tobytes(drawn, "RGB")
    return pixels if any(pixels) else b""


@pytest.mark.parametrize("name", PAGES)
def test_every_row_has_a_picture_of_its_own(arcade: Arcade, name: str) -> None:
    arcade.context.kiosk = name == "operator"  # it has a row that ends the arcade
    page = SCREENS[name](arcade)
    assert isinstance(page, SettingsPage)
    pictures = {row: picture(page, row) for row in page.rows if row not in SHARED}
    assert all(pictures.values())
    assert len({*pictures.values()}) == len(pictures)


def test_a_new_option_is_a_setting_a_row_and_a_picture(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    words = arcade.context.words
    monkeypatch.setattr(words, "_texts", {**words._texts, "options.keypad": "Keypad", "options.keypad_line": "Keys."})
    monkeypatch.setitem(SECTIONS["ease"], "keypad", switch("keypad"))  # a setting that had no row
    arcade.open(OptionsPage(arcade.context, section="ease"))
    arcade.press(Button.UP, Button.RIGHT)
    assert Settings.load(folders().config)[0].keypad is True
    arcade.context.kiosk = True
    assert "keypad" in OptionsPage(arcade.context, section="ease").rows
    with pytest.raises(KeyError, match="keypad"):  # it was forgotten in pictures.py
        arcade.stack.top.draw(arcade.screen)
