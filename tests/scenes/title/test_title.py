"""The title: its targets, missing pages, and the operator's access."""

from itertools import combinations

import numpy as np
import pygame
import pytest

from pigaming_app.scenes.attract.scene import Attract
from pigaming_app.scenes.flow.scene import Stack
from pigaming_app.scenes.howto.scene import HowTo
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.options.page import OptionsPage
from pigaming_app.scenes.title.kiosk_unlock import HOLD
from pigaming_app.scenes.title.language import BOX as LANGUAGE_BOX
from pigaming_app.scenes.title.scene import Title
from pigaming_app.scenes.views.game_tile import TileStrip
from pigaming_app.ui.draw.frame_budget import budget, clock
from pigaming_app.ui.draw.surface_cache import surfaces
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets.focus import Focus
from tests.scenes.arcade import KEYS, Arcade
from tests.ui.input.virtual_pad import VirtualPad


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    arcade.stack = Stack(Title(arcade.context))


def title(arcade: Arcade) -> Title:
    return arcade.shown(Title)


def test_fire_opens_the_lobby_of_the_game_with_a_seat_and_back_returns(arcade: Arcade) -> None:
    arcade.press(Button.FIRE, device=KEYS[1])
    lobby = arcade.shown(Lobby)
    assert lobby.game == "pitanks"
    assert lobby.seats.devices() == [KEYS[1], None, None, None]
    arcade.press(Button.BACK, Button.BACK, device=KEYS[1])
    title(arcade)


def test_a_click_on_a_game_opens_its_lobby_without_anybody(arcade: Arcade) -> None:
    arcade.click(*title(arcade).focus.rect("race").center)
    assert arcade.shown(Lobby).seats.robots == 0


def test_the_row_below_leads_to_how_to_play_options_and_out(arcade: Arcade) -> None:
    for name, kind in (("howto", HowTo), ("options", OptionsPage)):
        arcade.click(*title(arcade).focus.rect(name).center)
        arcade.shown(kind)
        arcade.press(Button.BACK)
    arcade.click(*title(arcade).focus.rect("quit").center)
    assert arcade.stack.scenes == []


def test_in_a_kiosk_nobody_can_quit(arcade: Arcade) -> None:
    arcade.context.kiosk = True
    arcade.stack = Stack(Title(arcade.context))
    assert "quit" not in [spot.name for spot in title(arcade).focus.spots]


def test_one_press_changes_the_language(arcade: Arcade) -> None:
    seen = []
    for _ in LANGUAGES:
        arcade.press(Button.Y)
        seen.append(arcade.context.words.language)
        assert arcade.context.settings.language == seen[-1]
    assert sorted(seen) == sorted(LANGUAGES)
    arcade.click(*title(arcade).focus.rect("language").center)
    assert arcade.context.words.language == seen[0] != "en"


def test_the_name_of_the_new_language_is_shown_for_two_seconds(arcade: Arcade) -> None:
    page = title(arcade)
    before = drawn(arcade)
    arcade.press(Button.Y)
    assert arcade.stack.top is page
    shown = drawn(arcade)
    assert (shown == before).mean() < 0.8
    for seconds, alike, other in ((1.8, shown, before), (0.3, before, shown)):
        arcade.wait(seconds)
        now = drawn(arcade)
        assert (now == alike).mean() > 0.85 > (now == other).mean()


def drawn(arcade: Arcade) -> np.ndarray:
    """The red of the middle of the title: the tiles, but not what is said in them and runs above them."""
    title(arcade).draw(arcade.screen)
    return pygame.surfarray.array_red(arcade.screen)[LANGUAGE_BOX.left : LANGUAGE_BOX.right, 500:690].copy()


@pytest.mark.parametrize("button", [Button.UP, Button.DOWN, Button.LEFT, Button.RIGHT, Button.FIRE])
def test_a_direction_or_fire_only_takes_the_name_of_the_language_away(arcade: Arcade, button: Button) -> None:
    page = title(arcade)
    focused = page.focus.name
    arcade.press(Button.Y)
    language = arcade.context.words.language
    arcade.press(button)
    assert (arcade.stack.top, page.focus.name, page.language.left) == (page, focused, 0.0)
    assert arcade.context.words.language == language
    arcade.press(button)
    assert (arcade.stack.top, page.focus.name) != (page, focused) or button in (Button.UP, Button.LEFT)


def test_fire_on_the_language_changes_it_and_the_next_one_leaves_it(arcade: Arcade) -> None:
    page, words = title(arcade), arcade.context.words
    page.focus.index = [spot.name for spot in page.focus.spots].index("language")
    arcade.press(Button.FIRE)
    second = words.language
    arcade.press(Button.FIRE)
    assert (words.language, page.language.left) == (second, 0.0)
    at = page.focus.rect("language").center
    arcade.click(*at)
    arcade.click(*page.focus.rect("language").center)
    assert words.language == LANGUAGES[3]


SAFE = pygame.Rect(96, 54, 1728, 972)


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_game_of_a_clone_is_in_the_first_view_and_nothing_lies_on_something_else(arcade: Arcade) -> None:
    spots = Title(arcade.context).focus.spots
    assert {"pitanks", "factory", "race", "football"} <= {spot.name for spot in spots}
    assert all(SAFE.contains(spot.rect) for spot in spots)
    assert not [(a.name, b.name) for a, b in combinations(spots, 2) if a.rect.colliderect(b.rect)]


@pytest.mark.parametrize("count", range(1, 8))
def test_fewer_games_are_centred_and_of_more_the_next_one_peeks_in(count: int) -> None:
    strip = TileStrip([str(i) for i in range(count)])
    tiles = [spot.rect for spot in strip.spots()]
    assert sum(map(SAFE.contains, tiles)) == min(count, 4)
    assert tiles[0].left + tiles[min(count, 4) - 1].right == pytest.approx(1920, abs=1)
    assert sum(tile.left < 1880 for tile in tiles) == min(count, 5), "40 px of the next one are seen"
    focus = Focus(strip.spots(), str(count - 1))
    strip.follow(focus)
    assert SAFE.contains(strip.spots()[-1].rect)


def test_when_nobody_is_there_a_match_begins_and_any_press_ends_it(arcade: Arcade) -> None:
    arcade.context.settings.attract_seconds = 10.0
    arcade.context.idle = 9.9
    arcade.frame()
    title(arcade)
    arcade.context.idle = 10.1
    arcade.frame()
    assert isinstance(arcade.stack.top, Attract)
    arcade.press(Button.DOWN)
    title(arcade)
    assert arcade.context.idle == 0.0


def test_an_operator_holds_ahead_and_turbo_for_long_and_a_child_does_not(arcade: Arcade) -> None:
    arcade.context.kiosk = True
    with VirtualPad() as pad:
        arcade.wait(0.1)
        pad.stick(0.0, -1.0)
        pad.press("rightshoulder")
        arcade.wait(HOLD - 0.5)
        title(arcade)
        pad.release("rightshoulder")
        arcade.wait(1.0)
        pad.press("rightshoulder")
        arcade.wait(HOLD - 0.5)
        title(arcade)
        arcade.wait(1.0)
    page = arcade.shown(OptionsPage)
    assert "close" in page.rows


def test_outside_a_kiosk_holding_opens_nothing(arcade: Arcade) -> None:
    with VirtualPad() as pad:
        arcade.wait(0.1)
        pad.stick(0.0, -1.0)
        pad.press("rightshoulder")
        arcade.wait(HOLD + 1.0)
    title(arcade)


def test_the_first_picture_does_not_wait_for_the_tiles(arcade: Arcade) -> None:
    screen, page = pygame.Surface((1920, 1080)), Title(arcade.context)
    surfaces.clear()
    with budget.frame(behind=False, prewarm_end=clock()):
        page.draw(screen)
    assert not page.complete
    x, y, w, _ = page.focus.rect("pitanks")
    inner = pygame.Rect(x + 30, y + 40, w - 60, 160)  # where the picture of the game will be
    assert len(np.unique(pygame.surfarray.array3d(screen.subsurface(inner)))) == 1, "an empty frame"
    page.draw(screen)
    assert page.complete
    assert len(np.unique(pygame.surfarray.array3d(screen.subsurface(inner)))) > 20
