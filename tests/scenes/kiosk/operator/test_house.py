"""The house's rules, laps, arenas and language return when the title has waited; visitors' choices are not saved."""

from pathlib import Path

import pytest

from pigaming_app.games.registry import games
from pigaming_app.scenes.app import App
from pigaming_app.scenes.attract.scene import Attract
from pigaming_app.scenes.flow.match_choice import last_choice, playable_arenas
from pigaming_app.scenes.flow.scene import Push
from pigaming_app.scenes.kiosk.operator.page import ROWS, OperatorPage
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.options.page import OptionsPage
from pigaming_app.scenes.start import opened
from pigaming_app.scenes.title.scene import Title
from pigaming_app.storage.settings import Choice, Settings
from pigaming_app.ui.input.events import Button, InputEvent
from tests.scenes.arcade import KEYS

HOUSE = """
language = "pt"
strength = "level2"
attract_seconds = {attract}
keep_choices = {keep}
pin_asked = true
[games.race]
arena = "kidney"
minutes = 3
goal = 5
[games.tag]
arena = "yard"
"""


def house(home: Path, attract: float = 3600.0, keep: str = "false") -> Path:
    (home / "config").mkdir(parents=True)
    (home / "config" / "settings.toml").write_text(HOUSE.format(attract=attract, keep=keep))
    return home / "config"


def visit(app: App) -> None:
    """A visitor presses something, and chooses other rules, laps, arenas and a language."""
    settings = app.context.settings
    press(app, Button.Y)
    for game, rules in games().items():
        settings.choice(game).arena = playable_arenas(game)[-1]
        settings.choice(game).variant = list(rules.variants)[-1]
        settings.choice(game).goal = 1
    settings.choice("tag").arena = "hall"
    settings.strength = "level5"
    app.context.idle = 0.0


def press(app: App, *buttons: Button) -> None:
    for button in buttons:
        app.stack.apply(app.stack.top.handle(InputEvent(button, KEYS[0])))


def wait(app: App, seconds: float) -> None:
    for _ in range(4):
        app.compose(seconds / 4)


def is_house(app: App) -> bool:
    """True if everything is the house's; false if nothing is."""
    settings, words = app.context.settings, app.context.words
    checks = [
        (settings.language, words.language) == ("pt", "pt"),
        settings.strength == "level2",
        settings.choice("race") == Choice("kidney", 3, "", 5),
        settings.choice("tag") == Choice("yard"),
        *(settings.choice(game) == Choice() for game in games() if game != "race"),
        last_choice(app.context, "race").goal == 5,
    ]
    assert len(set(checks)) == 1, checks
    return checks[0]


@pytest.mark.parametrize("attract", [3600.0, 5.0])
def test_they_return_after_a_minute_of_the_title_or_of_attract_mode(home: Path, attract: float) -> None:
    config = house(home, attract)
    with opened(Options(headless=True, step=1.0)) as app:
        assert is_house(app)
        visit(app)
        wait(app, 58)
        assert isinstance(app.stack.top, Attract if attract < 58 else Title)
        assert not is_house(app)
        wait(app, 3)
        assert is_house(app)
        press(app, *[Button.FIRE] * isinstance(app.stack.top, Attract))
        visit(app)
        app.stack.apply(Push(Lobby(app.context, "race")))
        wait(app, 40)
        app.context.idle = 0.0
        wait(app, 59)
        assert not is_house(app)
    saved = Settings.load(config)[0]
    assert (saved.language, saved.strength) == ("pt", "level2")
    assert (saved.choice("race"), saved.choice("pitanks")) == (Choice("kidney", 3, "", 5), Choice())


def test_they_stay_and_are_saved_if_the_operator_wants_it(home: Path) -> None:
    config = house(home, keep="true")
    with opened(Options(headless=True, step=1.0)) as app:
        visit(app)
        wait(app, 70)
        assert not is_house(app)
    saved = Settings.load(config)[0]
    assert (saved.language, saved.choice("race").goal, saved.choice("tag").arena) == ("es", 1, "hall")


def test_what_is_chosen_when_the_operator_ends_keeping_is_the_houses(home: Path) -> None:
    house(home, keep="true")
    with opened(Options(headless=True, step=1.0)) as app:
        visit(app)
        app.stack.apply(Push(OperatorPage(app.context)))
        press(app, *[Button.DOWN] * ROWS.index("keep_choices"), Button.LEFT, Button.BACK)
        assert not app.context.settings.keep_choices
        app.context.settings.choice("race").goal = 3
        app.context.idle = 0.0
        wait(app, 61)
        assert app.context.settings.choice("race").goal == 1
        assert app.context.words.language == "es"


@pytest.mark.parametrize(
    ("kiosk", "operator", "stays"), [(False, False, True), (True, False, False), (True, True, True)]
)
def test_the_language_of_the_options_is_the_houses_except_for_children(
    home: Path, kiosk: bool, operator: bool, stays: bool
) -> None:
    config = house(home)
    with opened(Options(headless=True, step=1.0, kiosk=kiosk)) as app:
        page = OptionsPage(app.context, operator)
        page.apply("language", 3)
        chosen = app.context.words.language
        app.context.idle = 0.0
        wait(app, 61)
        assert (app.context.words.language == chosen) == stays
    assert (Settings.load(config)[0].language == chosen) == stays
