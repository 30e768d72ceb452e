"""Driving styles of devices: chosen, remembered for the kind of device, and the defaults."""

from pathlib import Path

import pytest

from pigaming_app.ai.game_ai import HELPED_POINT, HELPED_TURN, ONE_BUTTON, POINT, TURN
from pigaming_app.ai.registry import AIS
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.driving import PICTURES, DrivingStyles
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.draw import ICONS
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.events import Device

PAD, OTHER, KEYS = Device("pad", 4), Device("pad", 5), Device("keys", 1)


def test_a_new_pad_points_and_a_keyboard_turns_and_drives() -> None:
    styles = DrivingStyles(Settings())
    for game in games():
        assert styles.of(PAD, game) == POINT
        assert styles.of(KEYS, game) == TURN


def test_a_choice_holds_for_the_device_in_every_game_and_for_new_devices_of_its_kind(tmp_path: Path) -> None:
    settings = Settings()
    styles = DrivingStyles(settings)
    styles.change(PAD, "pitanks", -1)
    assert styles.of(PAD, "factory") == TURN
    styles.change(OTHER, "pitanks", 1)
    assert (styles.of(PAD, "pitanks"), styles.of(OTHER, "pitanks")) == (TURN, POINT)
    assert styles.of(KEYS, "pitanks") == TURN
    settings.save(tmp_path)
    loaded, problems = Settings.load(tmp_path)
    assert not problems
    assert DrivingStyles(loaded).of(PAD, "pitanks") == POINT


def test_the_choice_of_one_player_does_not_change_another() -> None:
    styles = DrivingStyles(Settings())
    assert styles.of(OTHER, "race") == POINT
    styles.change(PAD, "race", -1)
    assert styles.of(OTHER, "race") == POINT
    assert styles.of(Device("pad", 9), "race") == TURN


def test_the_styles_go_round_in_both_directions() -> None:
    styles = DrivingStyles(Settings())
    seen = []
    for _ in AIS["race"].driving:
        styles.change(KEYS, "race", -1)
        seen.append(styles.of(KEYS, "race"))
    assert sorted(seen) == sorted(AIS["race"].driving)
    assert seen[-1] == TURN


def test_a_helped_style_is_the_same_without_help_in_games_that_offer_none() -> None:
    for helped, plain in ((HELPED_TURN, TURN), (HELPED_POINT, POINT)):
        styles = DrivingStyles(Settings(pad_driving=helped))
        assert styles.of(PAD, "race") == styles.of(PAD, "factory") == helped
        assert styles.of(PAD, "pitanks") == plain


def test_a_style_that_a_game_does_not_offer_is_replaced_by_the_default() -> None:
    styles = DrivingStyles(Settings(pad_driving="by voice"))
    assert styles.of(PAD, "factory") == POINT


def test_a_replugged_pad_drives_as_before_unless_its_player_has_chosen() -> None:
    styles = DrivingStyles(Settings())
    styles.change(PAD, "race", -1)
    styles.change(KEYS, "race", 1)
    styles.settings.pad_driving = POINT
    styles.inherit(OTHER, PAD)
    assert styles.of(OTHER, "race") == TURN
    styles.change(OTHER, "race", 1)
    styles.inherit(OTHER, PAD)
    assert styles.of(OTHER, "race") == POINT


def test_one_button_is_for_one_device_and_not_remembered() -> None:
    styles = DrivingStyles(Settings())
    styles.change(PAD, "pitanks", 1)
    assert styles.of(PAD, "race") == ONE_BUTTON
    assert styles.settings.pad_driving == ""
    assert styles.of(OTHER, "pitanks") == POINT
    styles.change(KEYS, "pitanks", 1)
    styles.forget_one_button()
    assert styles.of(PAD, "pitanks") == styles.of(KEYS, "pitanks") == POINT


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_style_has_a_picture_and_a_name(language: str) -> None:
    for style in {style for styles in (ai.driving for ai in AIS.values()) for style in styles}:
        assert PICTURES[style] in ICONS
        assert Words(language)(f"lobby.drive_{style}")
