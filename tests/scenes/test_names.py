"""Names on the screen: what differs has different names, in every language and game, those of plug-ins, too."""

from collections import Counter
from collections.abc import Iterable
from itertools import chain

import pytest

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.registry import AIS
from pigaming_app.events.spec import Format
from pigaming_app.games.arenas import load, shipped_arenas
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.match_choice import arena_title
from pigaming_app.scenes.howto.scene import HowTo, taught
from pigaming_app.scenes.lobby.view import level_words
from pigaming_app.scenes.options.page import SECTIONS, options_of
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, InputEvent
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.measuring import measuring

WITH_PICKUPS = ("pickups", "party")  # see the table in docs/games.md
pytestmark = pytest.mark.parametrize("language", LANGUAGES)


def arena_names(game: str, language: str) -> list[str]:
    return [arena_title(load(game, name), language) for name in shipped_arenas(game)]


def rule_names(game: str, words: Words) -> list[str]:
    return [words(f"setup.{game}_{name}") for name in games()[game].variants]


def twice(names: Iterable[str]) -> list[str]:
    """The names that are there more than once."""
    return [name for name, count in Counter(name.casefold() for name in names).items() if count > 1]


def test_arenas_of_all_games_and_their_rule_sets_have_names_of_their_own(language: str) -> None:
    """The pages of events list the arenas of all games; a set-up has the kind of arena before its name."""
    words = Words(language)
    arenas = list(chain.from_iterable(arena_names(game, language) for game in games()))
    assert twice(arenas) == []
    rules = {name for game in games() for name in rule_names(game, words)}
    kinds = {words(f"setup.arena_{game}") for game in games()}
    assert twice([*arenas, *rules, *kinds, *(words(f"games.{game}") for game in games())]) == []


def test_choices_of_one_page_have_names_of_their_own(language: str) -> None:
    words = Words(language)
    for name, game in games().items():
        assert twice(rule_names(name, words)) == []
        rows = [f"arena_{name}", "minutes", "rounds", "rules", "go", *([game.goal] if game.goal else [])]
        assert twice(words(f"setup.{row}") for row in rows) == []
        assert twice(words(f"lobby.drive_{style}") for style in AIS[name].driving) == []
        assert twice(" ".join(level_words(words, brain)) for brain in (*LEVELS, *AIS[name].rivals[len(LEVELS) :])) == []
    for section in ("", *SECTIONS):
        assert twice(words(f"options.{row}") for row in options_of(section)) == []
    assert twice(words(f"events.{form.value}") for form in Format) == []


def test_how_to_play_calls_its_pages_as_the_set_up_does(
    controls: Controls, monkeypatch: pytest.MonkeyPatch, language: str
) -> None:
    """The page of a rule set shows its name, and what it teaches is in those rules."""
    arcade = Arcade(controls, language)
    page = HowTo(arcade.context, taught()[0])
    for game in taught():
        for number in range(SCREENS[game].page_count):
            with measuring(monkeypatch) as screen:
                page.draw(screen)
                shown = [mark.text for mark in screen.texts]
            if names := SCREENS[game].lesson_pages:
                assert len(names) == SCREENS[game].page_count
                assert arcade.context.words(f"setup.{game}_{names[number]}") in shown
                assert "pickups" not in dict(page.lessons()) or names[number] in WITH_PICKUPS
            page.handle(InputEvent(Button.RIGHT, KEYS[0]))
