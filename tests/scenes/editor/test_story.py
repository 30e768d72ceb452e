"""From the lobby and from the title to an arena of one's own, and back."""

from pathlib import Path
from typing import cast

import pytest

from pigaming_app.ai.registry import new_match
from pigaming_app.games.arenas import arenas, load, own_arenas
from pigaming_app.games.registry import games
from pigaming_app.scenes.editor import store
from pigaming_app.scenes.editor.gallery.page import Gallery
from pigaming_app.scenes.editor.naming import ArenaNamePage
from pigaming_app.scenes.editor.play_test import PlayTest
from pigaming_app.scenes.editor.registry import EDITORS
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.title.scene import Title
from pigaming_app.storage.day_log import DayLog
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.editor.artist import Artist, Mouse, checked
from tests.scenes.screens import seats

pytestmark = pytest.mark.usefixtures("home")


def begin(arcade: Arcade) -> None:
    """From the setup of a match to an empty arena."""
    arcade.open(MatchSetupPage(arcade.context, "pitanks", seats("pitanks")))
    arcade.press(Button.X)
    arcade.shown(Gallery)
    arcade.press(Button.FIRE)


def test_a_wall_is_drawn_undone_and_redone_played_and_saved(artist: Artist) -> None:
    """By every device, from the set-up of a match and back to it."""
    arcade = artist.arcade
    begin(arcade)
    editor = artist.editor
    artist.drag((600, 300), (900, 300))
    (wall,) = editor.bench.history.now.of("wall")
    assert {wall.get("from"), wall.get("to")} == {(600, 300), (900, 300)}
    artist.choose("undo")
    assert not editor.bench.history.now.of("wall")
    artist.choose("redo")
    assert editor.bench.history.now.of("wall") == (wall,)
    checked(artist)
    artist.choose("play")
    assert len(arcade.shown(PlayTest).match.state.walls) >= 1
    assert arcade.shown(PlayTest).match.state.wall_count == 1
    artist.tap("start")
    assert artist.editor is editor
    checked(artist)
    artist.choose("save")
    page = arcade.shown(ArenaNamePage)
    arcade.wait(0.5)
    arcade.press(Button.UP, Button.START)
    assert artist.editor is editor
    assert own_arenas("pitanks") == [store.file_name(page.name)]
    assert len(load("pitanks", store.file_name(page.name)).walls) == 1
    assert not list(store.drafts_folder("pitanks").glob("*"))
    for _ in range(3):
        arcade.press(Button.BACK)
        if isinstance(arcade.stack.top, MatchSetupPage):
            break
    setup = arcade.shown(MatchSetupPage)
    assert setup.chosen.arena == store.file_name(page.name)


def test_a_match_that_ends_leads_back_to_the_drawing_and_into_no_log(arcade: Arcade, home: Path) -> None:
    arcade.context.day_log = DayLog(home / "data")
    begin(arcade)
    mouse = Mouse(arcade)
    editor = checked(mouse)
    arcade.press(Button.START)
    test = arcade.shown(PlayTest)
    arcade.wait(6.0)
    assert test.match.state.tick > 0
    test.match.state.robots[0].score += 1  # a tie would be played on
    test.match.state.rules.ticks = test.match.state.tick + 2
    arcade.until(lambda: arcade.stack.top is editor, 10.0)
    arcade.press(Button.BACK)
    assert not [*home.rglob("*.replay"), *home.rglob("*.jsonl"), *home.rglob("*.log")]


def test_from_the_title(arcade: Arcade, home: Path) -> None:
    title = arcade.open(Title(arcade.context))
    title.focus.move_to("editor")
    arcade.press(Button.FIRE)
    assert arcade.shown(Gallery).game == "pitanks"
    arcade.press(Button.BACK)
    assert arcade.stack.top is title


def test_a_game_without_tools_has_no_editor(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    """Such as a plug-in may be; the gallery passes it over."""
    monkeypatch.delitem(cast(dict[str, object], EDITORS), "football")
    page = arcade.open(MatchSetupPage(arcade.context, "football", seats("football")))
    assert Button.X not in page.prompts.buttons
    arcade.press(Button.X)
    assert arcade.stack.top is page
    arcade.open(Gallery(arcade.context, "football"))
    shown = []
    for _ in games():
        shown.append(arcade.shown(Gallery).game)
        arcade.press(Button.Y)
    assert shown == ["pitanks", "factory", "race", "pitanks"]


def test_a_pitch_is_drawn_played_saved_and_offered(arcade: Arcade, controls: Controls) -> None:
    """By Robot Football, a plug-in: from the set-up of a match to the match on the own pitch."""
    arcade.open(MatchSetupPage(arcade.context, "football", seats("football")))
    arcade.press(Button.X)
    assert arcade.shown(Gallery).game == "football"
    arcade.press(Button.FIRE)
    mouse = Mouse(arcade)
    mouse.choose("tool 1")
    mouse.click((800, 250))
    editor = checked(mouse)
    mouse.choose("play")
    state = arcade.shown(PlayTest).match.state
    assert (state.wall_count, state.mouth) == (1, 90.0)
    arcade.press(Button.START)
    checked(mouse)
    editor.save_as("MINE")
    arcade.press(Button.BACK)
    while not isinstance(arcade.stack.top, MatchSetupPage):
        arcade.press(Button.BACK)
    assert arcade.shown(MatchSetupPage).chosen.arena == "mine"
    assert arenas("football")[-1] == "mine"
    assert new_match(arcade.shown(MatchSetupPage)._setup()).state.wall_count == 1


@pytest.mark.parametrize("asked", [Device("pad", 7), Device("phone", 7), Device("mouse"), KEYS[1]])
def test_a_match_on_a_drawing_is_driven_by_a_device_that_is_there(arcade: Arcade, asked: Device) -> None:
    """The others: a pad and a phone that are gone, and a mouse, which cannot drive."""
    arcade.context.controls.last = KEYS[0]
    test = PlayTest(arcade.context, "pitanks", load("pitanks", "classic"), asked)
    assert test.devices[0] == (asked if asked in KEYS else KEYS[0])


@pytest.mark.parametrize(
    ("game", "name"), [("pitanks", "islands"), ("factory", "hall"), ("race", "classic"), ("football", "classic")]
)
def test_the_way_back_from_a_match_hides_no_robot_and_no_rules(arcade: Arcade, game: str, name: str) -> None:
    """On the islands robots start in the middle of each side."""
    test = arcade.open(PlayTest(arcade.context, game, load(game, name), KEYS[0]))
    arcade.wait(test.runner.view.opening + 0.1, draw=True)
    box, shown = test.runner.notice.box, test.opening.card
    assert box
    assert shown
    assert box.collidelist(test.runner.occupied(test.devices)) < 0
    card, centre = shown
    assert not box.colliderect(card.box(centre))
