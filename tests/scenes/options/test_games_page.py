"""Plug-ins in the options, and the question about a new one on the title."""

import json
from pathlib import Path

import pytest

from pigaming_app.jobs.new_game import write
from pigaming_app.scenes.options import games_page
from pigaming_app.scenes.options.games_page import ROWS, GamesPage, NewGame, why
from pigaming_app.scenes.options.page import OptionsPage
from pigaming_app.scenes.title import scene as title
from pigaming_app.scenes.title.scene import Title
from pigaming_app.storage.plugins import consent
from pigaming_app.storage.plugins.consent import is_on, switch
from pigaming_app.storage.plugins.found import Plugin, found, user_folder
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.widgets import setting_row
from pigaming_app.ui.widgets.button_prompts import places
from tests.scenes.arcade import Arcade
from tests.ui.input.virtual_pad import VirtualPad


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    write(user_folder() / "tag", "tag")


def tag() -> Plugin:
    return next(plugin for plugin in found() if plugin.name == "tag")


def decided(home: Path) -> object:
    file = home / "config" / consent.FILE
    return json.loads(file.read_text()) if file.exists() else {}


def opened(arcade: Arcade) -> GamesPage:
    """The page, with Tag in focus."""
    arcade.open(GamesPage(arcade.context))
    page = arcade.shown(GamesPage)
    while page.plugins[page.focus.name].name != "tag":
        arcade.press(Button.DOWN)
    return page


def test_the_options_lead_to_it(arcade: Arcade) -> None:
    arcade.open(OptionsPage(arcade.context, section="games"))
    arcade.press(Button.FIRE)
    arcade.shown(GamesPage)


@pytest.mark.parametrize("device", ["keys", "pad", "mouse"])
def test_a_switch_is_saved_and_counts_from_the_next_start(arcade: Arcade, home: Path, device: str) -> None:
    switch("tag", False)
    page = opened(arcade)
    if device == "keys":
        arcade.press(Button.RIGHT)
    elif device == "pad":
        with VirtualPad() as pad:
            arcade.frame()
            pad.tap("a")
            arcade.wait(0.2)
    else:
        row = page.focus.rect(page.focus.name)
        on = setting_row.chips((arcade.context.words("options.off"), arcade.context.words("options.on")))[1]
        arcade.click(row.x + on[0] + 10, row.centery)
    assert decided(home) == {"tag": True}
    assert page.line(page.focus.name) == arcade.context.words("plugins.on_later")
    assert page.subtitle == "Changes take effect at the next start."
    arcade.press(Button.LEFT)
    assert decided(home) == {"tag": False}


@pytest.mark.parametrize(("button", "decision"), [(Button.X, True), (Button.FIRE, False), (Button.BACK, None)])
def test_a_new_one_asks_before_it_is_switched_on(
    arcade: Arcade, home: Path, button: Button, decision: bool | None
) -> None:
    page = opened(arcade)
    assert page.line(page.focus.name) == arcade.context.words("plugins.new_line")
    arcade.press(Button.FIRE)
    arcade.wait(0.1)
    question = arcade.shown(NewGame)
    assert decided(home) == {}
    arcade.press(Button.X)
    assert question.state == "question", "a press right after it has opened does not count"
    arcade.wait(1.0)
    arcade.press(button)
    assert decided(home) == ({} if decision is None else {"tag": decision})
    if decision is not None:
        arcade.shown(NewGame)
        arcade.press(Button.FIRE)
    assert arcade.shown(GamesPage).value(page.focus.name).chosen == int(bool(decision))


def test_the_title_asks_once_about_each_new_one_but_no_child_in_a_kiosk(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    new = [tag(), Plugin("chess", "chess", Path("/opt/chess"), origin="chess 1.0")]
    monkeypatch.setattr(title, "undecided", lambda: new)
    arcade.stack.scenes[:] = []
    arcade.context.kiosk = True
    arcade.open(Title(arcade.context))
    arcade.wait(0.5)
    arcade.shown(Title)
    arcade.context.kiosk = False
    asked = []
    for _ in new:
        arcade.wait(1.0)
        asked.append(arcade.shown(NewGame).plugin)
        arcade.press(Button.BACK)
    assert asked == new
    arcade.wait(1.0)
    arcade.shown(Title)
    assert is_on(new[0]) is None


def test_the_mouse_answers_on_the_words(arcade: Arcade, home: Path) -> None:
    arcade.open(NewGame(arcade.context, tag()))
    arcade.wait(1.0)
    prompts = arcade.shown(NewGame).prompts
    ends = places(prompts.labels, prompts.room)[prompts.buttons.index(Button.X)]
    arcade.click(sum(ends) / 2, prompts.y)
    assert decided(home) == {"tag": True}


def test_a_decision_that_cannot_be_saved_is_said(arcade: Arcade, home: Path) -> None:
    (home / "config").write_text("no folder")
    arcade.open(NewGame(arcade.context, tag()))
    arcade.wait(1.0)
    arcade.press(Button.X)
    assert arcade.shown(NewGame).state == "unsaved"


def test_many_are_on_pages_that_go_round(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    many = tuple(Plugin(f"game{i}", f"game{i}", Path("/opt")) for i in range(2 * ROWS + 1))
    monkeypatch.setattr(games_page, "found", lambda: many)
    arcade.open(GamesPage(arcade.context))
    seen: list[str] = []
    for _ in range(3):
        page = arcade.shown(GamesPage)
        seen += [plugin.name for plugin in page.plugins.values()]
        while page.focus.name != "more":
            arcade.press(Button.DOWN)
        arcade.press(Button.FIRE, device=Device("keys", 0))
    assert seen == [plugin.name for plugin in many]
    assert arcade.shown(GamesPage).first == 0


def test_without_any_the_page_names_their_folder(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(games_page, "found", lambda: ())
    arcade.open(GamesPage(arcade.context))
    assert str(user_folder()) in arcade.shown(GamesPage).line("none")
    arcade.press(Button.FIRE)
    assert not isinstance(arcade.stack.top, GamesPage)


def test_one_that_failed_is_shown_with_its_reason(arcade: Arcade) -> None:
    write(user_folder() / "football", "football")
    twin = next(plugin for plugin in found() if plugin.fault)
    assert why(twin) == f"there is one in {found()[0].folder} already"
    page = arcade.open(GamesPage(arcade.context))
    while page.plugins[page.focus.name] != twin:
        arcade.press(Button.DOWN)
    assert page.line(page.focus.name) == arcade.context.words("plugins.failed_line")
    arcade.shown(GamesPage)
