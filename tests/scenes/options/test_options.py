"""The options: changes apply immediately and persist."""

import tomllib
from datetime import datetime
from itertools import chain
from pathlib import Path

import pygame
import pytest

from pigaming_app.scenes.controls.controls_test import ControlsTest
from pigaming_app.scenes.controls.remap_page import RemapPage
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.options.page import SECTIONS, OptionsPage, options_of
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.scores import Scores, ScoreTable
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.draw import BODY, readable
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets import setting_row as dials
from tests.scenes.arcade import Arcade
from tests.ui.input.virtual_pad import VirtualPad

CLEAR = 2.0  # s for which a button is held to clear the high scores
TABLE = ScoreTable("pitanks", "classic", "points", rules="plain", length=2, people=1)


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    arcade.stack.scenes[1:] = []
    arcade.open(OptionsPage(arcade.context))


def go(arcade: Arcade, name: str) -> OptionsPage:
    """Focus a row, on the page of its section."""
    page = arcade.shown(OptionsPage)
    section = next((section for section in SECTIONS if name in options_of(section)), "")
    if section and name not in page.rows:
        go(arcade, section)
        arcade.press(Button.FIRE)
        page = arcade.shown(OptionsPage)
    while page.focus.name != name:
        arcade.press(Button.DOWN)
    return page


def kept(tmp_path: Path) -> dict[str, object]:
    return tomllib.loads((tmp_path / "config" / "settings.toml").read_text())


def test_the_language_changes_immediately(arcade: Arcade, home: Path) -> None:
    go(arcade, "language")
    arcade.press(Button.RIGHT)
    assert arcade.context.words("options.title") == "Opções"
    assert kept(home)["language"] == "pt"
    arcade.shown(OptionsPage)


def test_volumes_go_from_0_to_10_and_no_further(arcade: Arcade, home: Path) -> None:
    go(arcade, "music")
    arcade.press(*[Button.LEFT] * 12)
    assert arcade.context.settings.music == 0
    arcade.press(*[Button.RIGHT] * 12)
    assert kept(home)["music"] == 10


def test_fire_cycles_through_the_values(arcade: Arcade) -> None:
    go(arcade, "flashes")
    before = arcade.context.settings.flashes
    seen = [before]
    for _ in range(3):
        arcade.press(Button.FIRE)
        seen.append(arcade.context.settings.flashes)
    assert set(seen) == {"off", "soft", "full"}
    assert seen[-1] == before


def test_a_mouse_sets_a_volume_and_a_switch_where_it_clicks(arcade: Arcade) -> None:
    music = go(arcade, "music").focus.rect("music")
    arcade.click(music.x + dials.AT + 3 * dials.CELL - 10, music.centery)
    assert arcade.context.settings.music == 3
    arcade.click(music.x + 60, music.centery)
    assert arcade.context.settings.music == 3
    off = dials.chips((arcade.context.words("options.off"), arcade.context.words("options.on")))[0]
    arcade.press(Button.BACK)
    shake = go(arcade, "shake").focus.rect("shake")
    arcade.click(shake.x + off[0] + 10, shake.centery)
    assert arcade.context.settings.shake is False


@pytest.mark.parametrize("language", LANGUAGES)
def test_all_toggles_end_within_their_row(arcade: Arcade) -> None:
    arcade.context.kiosk = True
    for page in (OptionsPage(arcade.context, operator=True, section=section) for section in ("", *SECTIONS)):
        for value in map(page.value, page.rows):
            if value.kind in ("toggle", "action"):
                x, w = dials.chips(value.options)[-1]
                assert x + w <= dials.W - 24


@pytest.mark.parametrize("kiosk", [False, True])
def test_high_scores_go_only_when_a_button_is_held_for_two_seconds(arcade: Arcade, home: Path, kiosk: bool) -> None:
    arcade.context.kiosk = kiosk
    arcade.open(OptionsPage(arcade.context, operator=True))
    arcade.context.scores.add(TABLE, "ANA", 7, datetime(2026, 5, 1, 12))
    ghost = home / "data" / "ghosts" / "classic-408db7c8.json"
    ghost.parent.mkdir(parents=True)
    ghost.write_text("{}")
    with VirtualPad() as pad:
        arcade.frame()
        go(arcade, "reset")
        for _ in range(5):
            pad.tap("a")
            arcade.wait(0.3)
        pad.press("a")
        arcade.wait(CLEAR - 0.1, draw=True)
        pad.release("a")
        arcade.wait(1.0)
        assert ghost.is_file()
        assert arcade.context.scores.best(TABLE), "taps, and a hold that is too short"
        pad.press("a")
        arcade.wait(CLEAR + 0.1)
    assert not arcade.context.scores.best(TABLE)
    assert not Scores.load(home / "data")[0].tables()
    assert not ghost.exists()


def test_a_ghost_that_cannot_be_deleted_leaves_the_scores_cleared(arcade: Arcade, home: Path) -> None:
    arcade.context.scores.add(TABLE, "ANA", 7, datetime(2026, 5, 1, 12))
    (home / "data" / "ghosts" / "a folder.json").mkdir(parents=True)
    OptionsPage(arcade.context, section="games").held()
    assert not Scores.load(home / "data")[0].tables()


@pytest.mark.parametrize("kiosk", [False, True])
@pytest.mark.parametrize("section", ["", *SECTIONS])
def test_every_row_is_one_step_below_the_one_before(arcade: Arcade, section: str, kiosk: bool) -> None:
    arcade.context.kiosk = kiosk
    arcade.open(OptionsPage(arcade.context, operator=True, section=section))
    page = arcade.shown(OptionsPage)
    for name in (*page.rows[1:], page.rows[0]):
        arcade.press(Button.DOWN)
        assert page.focus.name == name
    assert page.focus.rect(page.rows[-1]).bottom <= 894  # a message and the prompts lie below


@pytest.mark.parametrize("mouse", [False, True])
@pytest.mark.parametrize("section", SECTIONS)
def test_every_section_is_one_press_away_and_leads_back(arcade: Arcade, section: str, mouse: bool) -> None:
    page = go(arcade, section)
    if mouse:
        arcade.click(*page.focus.rect(section).center)
    else:
        arcade.press(Button.START)
    assert arcade.shown(OptionsPage).rows == tuple(options_of(section))
    arcade.press(Button.BACK)
    assert arcade.shown(OptionsPage).focus.name == section


def test_high_scores_stay_when_somebody_moves_on_while_holding(arcade: Arcade) -> None:
    arcade.context.scores.add(TABLE, "ANA", 7)
    with VirtualPad() as pad:
        arcade.frame()
        go(arcade, "reset")
        pad.press("a")
        arcade.wait(1.0)
        arcade.press(Button.UP)
        arcade.wait(2.0)
    assert arcade.context.scores.best(TABLE)


def test_a_mouse_holds_its_button_to_clear_high_scores(arcade: Arcade) -> None:
    arcade.context.scores.add(TABLE, "ANA", 7)
    row = go(arcade, "reset").focus.rect("reset")
    for wait, kept in ((0.2, True), (CLEAR + 0.1, False)):
        for kind in (pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP):
            at = (row.x + dials.AT + 20, row.centery)
            pygame.event.post(pygame.Event(kind, button=pygame.BUTTON_LEFT, pos=at))
            arcade.wait(wait)
        assert bool(arcade.context.scores.best(TABLE)) is kept


def test_a_failed_save_is_reported_and_the_change_still_applies(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(self: Settings, folder: Path) -> None:
        raise NotSaved("the disk is full")

    monkeypatch.setattr(Settings, "save", full)
    page = go(arcade, "shake")
    arcade.press(Button.FIRE)
    assert arcade.context.settings.shake is False
    assert page.message == arcade.context.words("app.unsaved")
    arcade.shown(OptionsPage)


def rows_of(arcade: Arcade, operator: bool) -> set[str]:
    """All rows of the options and of the sections that they lead to."""
    main = OptionsPage(arcade.context, operator).rows
    sections = [OptionsPage(arcade.context, operator, name).rows for name in main if name in SECTIONS]
    return {*main, *chain(*sections)}


def test_children_in_a_kiosk_find_neither_volume_nor_display_nor_the_way_out(arcade: Arcade) -> None:
    arcade.context.kiosk = True
    children, operator = rows_of(arcade, False), rows_of(arcade, True)
    assert children == {"language", "controls", "rumble", "padtest", "ease", "calm", "flashes", "shake", "large"}
    assert operator == {"close", *(row for section in ("", *SECTIONS) for row in options_of(section))}
    arcade.open(OptionsPage(arcade.context, operator=True))
    go(arcade, "close")
    arcade.press(Button.FIRE)
    assert arcade.stack.scenes == []


@pytest.mark.parametrize(("row", "page"), [("padtest", ControlsTest), ("remap", RemapPage)])
def test_pages_of_the_controls_are_one_press_away(arcade: Arcade, row: str, page: type[Scene]) -> None:
    go(arcade, row)
    arcade.press(Button.FIRE)
    arcade.shown(page)
    arcade.press(Button.BACK)
    assert arcade.shown(OptionsPage).focus.name == row


def test_rumbling_can_be_switched_off_and_on_again_with_a_sample(arcade: Arcade, home: Path) -> None:
    pad, _ = arcade.plug()
    go(arcade, "rumble")
    pad.tap("left")
    arcade.frame()
    assert kept(home)["rumble"] is False
    arcade.shown(OptionsPage)
    assert pad.rumbles == []
    pad.tap("right")
    arcade.frame()
    assert kept(home)["rumble"] is True
    assert max(pad.rumbles[0]) > 0


def test_what_makes_it_easier_has_a_page_of_its_own(arcade: Arcade, home: Path) -> None:
    go(arcade, "ease")
    arcade.press(Button.FIRE)
    page = arcade.shown(OptionsPage)
    assert {*page.rows} >= {"calm", "flashes", "shake", "large"}
    go(arcade, "calm")
    arcade.press(Button.RIGHT)
    go(arcade, "large")
    arcade.press(Button.RIGHT)
    assert (kept(home)["calm"], kept(home)["large_text"]) == (True, True)
    arcade.press(Button.LEFT)
    assert readable(BODY) == BODY
