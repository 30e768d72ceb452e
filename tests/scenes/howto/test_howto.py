"""How to play: the pages of every game, and the lessons on them."""

from dataclasses import replace

import pytest

from pigaming_app.games.registry import games
from pigaming_app.scenes.howto import scene as howto
from pigaming_app.scenes.howto.feature import show
from pigaming_app.scenes.howto.scene import HowTo, taught
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.storage.settings import Choice
from pigaming_app.ui.draw import TITLE, button_width, text_width
from pigaming_app.ui.draw.layers import LEFT
from pigaming_app.ui.input.events import Button, InputEvent
from tests.scenes.arcade import KEYS, Arcade


def test_left_and_right_turn_all_pages_of_all_games(arcade: Arcade) -> None:
    scene = HowTo(arcade.context)
    seen = []
    for _ in range(sum(SCREENS[game].page_count for game in taught()) + 1):
        seen.append((scene.game, scene.page, tuple(name for name, _ in scene.lessons())))
        scene.handle(InputEvent(Button.RIGHT, KEYS[0]))
    assert seen[0] == seen[-1]
    shown = [name for _, _, names in seen[:-1] for name in names]
    assert shown == [name for game in taught() for name in SCREENS[game].lessons]
    scene.handle(InputEvent(Button.LEFT, KEYS[0]))
    assert (scene.game, scene.page) == seen[0][:2]


def test_a_game_without_lessons_has_no_page(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(SCREENS, "football", replace(SCREENS["football"], lessons={}))
    scene = HowTo(arcade.context, "football")
    assert scene.game == "pitanks"
    scene.draw(arcade.screen)
    scene.handle(InputEvent(Button.LEFT, KEYS[0]))
    assert scene.game == "race"
    assert show(arcade.context, "football") is None
    assert show(arcade.context, "race")


@pytest.mark.parametrize("wide", [0, 420])
def test_as_many_names_of_games_are_shown_as_have_room(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, wide: int
) -> None:
    """`wide`: px of a name; 0: as it is."""
    if wide:
        monkeypatch.setattr(howto, "chip_width", lambda word: wide)
    for game in taught():
        names = HowTo(arcade.context, game)._names()
        shown = [name for name, _ in names]
        assert game in shown
        assert ", ".join(shown) in ", ".join(taught()), "neighbours"
        assert (shown == taught()) is not bool(wide)
        arrows = names[0][1].left - howto.GAP - button_width("<>")
        assert arrows - howto.GAP >= LEFT + text_width(arcade.context.words("title.howto"), TITLE)


def test_a_page_names_the_minutes_of_its_rule_set(arcade: Arcade) -> None:
    scene = HowTo(arcade.context, "factory")
    minutes = []
    for page in range(SCREENS["factory"].page_count):
        scene.page = page
        minutes.append(scene.minutes())
    assert minutes == [variant.default_minutes for variant in games()["factory"].variants.values()]
    arcade.context.settings.games["factory"] = Choice("hall", 2, "party")
    assert scene.minutes() == minutes[2]
    scene.page = 1
    assert scene.minutes() == 2
